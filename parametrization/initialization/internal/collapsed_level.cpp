#include "majorant/parametrization/initialization/internal/collapsed_level.h"

#include <Eigen/Geometry>
#include <memory>

#include "majorant/maps/map_problem.h"
#include "majorant/mesh/geometry.h"

namespace majorant {

CollapsedLevel::CollapsedLevel(const CollapsingMesh& mesh, const Points3& all,
                               const std::vector<char>& around) {
  std::vector<Index> number(to_size(mesh.vertex_count()), -1);
  face.reserve(to_size(mesh.faces_left()));
  for (Index f = 0; f < mesh.face_slots(); ++f) {
    if (!mesh.has_face(f)) continue;
    const Index corner[] = {mesh.from(3 * f), mesh.from(3 * f + 1), mesh.from(3 * f + 2)};
    if (!around[corner[0]] && !around[corner[1]] && !around[corner[2]]) continue;
    face.push_back(f);
    for (const Index v : corner) number[v] = 0;
  }
  vertex.reserve(to_size(mesh.vertices_left()));
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (number[v] < 0) continue;
    number[v] = static_cast<Index>(vertex.size());
    vertex.push_back(v);
  }
  faces.resize(static_cast<Index>(face.size()), 3);
  for (std::size_t q = 0; q < face.size(); ++q)
    for (int k = 0; k < 3; ++k)
      faces(static_cast<Index>(q), k) = number[mesh.from(3 * face[q] + k)];
  positions.resize(static_cast<Index>(vertex.size()), 3);
  for (std::size_t k = 0; k < vertex.size(); ++k)
    positions.row(static_cast<Index>(k)) = all.row(vertex[k]);
}

SurfaceMesh CollapsedLevel::surface(const std::string& file) const {
  SurfaceParts parts;
  parts.file = file;
  parts.positions = positions;
  parts.faces = faces;
  parts.input_vertex = vertex;
  parts.input_face = face;
  return SurfaceMesh::from_parts(std::move(parts));
}

Vec CollapsedLevel::places(const VertexDescent& descent) const {
  Vec x(2 * static_cast<Index>(vertex.size()));
  for (std::size_t k = 0; k < vertex.size(); ++k)
    x.segment<2>(2 * static_cast<Index>(k)) = descent.place(vertex[k]);
  return x;
}

void CollapsedLevel::put(const Vec& x, Vec& uv) const {
  for (std::size_t k = 0; k < vertex.size(); ++k)
    uv.segment<2>(2 * vertex[k]) = x.segment<2>(2 * static_cast<Index>(k));
}

Vec CollapsedLevel::weights(const MapOptions& options, const VertexDescent& descent) const {
  if (options.face_weight.size() == 0) return {};
  Vec weight(static_cast<Index>(face.size()));
  for (std::size_t k = 0; k < face.size(); ++k)
    weight[static_cast<Index>(k)] = descent.weight_of(face[k]);
  return weight;
}

std::pair<Problem, Vec> CollapsedLevel::problem(const MapOptions& options,
                                                const VertexDescent& descent,
                                                const std::vector<char>& moves,
                                                const StopCheck& stop) const {
  const auto space =
      std::make_shared<const BezierTriangleSpace>(faces, static_cast<Index>(vertex.size()), 1);
  MapSpecification spec(options);
  spec.rest = std::make_shared<const RestShapes>(flat_triangles(positions, faces));
  spec.face_weight = weights(options, descent);
  const Vec x = places(descent);
  for (std::size_t k = 0; k < vertex.size(); ++k)
    if (!moves[vertex[k]]) spec.pins.push_back({static_cast<Index>(k), descent.place(vertex[k])});
  Problem problem =
      map_problem(spec, space, x, energy_terms(spec, space, {lattice_rule(1)}),
                  std::make_shared<const LocalInjectivity>(space, 2 * spec.rest->measure, 0, stop))
          .problem;
  Vec start = problem.reduce(x);
  return {std::move(problem), std::move(start)};
}

Vec collapsed_weights(const SurfaceMesh& surface, const Vec& face_weight,
                      const CollapsingMesh& mesh, Index gone) {
  Vec area = Vec::Zero(surface.vertex_count()), weight = area;
  for (Index f = 0; f < surface.face_count(); ++f) {
    const Vector3 p = surface.positions().row(surface.faces()(f, 0));
    const Vector3 a = Vector3(surface.positions().row(surface.faces()(f, 1))) - p;
    const Vector3 b = Vector3(surface.positions().row(surface.faces()(f, 2))) - p;
    const double measure = a.cross(b).norm();
    for (int k = 0; k < 3; ++k) {
      area[surface.faces()(f, k)] += measure;
      weight[surface.faces()(f, k)] += measure * face_weight[f];
    }
  }
  for (Index k = 0; k < gone; ++k) {
    const auto [vertex, onto] = mesh.collapsed(k);
    area[onto] += area[vertex];
    weight[onto] += weight[vertex];
  }
  return weight.cwiseQuotient(area);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
