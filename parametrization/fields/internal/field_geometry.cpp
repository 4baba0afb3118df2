#include "majorant/parametrization/fields/internal/field_geometry.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "majorant/mesh/geometry.h"

namespace majorant {
namespace {

// Upper bound on the weight of an edge, a ratio of lengths. Beyond it a face is nearly degenerate
// and would only spoil the factorization. Chosen, not tuned.
constexpr double kLargestWeight = 1e4;

}  // namespace

FieldGeometry::FieldGeometry(const SurfaceMesh& mesh)
    : edge_direction(mesh.half_edge_count()),
      transport(Vec::Zero(mesh.half_edge_count())),
      weight(Vec::Zero(mesh.half_edge_count())),
      face_area(mesh.face_count()),
      angle_sum(Vec::Zero(mesh.vertex_count())),
      is_boundary(mesh.boundary_flags()),
      valence(to_size(mesh.vertex_count()), 0) {
  for (Index f = 0; f < mesh.face_count(); ++f) {
    double corner[3];
    for (int k = 0; k < 3; ++k) {
      const CornerAngle angle = corner_angle(mesh, 3 * f + k);
      corner[k] = angle.radians();
      if (k == 0) face_area[f] = angle.sine / 2;
      angle_sum[mesh.faces()(f, k)] += corner[k];
      ++valence[mesh.faces()(f, k)];
    }
    edge_direction[3 * f] = 0;
    edge_direction[3 * f + 1] = std::numbers::pi - corner[1];
    edge_direction[3 * f + 2] = std::numbers::pi + corner[0];
  }
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    const Index o = mesh.opposite(h);
    if (o < h) continue;  // the boundary has -1
    transport[h] = edge_direction[o] + std::numbers::pi - edge_direction[h];
    transport[o] = -transport[h];
    // The centroid of a face has a third of its height: the distance is (2/3) (A + A') / length.
    const Vector3 edge =
        mesh.positions().row(mesh.to_vertex(h)) - mesh.positions().row(mesh.from_vertex(h));
    weight[h] =
        std::clamp(1.5 * edge.squaredNorm() / (face_area[face_of(h)] + face_area[face_of(o)]),
                   1 / kLargestWeight, kLargestWeight);
    weight[o] = weight[h];
  }
}

Vector3 edge_vector(const SurfaceMesh& mesh, Index half_edge) {
  const Vector3 e = mesh.positions().row(mesh.to_vertex(half_edge)) -
                    mesh.positions().row(mesh.from_vertex(half_edge));
  return e.normalized();
}

SparseSpd field_system(Index size, Index block, const std::vector<SparseSpd::Entry>& entries,
                       Ordering ordering, const StopCheck& stop) {
  return SparseSpd(size, block, entries,
                   "the matrix of a cross field cannot be factorized; check the mesh for nearly "
                   "degenerate faces",
                   ordering, stop);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
