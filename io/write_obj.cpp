#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <vector>

#include "majorant/framework/error.h"
#include "majorant/io/atomic_file.h"
#include "majorant/io/files_below.h"
#include "majorant/io/formats.h"
#include "majorant/io/internal/cones_of.h"
#include "majorant/io/internal/material_files.h"
#include "majorant/io/internal/text_pieces.h"
#include "majorant/io/io.h"
#include "majorant/io/map_check.h"
#include "majorant/io/written_mark.h"
#include "majorant/parametrization/tessellation/tessellate_map.h"

namespace majorant {
namespace {

std::string cone_comments(const MapFile& map) {
  const std::map<Index, int> cones = cones_of(map);
  if (cones.empty()) return {};
  std::string text = fmt::format("# {}\n", kConesComment);
  for (const auto& [vertex, turns] : cones)
    text += fmt::format("# {}\n", cone_comment(vertex, turns));
  return text;
}

// Returns for each directive the polygon that follows it, in ascending order.
std::vector<Index> places_of_directives(const PolygonMesh& mesh) {
  std::vector<Index> places;
  for (const auto& [polygon, line] : mesh.directives)
    places.push_back(std::max(polygon, places.empty() ? 0 : places.back()));
  return places;
}

// Makes the lines of a mesh in an order that its numbers allow.
class ObjText {
 public:
  // head: lines before all others.
  ObjText(const PolygonMesh& mesh, const std::string& head)
      : mesh_(mesh), places_(places_of_directives(mesh)) {
    text_.add(head);
  }

  // Writes all vertices first.
  std::string plain() {
    add_vertices(count(mesh_.positions));
    add_attributes(count(mesh_.texcoords), count(mesh_.normals));
    text_.add_lines(count(mesh_.polygons), [&](Index p, fmt::appender out) {
      const auto here = std::equal_range(places_.begin(), places_.end(), p);
      for (auto place = here.first; place != here.second; ++place)
        fmt::format_to(out, FMT_COMPILE("{}\n"), mesh_.directives[place - places_.begin()].second);
      add_polygon(p, out);
    });
    const auto rest = std::lower_bound(places_.begin(), places_.end(), count(mesh_.polygons));
    for (auto place = rest; place != places_.end(); ++place)
      text_.add(mesh_.directives[place - places_.begin()].second + "\n");
    return text_.take();
  }

  // Writes vertices between directives, but always before the polygons that need them.
  std::string in_blocks() {
    Index polygon = 0;
    for (std::size_t k = 0; k < mesh_.directives.size(); ++k) {
      add_polygons(polygon, places_[k]);
      polygon = places_[k];
      const std::string& line = mesh_.directives[k].second;
      if (const std::optional<Index> vertices = vertices_of(line))
        add_vertices(*vertices);
      else
        text_.add(line + "\n");
    }
    add_polygons(polygon, count(mesh_.polygons));
    add_vertices(count(mesh_.positions));
    add_attributes(count(mesh_.texcoords), count(mesh_.normals));
    return text_.take();
  }

  // Returns the number in the directive "v 8", which is not written to an OBJ.
  static std::optional<Index> vertices_of(const std::string& line) {
    Index number = 0;
    if (!line.starts_with("v ")) return std::nullopt;
    const char* const end = line.data() + line.size();
    const auto [stop, code] = std::from_chars(line.data() + 2, end, number);
    if (code != std::errc() || stop != end) return std::nullopt;
    return number;
  }

 private:
  template <class List>
  static Index count(const List& list) {
    return static_cast<Index>(list.size());
  }

  // Adds the missing vertices up to this number.
  void add_vertices(Index last) {
    const Index first = vertices_;
    vertices_ = std::max(first, std::min(last, count(mesh_.positions)));
    text_.add_lines(vertices_ - first, [&](Index k, fmt::appender out) {
      const Index v = first + k;
      const Vector3& p = mesh_.positions[v];
      fmt::format_to(out, FMT_COMPILE("v {} {} {}"), p[0], p[1], p[2]);
      if (!mesh_.colors.empty() && mesh_.colors[v].allFinite()) {
        const Vector3& c = mesh_.colors[v];
        fmt::format_to(out, FMT_COMPILE(" {} {} {}"), c[0], c[1], c[2]);
      }
      *out++ = '\n';
    });
  }

