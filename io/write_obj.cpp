#include "majorant/io/write_obj.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>

#include "majorant/framework/error.h"
#include "majorant/io/atomic_file.h"
#include "majorant/io/map_check.h"
#include "majorant/io/read_mesh.h"
#include "majorant/io/refine_map.h"

namespace majorant {
namespace {

// Puts the texture coordinates of a degree 1 map on the polygons of its input.
class TexcoordTransfer {
 public:
  TexcoordTransfer(const std::string& path, const MapFile& map, const PolygonMesh& input)
      : path_(path), map_(map), input_(input), cells_(input.polygons.size()) {
    for (Index f = 0; f < map.cells.rows(); ++f) {
      const Index face = map.input_face.size() == 0 ? f : map.input_face[f];
      if (face < 0 || static_cast<std::size_t>(face) >= cells_.size()) {
        refuse(fmt::format("cell {} belongs to face {}, which the input does not have", f, face));
      }
      cells_[static_cast<std::size_t>(face)].push_back(f);
    }
  }

  PolygonMesh run() {
    result_.positions = input_.positions;
    result_.normals = input_.normals;
    for (Index p = 0; p < map_.uv.rows(); ++p) {
      result_.texcoords.emplace_back(map_.uv.row(p).transpose());
    }
    auto directive = input_.directives.begin();
    for (std::size_t face = 0; face < cells_.size(); ++face) {
      while (directive != input_.directives.end() &&
             static_cast<std::size_t>(directive->first) <= face) {
        keep_directive((directive++)->second);
      }
      add_polygon(face);
    }
    while (directive != input_.directives.end()) keep_directive((directive++)->second);
    return std::move(result_);
  }

 private:
  void keep_directive(const std::string& text) {
    result_.directives.emplace_back(static_cast<Index>(result_.polygons.size()), text);
  }

  void add_polygon(std::size_t face) {
    const auto& polygon = input_.polygons[face];
    std::vector<Index> texcoords(polygon.size(), -1);
    bool is_cut = false;
    for (const Index cell : cells_[face]) {
      for (Index k = 0; k < 3; ++k) {
        const Index point = map_.cells(cell, k);
        Index& texcoord = texcoords[corner_of(face, point)];
        is_cut |= texcoord >= 0 && texcoord != point;
        texcoord = point;
      }
    }
    if (std::find(texcoords.begin(), texcoords.end(), -1) != texcoords.end()) {
      refuse(fmt::format("face {} of the input is not covered by cells", face));
    }
    if (is_cut) {
      add_triangles(face);
      return;
    }
    result_.polygons.push_back(polygon);
    result_.polygon_texcoords.push_back(std::move(texcoords));
    if (input_.polygon_normals.empty()) return;
    result_.polygon_normals.push_back(input_.polygon_normals[face]);
  }

  // A cut runs through the polygon: one corner has several texture coordinates.
  void add_triangles(std::size_t face) {
    for (const Index cell : cells_[face]) {
      std::vector<Index> polygon;
      std::vector<Index> texcoords;
      std::vector<Index> normals;
      for (Index k = 0; k < 3; ++k) {
        const std::size_t corner = corner_of(face, map_.cells(cell, k));
        polygon.push_back(input_.polygons[face][corner]);
        texcoords.push_back(map_.cells(cell, k));
        if (input_.polygon_normals.empty() || input_.polygon_normals[face].empty()) continue;
        normals.push_back(input_.polygon_normals[face][corner]);
      }
      result_.polygons.push_back(std::move(polygon));
      result_.polygon_texcoords.push_back(std::move(texcoords));
      if (!input_.polygon_normals.empty()) result_.polygon_normals.push_back(std::move(normals));
    }
  }

