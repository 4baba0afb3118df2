// The two ends of the contraction (contraction_kernel.h), for a batch of elements side by side:
// Jacobians at quadrature points, and the way from gradient_products over those points back to
// local gradients and Hessians. Functions are templates on Arch for the reason given there.
#pragma once

#include <xsimd/xsimd.hpp>

#include "majorant/energies/detail/contraction.h"

namespace majorant::kernel {

template <class Arch>
using Batch = xsimd::batch<double, Arch>;

inline constexpr int kMaxDirections = 4;

[[gnu::always_inline]] constexpr int packed(int n) { return n * (n + 1) / 2; }
[[gnu::always_inline]] constexpr int packed_index(int i, int j) {
  return i >= j ? packed(i) + j : packed(j) + i;
}

// One batch of elements: derivative directions mapped to the rest frame, and control values of J.
// If the rest shape is constant they are in the coordinates of the density, else of the reference
// Jacobian.
template <class Arch, class Density>
struct Frame {
  using B = Batch<Arch>;
  static constexpr int M = Density::rows, D = Density::dims, N = M * D;
  B direction[kMaxDirections][D];
  B scaled[kMaxDirections][D];  // times the measure
  const double* rest;
  int rest_step;  // doubles from one quadrature point's rest shape to the next; 0: constant
  B* z;           // shape_gradient_count by N

  Frame(const ContractionView& t, const BatchView& c, int at, B* scratch)
      : rest(c.rest + at), rest_step(c.rest_rows_per_point * BatchView::stride), z(scratch) {
    const bool constant = rest_step == 0;
    const B measure = constant ? load_rest(0, D * D) : B(1.0);
    for (int a = 0; a < t.direction_count; ++a)
      for (int j = 0; j < D; ++j) {
        direction[a][j] = B(constant ? 0.0 : t.directions[D * a + j]);
        for (int i = 0; constant && i < D; ++i)
          direction[a][j] += B(t.directions[D * a + i]) * load_rest(0, i * D + j);
        scaled[a][j] = measure * direction[a][j];
      }
    for (int k = 0; k < N * t.shape_gradient_count; ++k) z[k] = B(0.0);
    for (int q = 0; q < t.gradient_count; ++q) {
      const GradientEntry& e = t.gradient[q];
      const double* x = c.x + M * e.node * BatchView::stride + at;
      B* J = z + N * e.shape_gradient;
      for (int p = 0; p < M; ++p) {
        const B u = B::load_unaligned(x + p * BatchView::stride) * B(e.coefficient);
        for (int i = 0; i < D; ++i)
          J[p * D + i] = xsimd::fma(u, direction[e.direction][i], J[p * D + i]);
      }
    }
    for (int k = 0; constant && k < t.shape_gradient_count; ++k) in_coordinates(z + N * k);
  }

  B load_rest(int point, int row) const {
    return B::load_unaligned(rest + point * rest_step + row * BatchView::stride);
  }

  static void in_coordinates(B* jacobian) {
    B J[N], out[N];
    for (int r = 0; r < N; ++r) J[r] = jacobian[r];
    Density::to_coordinates(J, out);
    for (int r = 0; r < N; ++r) jacobian[r] = out[r];
  }

  // Computes the coordinates of J at quadrature point l.
  void at_point(const ContractionView& t, int l, B (&out)[N]) const {
    const double* first = t.shape_gradient + l * t.shape_gradient_count;
    for (int r = 0; r < N; ++r) out[r] = B(first[0]) * z[r];
    for (int k = 1; k < t.shape_gradient_count; ++k)
      for (int r = 0; r < N; ++r) out[r] = xsimd::fma(B(first[k]), z[N * k + r], out[r]);
    if (rest_step == 0) return;
    B J[N];
    for (int p = 0; p < M; ++p)
      for (int j = 0; j < D; ++j) {
        J[p * D + j] = B(0.0);
        for (int i = 0; i < D; ++i) J[p * D + j] += out[p * D + i] * load_rest(l, i * D + j);
      }
    Density::to_coordinates(J, out);
  }

  B weight(const ContractionView& t, int l) const {
    const B w(t.weights[l]);
    return rest_step == 0 ? w : w * load_rest(l, D * D);
  }
  B measure() const { return rest_step == 0 ? load_rest(0, D * D) : B(1.0); }
  // Returns the value of polynomial a of those on which the dilatation is projected.
  B mode(const ContractionView& t, int l, int a) const {
    return rest_step == 0 ? B(t.modes[l * t.mode_count + a]) : load_rest(l, D * D + 1 + a);
  }

