// The convex energy whose minimum is the discrete conformal metric with prescribed angle sums.
//
// Edge lengths of the metric with log factors u (one per vertex) are exp((u_a + u_b) / 2) times the
// old ones. Its angles are derivatives of a convex function E of u, with
//     dE/du_v = target angle sum at v - angle sum at v,
//     d2E/du2 = the cotangent Laplacian: sum of cot(angle opposite h) / 2 (x_a - x_b)^2 over the
//               half-edges h = (a, b), halved  [SSP08].
// Lengths that violate the triangle inequality count as a triangle with angles 0, 0 and pi
// (opposite the longest side). E stays convex with continuous gradient [BPS15] and is linear there.
// The value of E is not needed (conformal_metric.cpp says why).
#pragma once

#include <vector>

#include "majorant/framework/types.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/parametrization/fields/internal/intrinsic_triangulation.h"

namespace majorant {

struct ConformalDerivatives {
  Vec gradient;         // #V: target angle sum - angle sum, radians; 0 at the boundary
  Vec hessian_weights;  // 3 #F: cotangents / 2, for EdgeLaplacian::values
};

class ConformalEnergy {
 public:
  // target_angles: #V, radians, read at interior vertices only. On a closed surface they satisfy
  // Gauss-Bonnet.
  ConformalEnergy(const SurfaceMesh& mesh, Vec target_angles);
  // log_factor: #V, finite.
  ConformalDerivatives derivatives(const Vec& log_factor) const;
  const std::vector<char>& is_interior() const { return is_interior_; }  // #V
  const IntrinsicTriangulation& triangulation() const { return triangulation_; }
  Index make_delaunay(const Vec& log_factor) { return triangulation_.make_delaunay(log_factor); }

 private:
  IntrinsicTriangulation triangulation_;
  Vec target_angles_;
  std::vector<char> is_interior_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
