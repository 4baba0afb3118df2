#include "majorant/parametrization/fields/internal/conformal_energy.h"

#include <utility>

#include "majorant/mesh/surface_mesh.h"

namespace majorant {
ConformalEnergy::ConformalEnergy(const SurfaceMesh& mesh, Vec target_angles)
    : triangulation_(mesh),
      target_angles_(std::move(target_angles)),
      is_interior_(to_size(mesh.vertex_count()), 1) {
  for (const auto& loop : mesh.boundary_loops())
    for (const Index v : loop) is_interior_[v] = 0;
}

ConformalDerivatives ConformalEnergy::derivatives(const Vec& log_factor) const {
  const Vec lengths = triangulation_.log_lengths(log_factor);
  ConformalDerivatives out{target_angles_, Vec(triangulation_.half_edge_count())};
  for (Index f = 0; f < triangulation_.face_count(); ++f) {
    const TriangleShape shape = IntrinsicTriangulation::shape(lengths, f);
    for (Index k = 0; k < 3; ++k) {
      out.gradient[triangulation_.faces()(f, k)] -= shape.angle[k];
      out.hessian_weights[3 * f + k] = 0.5 * shape.cotangent[previous(k)];
    }
  }
  bool closed = true;
  for (std::size_t v = 0; v < is_interior_.size(); ++v) {
    if (is_interior_[v]) continue;
    out.gradient[static_cast<Index>(v)] = 0;
    closed = false;
  }
  // The gradient has mean 0 by Gauss-Bonnet. The rounding of pi and of the angles is spread over
  // all vertices, so that it does not accumulate at one.
  if (closed) out.gradient.array() -= out.gradient.mean();
  return out;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
