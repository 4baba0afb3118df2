// The least distortion of a piece of a surface in the plane, estimated by one linear solve without
// a map.
//
//   const FlatteningStrain sheet(*mesh);
//   const double energy = 4 + 4 * sheet.strain();   // about, symmetric Dirichlet, degree 1
//   const double stretch = stretch_of_strain(sheet.strain());
//
// Near an isometry the singular values of a map are 1 + e_1 and 1 + e_2, and the symmetric
// Dirichlet energy is 4 + 4 (e_1^2 + e_2^2) up to higher orders. That is the energy of a thin
// elastic sheet without lateral contraction. The stress of a sheet with Gauss curvature K that is
// pressed flat is given by its stress function chi [LL86] Sec. 14,
//     Laplace Laplace chi = K,   chi = 0 and d chi / dn = 0 on the boundary, which is free,
// and then  mean |e|^2 = int K chi / area.  Along a loop around a hole chi is a constant such that
// the image closes up: K includes the turning of the loop.
//
// Discretization: with the cotangent Laplacian L (all rows, columns of the unknowns) and the areas
// M of vertices, L^T M^-1 L chi = angle defects. It is exact without curvature. Far from an
// isometry it is too large but still orders surfaces correctly. Overlaps of the image are not
// detected.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/parametrization/seams/internal/flattening_system.h"

namespace majorant {

class FlatteningStrain {
 public:
  // Estimates the strain of the system's surface cut along is_cut (3 #F flags, both sides of an
  // edge or none), which must leave one connected piece. The half-edge `outer` leaves a vertex of
  // the loop around the image; -1: the longest loop. Stopped.
  FlatteningStrain(FlatteningSystem& system, const std::vector<char>& is_cut, Index outer = -1,
                   const StopCheck& stop = {});
  // Estimates the strain of a piece. piece: connected, with a boundary. Stopped.
  explicit FlatteningStrain(const SurfaceMesh& piece, const StopCheck& stop = {});

  // Returns mean |e|^2; +inf if the mesh makes the system singular.
  double strain() const { return strain_; }

  // A sum of factors times chi at the start vertices of these half-edges.
  using Functional = std::vector<std::pair<Index, double>>;
  double apply(const Functional& functional) const;
  bool is_zero(const Functional& functional) const;  // for all chi
  // Returns for each two of these functionals, which are not zero, one of them applied to the
  // response chi to the curvature given by the other. Must be called before another strain is
  // computed with the system. Stopped.
  Eigen::MatrixXd responses(const std::vector<Functional>& functionals,
                            const StopCheck& stop) const;

 private:
  void solve(FlatteningSystem& system, const FlatteningSystem::Boundary& boundary,
             const StopCheck& stop);
  // Returns the functional by unknown, sorted, without zeros.
  Functional load_of(const Functional& functional) const;

  std::vector<Index> unknown_;  // 3 #F: where the half-edge starts, -1 on the outer loop
  std::shared_ptr<FlatteningSystem::Factor> factor_;
  Vec chi_;
  double strain_ = 0;
};

// Return the mean square stretch of a map [SSGH01] with that strain, to the order of the estimate,
// and its inverse.
double stretch_of_strain(double strain);
double strain_of_stretch(double stretch);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