  void add_attributes(Index texcoords, Index normals) {
    const Index texcoord = texcoords_, normal = normals_;
    texcoords_ = std::max(texcoord, texcoords);
    normals_ = std::max(normal, normals);
    text_.add_lines(texcoords_ - texcoord, [&](Index k, fmt::appender out) {
      const Vector2& uv = mesh_.texcoords[texcoord + k];
      fmt::format_to(out, FMT_COMPILE("vt {} {}\n"), uv[0], uv[1]);
    });
    text_.add_lines(normals_ - normal, [&](Index k, fmt::appender out) {
      const Vector3& n = mesh_.normals[normal + k];
      fmt::format_to(out, FMT_COMPILE("vn {} {} {}\n"), n[0], n[1], n[2]);
    });
  }

  // Returns one more than the largest number in these lists of polygons; `all` after the last of
  // them.
  Index used(const IndexLists& lists, Index first, Index last, Index all) const {
    if (last == count(mesh_.polygons)) return all;
    Index most = 0;
    for (Index p = first; p < last && !lists.empty(); ++p)
      for (const Index k : lists[p]) most = std::max(most, k + 1);
    return most;
  }

  void add_polygons(Index first, Index last) {
    if (first >= last) return;
    Index vertices = 0;
    for (Index p = first; p < last; ++p)
      for (const Index v : mesh_.polygons[p]) vertices = std::max(vertices, v + 1);
    add_vertices(vertices);
    add_attributes(used(mesh_.polygon_texcoords, first, last, count(mesh_.texcoords)),
                   used(mesh_.polygon_normals, first, last, count(mesh_.normals)));
    text_.add_lines(last - first, [&](Index k, fmt::appender out) { add_polygon(first + k, out); });
  }

  void add_polygon(Index p, fmt::appender out) const {
    const auto list = [p](const IndexLists& lists) {
      return lists.empty() || lists[p].empty() ? nullptr : lists[p].data();
    };
    const auto& polygon = mesh_.polygons[p];
    const Index* const texcoords = list(mesh_.polygon_texcoords);
    const Index* const normals = list(mesh_.polygon_normals);
    *out++ = 'f';
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      fmt::format_to(out, FMT_COMPILE(" {}"), polygon[k] + 1);
      if (texcoords) fmt::format_to(out, FMT_COMPILE("/{}"), texcoords[k] + 1);
      if (normals) fmt::format_to(out, FMT_COMPILE("{}{}"), texcoords ? "/" : "//", normals[k] + 1);
    }
    *out++ = '\n';
  }

  const PolygonMesh& mesh_;
  const std::vector<Index> places_;
  TextPieces text_;
  Index vertices_ = 0, texcoords_ = 0, normals_ = 0;  // written so far
};

// The mark and `comments` come first.
std::string obj_text(const PolygonMesh& mesh, const std::string& comments) {
  const bool has_blocks = std::any_of(
      mesh.directives.begin(), mesh.directives.end(),
      [](const auto& directive) { return ObjText::vertices_of(directive.second).has_value(); });
  ObjText text(mesh, mark_text(MarkStyle::FirstLine) + comments);
  return has_blocks ? text.in_blocks() : text.plain();
}

}  // namespace

std::string obj_text(const PolygonMesh& mesh) { return obj_text(mesh, {}); }

void write_obj(const std::string& path, const MapFile& map, const PolygonMesh* input,
               const TessellationOptions& options, const FileVerification& verify) {
  require_sound(path, map);
  std::string text;
  try {
    PolygonMesh mesh = tessellate_map(map, input, options);
    if (input != nullptr && !input->file.empty()) {
      require_materials_below(*input);
      std::optional<MaterialFiles> materials;
      for (auto& [polygon, line] : mesh.directives) {
        if (!line.starts_with("mtllib")) continue;
        if (!materials) materials.emplace(input->file, path);
        line = materials->repointed(line);
      }
    }
    const bool is_partial = !map.is_complete && input != nullptr;
    text = obj_text(mesh, (is_partial ? fmt::format("# {}\n", kPartialLayoutComment) : "") +
                              cone_comments(map));
  } catch (const Error& error) {
    throw Error(error.kind(), fmt::format("cannot write {}: {}", path, error.what()));
  }
  write_file_atomically(path, text, verify);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
