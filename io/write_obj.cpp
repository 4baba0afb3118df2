#include "majorant/io/write_obj.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <vector>

#include "majorant/framework/error.h"
#include "majorant/io/atomic_file.h"
#include "majorant/io/internal/cones_of.h"
#include "majorant/io/internal/material_files.h"
#include "majorant/io/internal/text_pieces.h"
#include "majorant/io/map_check.h"
#include "majorant/parametrization/tessellation/tessellate_map.h"

namespace majorant {
namespace {

std::string cone_comments(const MapFile& map) {
  const std::map<Index, int> cones = cones_of(map);
  if (cones.empty()) return {};
  std::string text = "# cones: vertices count from 0; angle = quarter_turns * 90 degrees\n";
  for (const auto& [vertex, turns] : cones) {
    text += fmt::format("# cone vertex {} quarter_turns {}\n", vertex, turns);
  }
  return text;
}

// The polygon before which every directive stands: they keep their order.
std::vector<Index> places_of_directives(const PolygonMesh& mesh) {
  std::vector<Index> places;
  for (const auto& [polygon, line] : mesh.directives)
    places.push_back(std::max(polygon, places.empty() ? 0 : places.back()));
  return places;
}

}  // namespace

std::string obj_text(const PolygonMesh& mesh) {
  TextPieces text;
  const auto count = [](const auto& list) { return static_cast<Index>(list.size()); };
  text.add_lines(count(mesh.positions), [&](Index v, fmt::appender out) {
    const Vector3& p = mesh.positions[v];
    fmt::format_to(out, FMT_COMPILE("v {} {} {}"), p[0], p[1], p[2]);
    if (!mesh.colors.empty() && mesh.colors[v].allFinite()) {
      const Vector3& c = mesh.colors[v];
      fmt::format_to(out, FMT_COMPILE(" {} {} {}"), c[0], c[1], c[2]);
    }
    *out++ = '\n';
  });
  text.add_lines(count(mesh.texcoords), [&](Index k, fmt::appender out) {
    fmt::format_to(out, FMT_COMPILE("vt {} {}\n"), mesh.texcoords[k][0], mesh.texcoords[k][1]);
  });
  text.add_lines(count(mesh.normals), [&](Index k, fmt::appender out) {
    const Vector3& n = mesh.normals[k];
    fmt::format_to(out, FMT_COMPILE("vn {} {} {}\n"), n[0], n[1], n[2]);
  });
  const std::vector<Index> places = places_of_directives(mesh);
  text.add_lines(count(mesh.polygons), [&](Index p, fmt::appender out) {
    const auto here = std::equal_range(places.begin(), places.end(), p);
    for (auto place = here.first; place != here.second; ++place)
      fmt::format_to(out, FMT_COMPILE("{}\n"), mesh.directives[place - places.begin()].second);
    const auto list = [p](const std::vector<std::vector<Index>>& lists) {
      return lists.empty() || lists[p].empty() ? nullptr : lists[p].data();
    };
    const auto& polygon = mesh.polygons[p];
    const Index* const texcoords = list(mesh.polygon_texcoords);
    const Index* const normals = list(mesh.polygon_normals);
    *out++ = 'f';
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      fmt::format_to(out, FMT_COMPILE(" {}"), polygon[k] + 1);
      if (texcoords) fmt::format_to(out, FMT_COMPILE("/{}"), texcoords[k] + 1);
      if (normals) fmt::format_to(out, FMT_COMPILE("{}{}"), texcoords ? "/" : "//", normals[k] + 1);
    }
    *out++ = '\n';
  });
  const auto rest = std::lower_bound(places.begin(), places.end(), count(mesh.polygons));
  for (auto place = rest; place != places.end(); ++place)
    text.add(mesh.directives[place - places.begin()].second + "\n");
  return text.take();
}

void write_obj(const std::string& path, const MapFile& map, const PolygonMesh* input,
               const TessellationOptions& options, const FileVerification& verify) {
  require_sound(path, map);
  std::string text;
  try {
    PolygonMesh mesh = tessellate_map(map, input, options);
    if (input != nullptr && !input->file.empty()) {
      std::optional<MaterialFiles> materials;
      for (auto& [polygon, line] : mesh.directives) {
        if (!line.starts_with("mtllib")) continue;
        if (!materials) materials.emplace(input->file, path);
        line = materials->repointed(line);
      }
    }
    text = obj_text(mesh);
  } catch (const Error& error) {
    throw Error(error.kind(), fmt::format("cannot write {}: {}", path, error.what()));
  }
  text.insert(0, cone_comments(map));
  write_file_atomically(path, text, verify);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
