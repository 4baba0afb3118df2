// The least distortion of a piece of a surface in the plane: estimated by one linear solve, without
// a map.
//
//   const FlatteningStrain sheet(*mesh);
//   const double energy = 4 + 4 * sheet.strain();   // about, symmetric Dirichlet, degree 1
//   const double stretch = stretch_of_strain(sheet.strain());
//
// Near an isometry the singular values of a map are 1 + e_1 and 1 + e_2, and the symmetric
// Dirichlet energy is 4 + 4 (e_1^2 + e_2^2) but for higher orders: that of a thin elastic sheet
// without lateral contraction. What presses a sheet with Gauss curvature K flat is given by its
// stress function chi [LL86] Sec. 14,
//     Laplace Laplace chi = K,   chi = 0 and d chi / dn = 0 on the boundary, which is free,
// and then  mean |e|^2 = int K chi / area.  Along a loop around a hole chi is a constant such that
// the image closes up: K includes what the loop would have to turn.
//
// Discrete: L the cotangent Laplacian (all rows, columns of the unknowns), M the areas of vertices,
// L^T M^-1 L chi = angle defects. Exact for no curvature; far from an isometry too large, but still
// larger where more is wrong. Whether the image overlaps itself is not seen.
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
  // Of the surface of the system cut open along is_cut (3 #F flags, both sides of an edge or none)
  // to one connected piece. outer: a half-edge that leaves a vertex of the loop around the image,
  // -1: of the longest one. Stopped.
  FlatteningStrain(FlatteningSystem& system, const std::vector<char>& is_cut, Index outer = -1,
                   const StopCheck& stop = {});
  // piece: connected, with a boundary. Stopped.
  explicit FlatteningStrain(const SurfaceMesh& piece, const StopCheck& stop = {});

  // mean |e|^2; +inf where the mesh spoils the system.
  double strain() const { return strain_; }

  // A sum of factors times chi where these half-edges start.
  using Functional = std::vector<std::pair<Index, double>>;
  double apply(const Functional& functional) const;
  bool is_zero(const Functional& functional) const;  // for all chi
  // For each two of these, which are not zero: one of them, applied to the response chi to the
  // curvature that the other one is. Before another strain is made of the system. Stopped.
  Eigen::MatrixXd responses(const std::vector<Functional>& functionals,
                            const StopCheck& stop) const;

 private:
  void solve(FlatteningSystem& system, const FlatteningSystem::Boundary& boundary,
             const StopCheck& stop);
  // By unknown, sorted, without zeros.
  Functional load_of(const Functional& functional) const;

  std::vector<Index> unknown_;  // 3 #F: where the half-edge starts, -1 on the outer loop
  std::shared_ptr<FlatteningSystem::Factor> factor_;
  Vec chi_;
  double strain_ = 0;
};

// The mean square stretch of a map [SSGH01] with that strain, to the order in which it is known.
double stretch_of_strain(double strain);
double strain_of_stretch(double stretch);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
