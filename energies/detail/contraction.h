// The interface between energy terms and contraction kernels: plain views, no templates, so that a
// kernel may be compiled for another instruction set than its caller.
#pragma once

#include "majorant/elements/detail/contraction_entries.h"
#include "majorant/framework/curvature.h"

namespace majorant {

// A ContractionTable on one rule, multiplied by the quadrature weights. D: reference dimension.
struct ContractionView {
  int nodes, points, shape_gradient_count, gradient_product_count, direction_count, gradient_count;
  const double* directions;               // direction_count by D
  const double* weights;                  // points
  const double* shape_gradient;           // points by shape_gradient_count
  const double* weighted_shape_gradient;  // shape_gradient * weight
  const double*
      weighted_gradient_product;  // points by gradient_product_count, gradient_product * weight
  const GradientEntry* gradient;
  const HessianEntry* hessian;
  const int* pair_starts;
  // The polynomials inside an element on which the dilatation of a solid is projected, orthonormal
  // by the weights of the rule: points by mode_count. With curved rest shapes they differ between
  // elements and are rows of BatchView::rest.
  int mode_count;
  const double* modes;
};

// Elements of one batch, structure of arrays with stride `stride`; entries beyond `count` up to the
// next multiple of 8 repeat the last element. M: unknowns per node.
struct BatchView {
  static constexpr int stride = 128;
  int count;
  const int* elements;  // count
  const double* x;      // M rows per node
  // Constant rest shapes: D^2 + 1 rows, inverse rest Jacobian row by row and measure. Curved ones:
  // as many rows for every quadrature point, each followed by mode_count more.
  const double* rest;
  int rest_rows_per_point;  // 0: constant
};

// A density at one Jacobian: value, gradient and packed lower triangle of the curvature by N
// coordinates of J.
template <class T, int N>
struct PointModel {
  T f;
  T g[N];
  T k[N * (N + 1) / 2];  // entry (i, j), i >= j, at i (i + 1) / 2 + j
};

// The triangles around one vertex v of a planar map of degree 1, for steps of that vertex alone.
// Rows have `stride` doubles; entries beyond `count` up to the next multiple of 8 repeat the last
// triangle with weight 0. A triangle is (v, a, b), counterclockwise; its Jacobian is
//     J = (a - v) ga^T + (b - v) gb^T
// with the gradients of the hat functions of a and b in the frame of the rest shape.
struct StarView {
  static constexpr int stride = 64;
  enum Row { GaX, GaY, GbX, GbY, Weight, AX, AY, BX, BY, Rows };
  int count;           // at most stride
  const double* rows;  // Rows of them
};

// The sum of weight * density over a star, its derivatives by v, and a lower bound of the smallest
// twice-area of its triangles, with a, b and v as they are. The bound is positive if all of them
// are certainly counterclockwise.
struct StarModel {
  double f, gx, gy, hxx, hxy, hyy, area_margin;
};

// Returns whether no run uses the model by default.
[[gnu::always_inline]] constexpr bool for_comparisons(Curvature model) {
  return model != Curvature::Projected && model != Curvature::Exact;
}

// The kernels of one density. `density` is the object for which they were made.
struct DensityKernels {
  int rows, dims;  // of the Jacobian: M by D
  // Computes f: measure * mean density per element.
  void (*values)(const void* density, const ContractionView&, const BatchView&, double* scratch,
                 double* f);
  // Computes value, gradient and Hessian; the curvature is ignored if `hessian` is null.
  void (*local)(const void* density, const ContractionView&, const BatchView&,
                BlendedCurvature curvature, double* scratch, double* f, double* gradient,
                double* hessian);
  // Returns the number of doubles of scratch for either kernel.
  int (*scratch_size)(const ContractionView&);
  // The kernel for stars, for densities of planar maps (2 by 2), with the exact Hessian; null for
  // other densities.
  void (*star)(const void* density, const StarView&, double vx, double vy, StarModel&) = nullptr;
  // The kernel `local` for models that are for_comparisons(), if `local` itself has no code for
  // them: the library compiles them for the baseline instruction set alone. Null if `local` has all
  // models.
  decltype(local) local_of_comparisons = nullptr;
  // Computes the pressure at every point of the rule, a row of BatchView::stride a point; null for
  // densities whose dilatation is not projected.
  void (*pressures)(const void* density, const ContractionView&, const BatchView&, double* scratch,
                    double* p) = nullptr;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
