// The density that contraction kernels use in place of a formula of the invariants of volumes
// (solid_invariants.h): batches of invariants are stored to memory, passed through the pointers of
// its function, and loaded back.
//
// Every function here is a template on the batch or always inlined, as in
// detail/contraction_kernel.h.
#pragma once

#include <xsimd/xsimd.hpp>

#include "majorant/energies/detail/solid_invariant_function.h"
#include "majorant/energies/internal/point_densities.h"

namespace majorant {

// The decomposition J = U diag(s) V^T with rotations U and V, in every lane. s_3 is the smallest in
// magnitude, with the sign of det J. u[i][r], v[i][c]: entries of their columns.
template <class T>
struct SingularFrame {
  T u[3][3], v[3][3], s[3];
};

template <class T>
T dot3(const T (&a)[3], const T (&b)[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Finds V by one-sided rotations (Hestenes): the columns of J V are orthogonal to rounding,
// relative to their own lengths.
template <class T>
void find_singular_frame(const T (&z)[9], SingularFrame<T>& frame) {
  constexpr double kRounding = 1e-15;
  const T zero(0.0), one(1.0);
  T scale(0.0);
  for (const T& entry : z) scale = xsimd::max(scale, xsimd::abs(entry));
  const auto is_zero = scale == zero;
  const T inverse = one / xsimd::select(is_zero, one, scale);
  T(&a)[3][3] = frame.u;
  T(&v)[3][3] = frame.v;
  for (int i = 0; i < 3; ++i)
    for (int r = 0; r < 3; ++r) {
      a[i][r] = z[3 * r + i] * inverse;
      v[i][r] = i == r ? one : zero;
    }
  bool turned = true;
  for (int sweep = 0; turned && sweep < kMaxJacobiSweeps; ++sweep) {
    turned = false;
    for (int i = 0; i < 2; ++i)
      for (int j = i + 1; j < 3; ++j) {
        const T alpha = dot3(a[i], a[i]), beta = dot3(a[j], a[j]), gamma = dot3(a[i], a[j]);
        const auto turns = gamma * gamma > T(kRounding * kRounding) * alpha * beta;
        if (!xsimd::any(turns)) continue;
        turned = true;
        const T off = xsimd::select(turns, gamma, one);
        const T cotangent = (beta - alpha) / (off + off);  // of twice the angle
        const T size = one / (xsimd::abs(cotangent) + xsimd::sqrt(cotangent * cotangent + one));
        const T t = xsimd::select(turns, xsimd::select(cotangent < zero, -size, size), zero);
        const T c = one / xsimd::sqrt(t * t + one), s = t * c;
        for (int r = 0; r < 3; ++r) {
          const T x = a[i][r], y = a[j][r], p = v[i][r], q = v[j][r];
          a[i][r] = c * x - s * y;
          a[j][r] = s * x + c * y;
          v[i][r] = c * p - s * q;
          v[j][r] = s * p + c * q;
        }
      }
  }
  // Sorts the columns, the longest first; V stays a rotation.
  T length[3];
  for (int i = 0; i < 3; ++i) length[i] = dot3(a[i], a[i]);
  const auto order = [&](int i, int j) {
    const auto swaps = length[j] > length[i];
    for (int r = 0; r < 3; ++r) {
      const T x = a[i][r], p = v[i][r];
      a[i][r] = xsimd::select(swaps, a[j][r], x);
      a[j][r] = xsimd::select(swaps, -x, a[j][r]);
      v[i][r] = xsimd::select(swaps, v[j][r], p);
      v[j][r] = xsimd::select(swaps, -p, v[j][r]);
    }
    const T other = length[i];
    length[i] = xsimd::select(swaps, length[j], other);
    length[j] = xsimd::select(swaps, other, length[j]);
  };
  order(0, 1);
  order(1, 2);
  order(0, 1);
  // Normalizes column i; if it has no length, takes a direction orthogonal to those before.
  const auto normalize = [&](int i, const T(&otherwise)[3]) {
    const T size = xsimd::sqrt(length[i]);
    const auto has_length = size > zero;
    const T factor = one / xsimd::select(has_length, size, one);
    for (int r = 0; r < 3; ++r) a[i][r] = xsimd::select(has_length, a[i][r] * factor, otherwise[r]);
    frame.s[i] = scale * size;
  };
  const T first[3] = {one, zero, zero};
  normalize(0, first);
  // Finds a direction orthogonal to the first column [DBC17].
  const T(&w)[3] = a[0];
  const T sign = xsimd::select(w[2] < zero, -one, one), k = -one / (sign + w[2]);
  const T across[3] = {one + sign * w[0] * w[0] * k, sign * w[0] * w[1] * k, -sign * w[0]};
  normalize(1, across);
  const T third[3] = {a[0][1] * a[1][2] - a[0][2] * a[1][1], a[0][2] * a[1][0] - a[0][0] * a[1][2],
                      a[0][0] * a[1][1] - a[0][1] * a[1][0]};
  frame.s[2] = scale * dot3(third, a[2]);
  for (int r = 0; r < 3; ++r) a[2][r] = third[r];
}

// A density f(n, q, d) of volumes (solid_invariants.h).
class PointwiseSolidInvariant {
 public:
  using Function = SolidInvariantFunction;
  static constexpr int rows = 3, dims = 3, size = 9, packed = 45;

  [[gnu::always_inline]] PointwiseSolidInvariant(const Function& function, const PointBatch& points)
      : function_(function), points_(points) {}
  // Returns whether the model is Exact, as in PointwiseJacobian.
  [[gnu::always_inline]] static constexpr bool defines(Curvature c) {
    return c == Curvature::Exact;
  }

  template <class T>
  T value(const T (&z)[size]) const {
    double invariants[3 * kLanes], f[kLanes];
    T cofactors[size];
    store_invariants(z, cofactors, invariants);
    function_.values(function_.formula, points_, invariants, f);
    return T::load_unaligned(f);
  }
  template <class T>
  void slope(const T (&z)[size], PointModel<T, size>& m) const {
    Jet<T> jet;
    write_slope(z, jet, m);
  }
  template <Curvature, class T>
  void model(const T (&z)[size], double projection_weight, PointModel<T, size>& m) const {
    Jet<T> jet;
    write_slope(z, jet, m);
    // A matrix with an entry that is not finite becomes zero.
    T nothing(0.0);
    for (const T& entry : z) nothing += entry * T(0.0);
    for (const T& entry : jet.d) nothing += entry * T(0.0);
    for (const T& entry : jet.h) nothing += entry * T(0.0);
    const auto is_finite = nothing == T(0.0);
    for (T& entry : jet.d) entry = xsimd::select(is_finite, entry, T(0.0));
    for (T& entry : jet.h) entry = xsimd::select(is_finite, entry, T(0.0));
    T finite[size];
    for (int r = 0; r < size; ++r) finite[r] = xsimd::select(is_finite, z[r], T(0.0));
    write_curvature(finite, jet, projection_weight, m.k);
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
  // The first and packed second derivatives by n, q, d.
  template <class T>
  struct Jet {
    T d[3], h[6];
  };

  // Returns entry r of a symmetric product of a and b; that of J with itself is twice its
  // cofactors.
  template <class T>
  static T cross_entry(const T (&a)[size], const T (&b)[size], int r) {
    const int i = (r / 3 + 1) % 3, k = (r / 3 + 2) % 3, j = (r % 3 + 1) % 3, l = (r % 3 + 2) % 3;
    return a[3 * i + j] * b[3 * k + l] - a[3 * i + l] * b[3 * k + j] + b[3 * i + j] * a[3 * k + l] -
           b[3 * i + l] * a[3 * k + j];
  }
  template <class T>
  static void store_invariants(const T (&z)[size], T (&cofactors)[size], double* invariants) {
    T n(0.0), q(0.0);
    for (int r = 0; r < size; ++r) {
      const int i = (r / 3 + 1) % 3, k = (r / 3 + 2) % 3, j = (r % 3 + 1) % 3, l = (r % 3 + 2) % 3;
      cofactors[r] = z[3 * i + j] * z[3 * k + l] - z[3 * i + l] * z[3 * k + j];
      n += z[r] * z[r];
      q += cofactors[r] * cofactors[r];
    }
    const T d = z[0] * cofactors[0] + z[1] * cofactors[1] + z[2] * cofactors[2];
    n.store_unaligned(invariants);
    q.store_unaligned(invariants + kLanes);
    d.store_unaligned(invariants + 2 * kLanes);
  }
  template <class T>
  void write_slope(const T (&z)[size], Jet<T>& jet, PointModel<T, size>& m) const {
    double invariants[3 * kLanes], numbers[10 * kLanes];
    T cofactors[size];
    store_invariants(z, cofactors, invariants);
    function_.jets(function_.formula, points_, invariants, numbers);
    const auto row = [&numbers](int r) { return T::load_unaligned(numbers + r * kLanes); };
    m.f = row(0);
    for (int k = 0; k < 3; ++k) jet.d[k] = row(1 + k);
    for (int k = 0; k < 6; ++k) jet.h[k] = row(4 + k);
    const T by_n = jet.d[0] + jet.d[0], by_q = jet.d[1] + jet.d[1];
    for (int r = 0; r < size; ++r)
      m.g[r] = by_n * z[r] + by_q * cross_entry(cofactors, z, r) + jet.d[2] * cofactors[r];
  }

  template <class T>
  static void write_curvature(const T (&z)[size], const Jet<T>& jet, double projection_weight,
                              T (&k)[packed]) {
    SingularFrame<T> frame;
    find_singular_frame(z, frame);
    const T(&s)[3] = frame.s;
    const T two(2.0), zero(0.0), taken(projection_weight);
    T square[3], slopes[3][3];  // of n, q and d by the singular values
    for (int i = 0; i < 3; ++i) square[i] = s[i] * s[i];
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, l = (i + 2) % 3;
      slopes[0][i] = two * s[i];
      slopes[1][i] = two * s[i] * (square[j] + square[l]);
      slopes[2][i] = s[j] * s[l];
    }
    T along[6];  // second derivatives by the singular values, packed
    for (int i = 0, p = 0; i < 3; ++i)
      for (int j = 0; j <= i; ++j, ++p) {
        along[p] = zero;
        for (int a = 0; a < 3; ++a) {
          T sum = zero;
          for (int b = 0; b < 3; ++b)
            sum += jet.h[a >= b ? a * (a + 1) / 2 + b : b * (b + 1) / 2 + a] * slopes[b][j];
          along[p] += slopes[a][i] * sum;
        }
        if (i == j)
          along[p] += two * (jet.d[0] + jet.d[1] * (square[(i + 1) % 3] + square[(i + 2) % 3]));
        else
          along[p] += T(4.0) * jet.d[1] * s[i] * s[j] + jet.d[2] * s[3 - i - j];
      }
    if (projection_weight > 0) make_semidefinite_batch<3>(projection_weight, along);
    // The matrices u_i v_j^T, at 3 i + j.
    T w[9][size];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        for (int r = 0; r < size; ++r) w[3 * i + j][r] = frame.u[i][r / 3] * frame.v[j][r % 3];
    for (int p = 0; p < packed; ++p) k[p] = zero;
    const auto add = [&k](const T(&left)[size], const T(&right)[size]) {
      for (int r = 0, p = 0; r < size; ++r)
        for (int q = 0; q <= r; ++q, ++p) k[p] = xsimd::fma(left[r], right[q], k[p]);
    };
    T right[size];
    for (int i = 0; i < 3; ++i) {
      for (int r = 0; r < size; ++r) {
        right[r] = zero;
        for (int j = 0; j < 3; ++j)
          right[r] = xsimd::fma(along[i >= j ? i * (i + 1) / 2 + j : j * (j + 1) / 2 + i],
                                w[4 * j][r], right[r]);
      }
      add(w[4 * i], right);
    }
    for (int i = 0; i < 2; ++i)
      for (int j = i + 1; j < 3; ++j) {
        const int l = 3 - i - j;
        const T middle = two * (jet.d[0] + jet.d[1] * square[l]);
        const T change = two * jet.d[1] * s[i] * s[j] + jet.d[2] * s[l];
        T turn = middle + change, flip = middle - change;
        turn -= taken * xsimd::min(turn, zero);
        flip -= taken * xsimd::min(flip, zero);
        const T same = (flip + turn) * T(0.5), cross = (flip - turn) * T(0.5);
        const T(&p)[size] = w[3 * i + j], (&q)[size] = w[3 * j + i];
        for (int r = 0; r < size; ++r) right[r] = same * p[r] + cross * q[r];
        add(p, right);
        for (int r = 0; r < size; ++r) right[r] = same * q[r] + cross * p[r];
        add(q, right);
      }
  }

  const Function& function_;
  const PointBatch points_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
