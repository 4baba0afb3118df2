#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>

#include "majorant/framework/error.h"
#include "majorant/io/atomic_file.h"
#include "majorant/io/internal/cones_of.h"
#include "majorant/io/internal/material_files.h"
#include "majorant/io/io.h"
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

}  // namespace

std::string obj_text(const PolygonMesh& mesh) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vector3& p = mesh.positions[v];
    fmt::format_to(out, "v {} {} {}", p[0], p[1], p[2]);
    if (!mesh.colors.empty() && mesh.colors[v].allFinite()) {
      const Vector3& c = mesh.colors[v];
      fmt::format_to(out, " {} {} {}", c[0], c[1], c[2]);
    }
    fmt::format_to(out, "\n");
  }
  for (const Vector2& t : mesh.texcoords) fmt::format_to(out, "vt {} {}\n", t[0], t[1]);
  for (const Vector3& n : mesh.normals) fmt::format_to(out, "vn {} {} {}\n", n[0], n[1], n[2]);
  const std::vector<Index> none;
  auto directive = mesh.directives.begin();
  for (std::size_t p = 0; p < mesh.polygons.size(); ++p) {
    for (; directive != mesh.directives.end() && to_size(directive->first) <= p; ++directive) {
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
  write_file_atomically(path, cone_comments(map) + text, verify);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
