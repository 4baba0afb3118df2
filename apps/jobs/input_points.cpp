#include "majorant/apps/jobs/input_points.h"

#include <fmt/format.h>

#include <algorithm>

#include "majorant/framework/error.h"

namespace majorant {

Index used_vertex(const std::string& source, const SurfaceMesh& mesh, Index input_vertex) {
  const Index vertex = mesh.find_input_vertex(input_vertex);
  if (vertex < 0)
    throw Error(
        ErrorKind::Unsupported,
        fmt::format("{}: vertex {} belongs to no face; take another", source, input_vertex));
  return vertex;
}

std::vector<Pin> pins_at(const SurfaceMesh& mesh, const std::vector<Handle>& handles,
                         const std::string& source, const std::vector<Index>& names) {
  std::vector<std::pair<Index, Index>> vertices;  // vertex of the input, vertex of the mesh
  for (Index v = 0; v < mesh.vertex_count(); ++v) vertices.emplace_back(mesh.input_vertex(v), v);
  std::sort(vertices.begin(), vertices.end());
  std::vector<Pin> points;
  for (const Handle& h : handles) {
    const Index name = names.empty() ? h.vertex : names[h.vertex];
    used_vertex(source, mesh, name);
    for (auto copy = std::lower_bound(vertices.begin(), vertices.end(), std::pair(name, 0));
         copy != vertices.end() && copy->first == name; ++copy)
      points.push_back({copy->second, h.target});
  }
  return points;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