  // The polygon's corner that a map point is: by vertex number, else (welded vertices) by position.
  std::size_t corner_of(std::size_t face, Index point) const {
    const auto& polygon = input_.polygons[face];
    auto found = polygon.end();
    if (map_.input_vertex.size() > 0) {
      found = std::find(polygon.begin(), polygon.end(), map_.input_vertex[point]);
    }
    if (found == polygon.end()) {
      const Vector3 position = map_.points.row(point).transpose();
      found = std::find_if(polygon.begin(), polygon.end(), [&](Index v) {
        return input_.positions[static_cast<std::size_t>(v)] == position;
      });
    }
    if (found == polygon.end()) {
      refuse(fmt::format("map point {} is no corner of face {} of the input", point, face));
    }
    return static_cast<std::size_t>(found - polygon.begin());
  }

  [[noreturn]] void refuse(const std::string& problem) const {
    throw Error(
        ErrorKind::Invalid,
        fmt::format("cannot write {}: {}; give the mesh the map was made from", path_, problem));
  }

  const std::string& path_;
  const MapFile& map_;
  const PolygonMesh& input_;
  std::vector<std::vector<Index>> cells_;  // of every polygon of the input
  PolygonMesh result_;
};

std::string cone_comments(const MapFile& map) {
  std::map<Index, int> cones;
  for (Index p = 0; p < std::min(map.cone.size(), map.input_vertex.size()); ++p) {
    if (map.cone[p] != 0 && map.input_vertex[p] >= 0) cones[map.input_vertex[p]] = map.cone[p];
  }
  if (cones.empty()) return {};
  std::string text = "# cones: vertices count from 0; angle = quarter_turns * 90 degrees\n";
  for (const auto& [vertex, turns] : cones) {
    text += fmt::format("# cone vertex {} quarter_turns {}\n", vertex, turns);
  }
  return text;
}

}  // namespace

std::string obj_text(const PolygonMesh& mesh) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  for (const Vector3& p : mesh.positions) fmt::format_to(out, "v {} {} {}\n", p[0], p[1], p[2]);
  for (const Vector2& t : mesh.texcoords) fmt::format_to(out, "vt {} {}\n", t[0], t[1]);
  for (const Vector3& n : mesh.normals) fmt::format_to(out, "vn {} {} {}\n", n[0], n[1], n[2]);
  const std::vector<Index> none;
  auto directive = mesh.directives.begin();
  for (std::size_t p = 0; p < mesh.polygons.size(); ++p) {
    for (; directive != mesh.directives.end() && static_cast<std::size_t>(directive->first) <= p;
         ++directive) {
      fmt::format_to(out, "{}\n", directive->second);
    }
    const auto& texcoords = mesh.polygon_texcoords.empty() ? none : mesh.polygon_texcoords[p];
    const auto& normals = mesh.polygon_normals.empty() ? none : mesh.polygon_normals[p];
    fmt::format_to(out, "f");
    for (std::size_t k = 0; k < mesh.polygons[p].size(); ++k) {
      fmt::format_to(out, " {}", mesh.polygons[p][k] + 1);
      if (!texcoords.empty()) fmt::format_to(out, "/{}", texcoords[k] + 1);
      if (!normals.empty())
        fmt::format_to(out, "{}{}", texcoords.empty() ? "//" : "/", normals[k] + 1);
    }
    fmt::format_to(out, "\n");
  }
  for (; directive != mesh.directives.end(); ++directive) {
    fmt::format_to(out, "{}\n", directive->second);
  }
  return fmt::to_string(text);
}

void write_obj(const std::string& path, const MapFile& map, const PolygonMesh* input, int refine,
               const FileVerification& verify) {
  require_sound(path, map);
  PolygonMesh mesh;
  if (map.degree == 1 && refine == 1) {
    mesh = input == nullptr ? mesh_from_map(map, path) : TexcoordTransfer(path, map, *input).run();
  } else {
    mesh = refine_map(map, input, refine);
  }
  write_file_atomically(path, cone_comments(map) + obj_text(mesh), verify);
}

}  // namespace majorant
