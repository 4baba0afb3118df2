#include "majorant/parametrization/initialization/filled_holes.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace majorant {

const std::vector<Index>& outer_loop(const SurfaceMesh& mesh) {
  const auto length = [&](const std::vector<Index>& loop) {
    double sum = 0;
    for (std::size_t k = 0; k < loop.size(); ++k)
      sum += (mesh.positions().row(loop[(k + 1) % loop.size()]) - mesh.positions().row(loop[k]))
                 .norm();
    return sum;
  };
  return *std::max_element(mesh.boundary_loops().begin(), mesh.boundary_loops().end(),
                           [&](const auto& p, const auto& q) { return length(p) < length(q); });
}

Cells filled_faces(const SurfaceMesh& mesh) {
  const std::vector<Index>& outer = outer_loop(mesh);
  std::vector<std::array<Index, 3>> fans;
  Index centre = mesh.vertex_count();
  for (const auto& loop : mesh.boundary_loops()) {
    if (&loop == &outer) continue;
    for (std::size_t k = 0; k < loop.size(); ++k)
      fans.push_back({loop[(k + 1) % loop.size()], loop[k], centre});
    ++centre;
  }
  Cells faces(mesh.face_count() + static_cast<Index>(fans.size()), 3);
  faces.topRows(mesh.face_count()) = mesh.faces();
  for (std::size_t k = 0; k < fans.size(); ++k)
    faces.row(mesh.face_count() + static_cast<Index>(k)) << fans[k][0], fans[k][1], fans[k][2];
  return faces;
}

SurfaceMesh filled_surface(const SurfaceMesh& mesh) {
  SurfaceParts parts;
  parts.faces = filled_faces(mesh);
  const std::vector<Index>& outer = outer_loop(mesh);
  const auto holes = static_cast<Index>(mesh.boundary_loops().size()) - 1;
  parts.positions.resize(mesh.vertex_count() + holes, 3);
  parts.positions.topRows(mesh.vertex_count()) = mesh.positions();
  Index centre = mesh.vertex_count();
  for (const auto& loop : mesh.boundary_loops()) {
    if (&loop == &outer) continue;
    Eigen::RowVector3d middle = Eigen::RowVector3d::Zero();
    for (const Index v : loop) middle += mesh.positions().row(v) / static_cast<double>(loop.size());
    parts.positions.row(centre++) = middle;
  }
  parts.input_vertex.resize(static_cast<std::size_t>(parts.positions.rows()));
  parts.input_face.resize(static_cast<std::size_t>(parts.faces.rows()));
  for (auto* numbers : {&parts.input_vertex, &parts.input_face})
    std::iota(numbers->begin(), numbers->end(), 0);
  return SurfaceMesh::from_parts(std::move(parts));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
