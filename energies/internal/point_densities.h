// Densities that contraction kernels use in place of a formula compiled elsewhere: batches are
// stored to memory, passed through the pointers of point_functions.h, and loaded back.
//
// Every function here is a template on the batch or always inlined, as in
// detail/contraction_kernel.h.
#pragma once

#include <xsimd/xsimd.hpp>

#include "majorant/energies/detail/point_functions.h"
#include "majorant/energies/spectral.h"

namespace majorant {

// make_semidefinite_batch() makes small symmetric matrices semidefinite, one in each lane of SIMD
// batches, as framework/detail/packed_symmetric.h does for one matrix. Lanes are independent: the
// result of one does not depend on the others.

// Entries below this fraction of the largest one count as 0, as with kZeroPivot.
inline constexpr double kZeroEntry = 1e-14;
// Upper bound on sweeps over all pairs of rows; rotations converge quadratically, in 6 or 7 sweeps.
inline constexpr int kMaxJacobiSweeps = 30;

template <int N, class T>
using PackedBatch = T[N * (N + 1) / 2];

// Returns the lanes that a factorization proves to have no eigenvalue below 0. A "no" may be wrong.
template <int N, class T>
auto semidefinite_lanes(const PackedBatch<N, T>& k, const T& zero) {
  T a[N][N];
  for (int i = 0, p = 0; i < N; ++i)
    for (int j = 0; j <= i; ++j, ++p) a[i][j] = k[p];
  auto holds = a[0][0] == a[0][0];
  for (int c = 0; c < N; ++c) {
    const auto positive = a[c][c] > zero;
    holds = holds && a[c][c] >= -zero;
    const T inverse = xsimd::select(positive, T(1.0) / a[c][c], T(0.0));
    for (int i = c + 1; i < N; ++i) {
      holds = holds && (positive || xsimd::abs(a[i][c]) <= zero);
      const T factor = a[i][c] * inverse;
      for (int j = c + 1; j <= i; ++j) a[i][j] -= factor * a[j][c];
    }
  }
  return holds;
}

// Applies one of Jacobi's rotations in the lanes that `turns`: a = V^T a V without a(i, j), with V
// accumulated in v.
template <int N, class T, class Lanes>
void rotate(int i, int j, const Lanes& turns, T (&a)[N][N], T (&v)[N][N]) {
  const T one(1.0), zero(0.0), off = xsimd::select(turns, a[i][j], one);
  const T cotangent = (a[j][j] - a[i][i]) / (off + off);  // of twice the angle
  const T size = one / (xsimd::abs(cotangent) + xsimd::sqrt(cotangent * cotangent + one));
  const T t = xsimd::select(turns, xsimd::select(cotangent < zero, -size, size), zero);
  const T c = one / xsimd::sqrt(t * t + one), s = t * c;
  const T low = a[i][i] - t * a[i][j], high = a[j][j] + t * a[i][j];
  const T rest = xsimd::select(turns, zero, a[i][j]);
  for (int m = 0; m < N; ++m) {
    const T x = a[m][i], y = a[m][j], p = v[m][i], q = v[m][j];
    a[m][i] = a[i][m] = c * x - s * y;
    a[m][j] = a[j][m] = s * x + c * y;
    v[m][i] = c * p - s * q;
    v[m][j] = s * p + c * q;
  }
  a[i][i] = low;
  a[j][j] = high;
  a[i][j] = a[j][i] = rest;
}

// Removes the fraction `projection_weight` of the negative eigenvalues
// (BlendedCurvature::projection_weight; 1 sets them to 0). A matrix with an entry that is not
// finite becomes zero.
template <int N, class T>
void make_semidefinite_batch(double projection_weight, PackedBatch<N, T>& k) {
  T nothing(0.0), largest(0.0);
  for (const T& entry : k) nothing += entry * T(0.0);
  for (T& entry : k) {
    entry = xsimd::select(nothing == T(0.0), entry, T(0.0));
    largest = xsimd::max(largest, xsimd::abs(entry));
  }
  const T zero = T(kZeroEntry) * largest;
  const auto holds = semidefinite_lanes<N, T>(k, zero);
  if (xsimd::all(holds)) return;

  T a[N][N], v[N][N];
  for (int i = 0, p = 0; i < N; ++i)
    for (int j = 0; j <= i; ++j, ++p) {
      a[i][j] = a[j][i] = k[p];
      v[i][j] = v[j][i] = T(i == j ? 1.0 : 0.0);
    }
  bool turned = true;
  for (int sweep = 0; turned && sweep < kMaxJacobiSweeps; ++sweep) {
    turned = false;
    for (int i = 1; i < N; ++i)
      for (int j = 0; j < i; ++j) {
        const auto turns = !holds && xsimd::abs(a[i][j]) > zero;
        if (!xsimd::any(turns)) continue;
        rotate<N>(i, j, turns, a, v);
        turned = true;
      }
  }
  for (int e = 0; e < N; ++e) {
    const T taken =
        xsimd::select(holds, T(0.0), T(projection_weight) * xsimd::min(a[e][e], T(0.0)));
    for (int i = 0, p = 0; i < N; ++i)
      for (int j = 0; j <= i; ++j, ++p) k[p] -= taken * v[i][e] * v[j][e];
  }
}

template <int M, int D>
class PointwiseJacobian {
 public:
  using Function = JacobianFunction;
  static constexpr int rows = M, dims = D, size = M * D, packed = size * (size + 1) / 2;

  [[gnu::always_inline]] PointwiseJacobian(const Function& function, const PointBatch& points)
      : function_(function), points_(points) {}
  // Returns whether the model is Exact, which stands for Projected as well: projection_weight
  // distinguishes the two.
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

  // The coordinates of J are J itself.
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

// A solid: W with the functions of PointwiseJacobian, and U.
template <int D>
class PointwiseSolid : public PointwiseJacobian<D, D> {
 public:
  using Function = SolidFunction;

  [[gnu::always_inline]] PointwiseSolid(const Function& function, const PointBatch& points)
      : PointwiseJacobian<D, D>(function.shape, points), function_(function), points_(points) {}

  // Returns U, U' and U'' as f, g and k.
  template <class T>
  PointModel<T, 1> volume(const T& theta) const {
    constexpr int kLanes = PointBatch::kMost;
    double at[kLanes], jets[3 * kLanes];
    theta.store_unaligned(at);
    function_.jets(function_.volume, points_, at, jets);
    return {T::load_unaligned(jets),
            {T::load_unaligned(jets + kLanes)},
            {T::load_unaligned(jets + 2 * kLanes)}};
  }

 private:
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
