// The densities that contraction kernels see in place of a formula compiled elsewhere: batches go
// to memory, through the pointers of point_functions.h, and come back.
//
// Everything here is a template on the batch or always inlined, as in detail/contraction_kernel.h.
#pragma once

#include "majorant/energies/detail/point_functions.h"
#include "majorant/energies/internal/semidefinite_batch.h"
#include "majorant/energies/spectral.h"

namespace majorant {

template <int M, int D>
class PointwiseJacobian {
 public:
  using Function = JacobianFunction;
  static constexpr int rows = M, dims = D, size = M * D, packed = size * (size + 1) / 2;

  [[gnu::always_inline]] PointwiseJacobian(const Function& function, const PointBatch& points)
      : function_(function), points_(points) {}
  // One model for both: projection_weight says which.
  [[gnu::always_inline]] static constexpr bool defines(Curvature c) {
    return c == Curvature::Exact;
  }

  template <class T>
  T value(const T (&z)[size]) const {
    double J[size * kLanes], f[kLanes];
    for (int r = 0; r < size; ++r) z[r].store_unaligned(J + r * kLanes);
    function_.values(function_.formula, points_, J, f);
    return T::load_unaligned(f);
  }
  template <class T>
  void slope(const T (&z)[size], PointModel<T, size>& m) const {
    double J[size * kLanes], f[kLanes], g[size * kLanes];
    for (int r = 0; r < size; ++r) z[r].store_unaligned(J + r * kLanes);
    function_.slopes(function_.formula, points_, J, f, g);
    m.f = T::load_unaligned(f);
    for (int r = 0; r < size; ++r) m.g[r] = T::load_unaligned(g + r * kLanes);
  }
  template <Curvature, class T>
  void model(const T (&z)[size], double projection_weight, PointModel<T, size>& m) const {
    double J[size * kLanes], f[kLanes], g[size * kLanes], k[packed * kLanes];
    for (int r = 0; r < size; ++r) z[r].store_unaligned(J + r * kLanes);
    function_.models(function_.formula, points_, J, f, g, k);
    m.f = T::load_unaligned(f);
    for (int r = 0; r < size; ++r) m.g[r] = T::load_unaligned(g + r * kLanes);
    for (int r = 0; r < packed; ++r) m.k[r] = T::load_unaligned(k + r * kLanes);
    if (projection_weight > 0) make_semidefinite_batch<size>(projection_weight, m.k);
  }

  // J is its own coordinates.
  template <class T>
  static void to_coordinates(const T (&J)[size], T (&z)[size]) {
    for (int r = 0; r < size; ++r) z[r] = J[r];
  }
  template <class T>
  static void gradient_to_jacobian(const T* g, T* out) {
    for (int r = 0; r < size; ++r) out[r] = g[r];
  }
  template <class T>
  static void curvature_to_jacobian(const T* k, T* out) {
    for (int r = 0; r < packed; ++r) out[r] = k[r];
  }

 private:
  static constexpr int kLanes = PointBatch::kMost;
  const Function& function_;
  const PointBatch points_;
};

class PointwiseInvariant : public SimilarityCoordinates {
 public:
  using Function = InvariantFunction;

  [[gnu::always_inline]] PointwiseInvariant(const Function& function, const PointBatch& points)
      : function_(function), points_(points) {}
  [[gnu::always_inline]] static constexpr bool defines(Curvature) { return true; }

  template <class T>
  T value(const T (&z)[4]) const {
    double x[kLanes], y[kLanes], f[kLanes];
    (z[0] * z[0] + z[1] * z[1]).store_unaligned(x);
    (z[2] * z[2] + z[3] * z[3]).store_unaligned(y);
    function_.values(function_.formula, points_, x, y, f);
    return T::load_unaligned(f);
  }
  template <Curvature C, class T>
  void model(const T (&z)[4], double projection_weight, PointModel<T, 4>& m) const {
    const T x = z[0] * z[0] + z[1] * z[1], y = z[2] * z[2] + z[3] * z[3];
    double xs[kLanes], ys[kLanes], jets[6 * kLanes];
    x.store_unaligned(xs);
    y.store_unaligned(ys);
    function_.jets(function_.formula, points_, xs, ys, jets);
    const auto row = [&jets](int r) { return T::load_unaligned(jets + r * kLanes); };
    const IsotropicJet<T> jet{row(0), row(1), row(2), row(3), row(4), row(5)};
    if constexpr (C == Curvature::Majorizer)
      if (function_.majorants) {
        double known[kLanes];
        function_.majorants(function_.formula, points_, xs, ys, known);
        const auto majorant = [&known](const T&, const T&) { return T::load_unaligned(known); };
        return detail::write_model<C>(function_.traits, majorant, jet, x, y, z, projection_weight,
                                      m);
      }
    detail::write_model<C>(function_.traits, NoMajorant{}, jet, x, y, z, projection_weight, m);
  }

 private:
  static constexpr int kLanes = PointBatch::kMost;
  const Function& function_;
  const PointBatch points_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
