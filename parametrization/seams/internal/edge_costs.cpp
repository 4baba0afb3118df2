#include "majorant/parametrization/seams/internal/edge_costs.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace majorant {
namespace {

// Degrees: edges below the first are not sharp, those above the second fully; a smooth
// surface of some 1000 faces bends by up to 30 degrees at its edges, a box by 90.
constexpr double kSharpFrom = 40, kSharpTo = 70;
// The cost of a sharp edge, relative to its length: a seam along it may be twice as long.
constexpr double kSharpCost = 0.75;
// The cost of an edge inside a polygon, relative to its length: more than any way around.
constexpr double kInnerCost = 1e6;
// The factor of an edge's cost at a vertex that is to stay whole: more than ways around such
// vertices, less than through a polygon.
constexpr double kWholeCost = 1e4;
// The least length of an edge, relative to the mean one: no way is free; far below any usable edge.
constexpr double kLeastLength = 1e-9;

Vector3 area_vector(const SurfaceMesh& mesh, Index face) {
  const Vector3 a = mesh.positions().row(mesh.faces()(face, 0)),
                b = mesh.positions().row(mesh.faces()(face, 1)),
                c = mesh.positions().row(mesh.faces()(face, 2));
  return (b - a).cross(c - a);
}

bool is_inner(const SurfaceMesh& mesh, Index h) {
  return mesh.input_face(face_of(h)) == mesh.input_face(face_of(mesh.opposite(h)));
}

}  // namespace

Vec dihedral_angles(const SurfaceMesh& mesh) {
  Vec angle = Vec::Zero(mesh.half_edge_count());
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    const Index o = mesh.opposite(h);
    if (o < h || is_inner(mesh, h)) continue;  // the boundary has -1
    const Vector3 a = area_vector(mesh, face_of(h)), b = area_vector(mesh, face_of(o));
    angle[h] = angle[o] = std::atan2(a.cross(b).norm(), a.dot(b));
  }
  return angle;
}

Vec cut_costs(const SurfaceMesh& mesh) {
  Vec cost(mesh.half_edge_count());
  for (Index h = 0; h < mesh.half_edge_count(); ++h) cost[h] = mesh.edge_length(h);
  const double least = kLeastLength * cost.mean();
  const Vec angle = dihedral_angles(mesh);
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    const Index o = mesh.opposite(h);
    const double degrees = angle[h] * 180 / std::numbers::pi;
    const double sharp = std::clamp((degrees - kSharpFrom) / (kSharpTo - kSharpFrom), 0.0, 1.0);
    const double factor = o >= 0 && is_inner(mesh, h) ? kInnerCost : 1 - (1 - kSharpCost) * sharp;
    cost[h] = factor * std::max(cost[h], least);
  }
  return cost;
}

Vec cut_costs(const SurfaceMesh& mesh, const std::vector<char>& is_whole) {
  Vec cost = cut_costs(mesh);
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    if (is_whole[mesh.from_vertex(h)] || is_whole[mesh.to_vertex(h)]) cost[h] *= kWholeCost;
  return cost;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