  // For curved rest shapes, transform gradient and curvature from coordinates to the reference
  // Jacobian, times the measure at the point.
  void pull_back_gradient(int l, B (&g)[N]) const {
    const B measure_here = load_rest(l, D * D);
    B J[N];
    Density::gradient_to_jacobian(g, J);
    for (int p = 0; p < M; ++p)
      for (int i = 0; i < D; ++i) {
        B sum(0.0);
        for (int j = 0; j < D; ++j) sum += J[p * D + j] * load_rest(l, i * D + j);
        g[p * D + i] = measure_here * sum;
      }
  }
  void pull_back_curvature(int l, B (&k)[packed(N)]) const {
    const B measure_here = load_rest(l, D * D);
    B J[packed(N)];
    Density::curvature_to_jacobian(k, J);
    for (int p = 0; p < M; ++p)
      for (int q = 0; q <= p; ++q) {
        B half[D][D];  // K^{pq} M^T
        for (int i = 0; i < D; ++i)
          for (int b = 0; b < D; ++b) {
            half[i][b] = B(0.0);
            for (int j = 0; j < D; ++j)
              half[i][b] += J[packed_index(p * D + i, q * D + j)] * load_rest(l, b * D + j);
          }
        for (int a = 0; a < D; ++a)
          for (int b = 0; b < (p == q ? a + 1 : D); ++b) {
            B sum(0.0);
            for (int i = 0; i < D; ++i) sum += load_rest(l, a * D + i) * half[i][b];
            k[packed_index(p * D + a, q * D + b)] = measure_here * sum;
          }
      }
  }
};

// Writes entry i of the local gradient to out + i stride.
template <class Arch, class Density>
void write_gradient(const Frame<Arch, Density>& frame, const ContractionView& t,
                    const Batch<Arch>* g, double* out, int stride) {
  using B = Batch<Arch>;
  constexpr int M = Density::rows, D = Density::dims, N = M * D;
  for (int i = 0; i < M * t.nodes; ++i) B(0.0).store_unaligned(out + i * stride);
  for (int q = 0; q < t.gradient_count; ++q) {
    const GradientEntry& e = t.gradient[q];
    B J[N];
    for (int r = 0; r < N; ++r) J[r] = g[N * e.shape_gradient + r];
    if (frame.rest_step == 0) Density::gradient_to_jacobian(g + N * e.shape_gradient, J);
    const B* d = frame.scaled[e.direction];
    double* x = out + M * e.node * stride;
    for (int p = 0; p < M; ++p, x += stride) {
      B sum = J[p * D] * d[0];
      for (int i = 1; i < D; ++i) sum = xsimd::fma(J[p * D + i], d[i], sum);
      xsimd::fma(B(e.coefficient), sum, B::load_unaligned(x)).store_unaligned(x);
    }
  }
}

// Transforms one gradient_product of the curvature to blocks of direction pairs, for components p
// <= q of the image: s[packed_index(q, p)][a][b] = measure * dir_a^T K^{pq} dir_b.
template <class Arch, class Density>
void to_directions(const Frame<Arch, Density>& frame, int directions, const Batch<Arch>* k,
                   Batch<Arch>* s) {
  using B = Batch<Arch>;
  constexpr int M = Density::rows, D = Density::dims, N = M * D;
  B K[packed(N)];
  for (int r = 0; r < packed(N); ++r) K[r] = k[r];
  if (frame.rest_step == 0) Density::curvature_to_jacobian(k, K);
  for (int q = 0; q < M; ++q)
    for (int p = 0; p <= q; ++p, s += directions * directions)
      for (int b = 0; b < directions; ++b) {
        B r[D];
        for (int i = 0; i < D; ++i) {
          r[i] = B(0.0);
          for (int j = 0; j < D; ++j)
            r[i] = xsimd::fma(K[packed_index(p * D + i, q * D + j)], frame.direction[b][j], r[i]);
        }
        for (int a = 0; a < directions; ++a) {
          B sum = frame.scaled[a][0] * r[0];
          for (int i = 1; i < D; ++i) sum = xsimd::fma(frame.scaled[a][i], r[i], sum);
          s[a * directions + b] = sum;
        }
      }
}

template <class Arch, int M>
void write_hessian(const ContractionView& t, const Batch<Arch>* s, double* out, int at) {
  using B = Batch<Arch>;
  const int n = t.direction_count, square = n * n;
  for (int i = 0, pair = 0; i < t.nodes; ++i)
    for (int j = 0; j <= i; ++j, ++pair) {
      B h[M][M];
      for (int p = 0; p < M; ++p)
        for (int q = 0; q < M; ++q) h[p][q] = B(0.0);
      for (int e = t.pair_starts[pair]; e < t.pair_starts[pair + 1]; ++e) {
        const HessianEntry& entry = t.hessian[e];
        const B* m = s + packed(M) * square * entry.gradient_product;
        const B w(entry.coefficient);
        const int ab = entry.direction_i * n + entry.direction_j;
        const int ba = entry.direction_j * n + entry.direction_i;
        for (int p = 0; p < M; ++p)
          for (int q = 0; q < M; ++q)
            h[p][q] = xsimd::fma(w, m[packed_index(p, q) * square + (p <= q ? ab : ba)], h[p][q]);
      }
      for (int p = 0; p < M; ++p)
        for (int q = 0; q < (i == j ? p + 1 : M); ++q)
          h[p][q].store_unaligned(out + packed_index(M * i + p, M * j + q) * BatchView::stride +
                                  at);
    }
}

}  // namespace majorant::kernel

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
