// The moving log-barrier of an edge flip, which makes determinants inside a curved quadrilateral
// positive.
//
// A quadrilateral is a grid of (n+1)^2 points, point (p, q) in row q (n+1) + p. It is cut along p =
// q into two Bezier triangles of degree n with corners (0,0) (n,n) (0,n), the upper half, and (n,n)
// (0,0) (n,0), the lower one. Its 4n outer points stay, the (n-1)^2 inner ones are variables. B_l
// are the Bernstein coefficients of det J of both halves (method.md E6), each divided by the
// determinant of its straight-sided triangle, so that 1 is best. The objective is
//
//     F_mu = sum_l log^2((B_l - mu) / (1 - mu)) + (B_l - 1)^2,   mu < min B_l,
//
// [TGRL13: Toulorge, Geuzaine, Remacle, Lambrechts, Robust untangling of curvilinear meshes, JCP
// 254, 2013]. mu is raised to 0 as the smallest B_l grows (method.md section 6).
//
//   Points2 grid(16, 2);                                       // 16 by 2 for degree 3
//   double worst = MovingBarrier::of_degree(3).minimize(grid); // > 0: both halves are injective
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "majorant/elements/bernstein_space.h"
#include "majorant/framework/types.h"

namespace majorant {

class MovingBarrier {
 public:
  static constexpr int kMaxDegree = BezierTriangleSpace::kMaxDegree;
  // Returns shared tables, built once. Throws std::out_of_range unless degree is 1..kMaxDegree.
  static const MovingBarrier& of_degree(int degree);

  int degree() const { return degree_; }
  int variable_count() const { return 2 * (degree_ - 1) * (degree_ - 1); }
  int coefficient_count() const { return 2 * coefficients_per_half_; }

  // Returns the determinants of the straight-sided upper and lower half: twice their areas.
  std::array<double, 2> straight_determinants(const Points2& grid) const;
  // Returns B_l, the upper half's first, each half's in the order of TriangleIndices of degree 2n-2
  // for the corners above. Straight determinants must not be 0.
  Vec coefficients(const Points2& grid) const;

  // F_mu with its gradient and Hessian by u, v of the inner points, (p, q) = (1,1), (2,1), ...
  // gauss_newton: the Hessian without second derivatives of B_l, positive semidefinite.
  struct Model {
    double value = 0;
    Vec gradient;
    Eigen::MatrixXd gauss_newton, hessian;
  };
  Model model(const Points2& grid, double mu) const;

  // Moves the inner points until all B_l are positive and some further steps have been taken, or
  // until there is no progress. Returns the smallest B_l. Both straight determinants must be
  // positive. Affine maps of the grid change the result by rounding only.
  double minimize(Points2& grid) const;

 private:
  // A contribution to B_l of a half: weight * cross(point a, point b) / straight determinant.
  struct Target {
    int coefficient;
    double weight;
  };
  struct Pair {
    int a, b;                      // points of the grid
    int variable_a, variable_b;    // indices among the inner points, -1: outer
    int half;                      // 0: upper, 1: lower
    std::array<Target, 3> target;  // the first `targets` are used
    int targets;
  };
  struct Workspace;

  explicit MovingBarrier(int degree);
  void add_pairs();
  int row(int half, int node) const;  // of a node of a half
  int inner_point(int row) const;     // -1: outer
  template <class Add>
  void for_targets(const Points2& grid, const Add& add) const;
  void evaluate(const Points2& grid, Vec& b) const;
  void differentiate(const Points2& grid, Eigen::MatrixXd& derivatives) const;
  void fill_model(const Points2& grid, double mu, Workspace& w) const;
  double step(Points2& grid, double mu, Workspace& w) const;
  void move(Points2& grid, const Vec& direction, double t) const;

  int degree_, coefficients_per_half_;
  std::vector<Pair> pairs_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
