// The contraction of solids whose dilatation is projected inside each element:
//     E = sum_e integral W(J) + U(theta),  theta = sum_a phi_a c_a,  c_a = integral phi_a det J
// with phi_a orthonormal on the element (detail/dilatation_modes.h). With the pressure
// p = sum_a phi_a integral phi_a U'(theta) the derivatives are
//     dE  = integral (W' + p det') : dJ
//     d2E = integral dJ : (W'' + p det'') : dJ + sum_ab dc_a dc_b integral phi_a phi_b U''(theta)
// so each point has a curvature like that of any density, and the element has an additional one of
// low rank, which is positive semidefinite if U is convex.
//
// Curvature::Projected is clamped W'' and clamped U'', without p det'': a Gauss-Newton model of the
// volume. While volumes are wrong, p is as large as the bulk modulus and unrelated to the pressure
// at the minimum; with p det'' in the model, steps would be shorter the less compressible a
// material is. Blends have the fraction 1 - t of it. At rest p is 0, so nothing is lost.
//
// Every function here is a template on Arch, as in detail/contraction_kernel.h.
#pragma once

#include <xsimd/xsimd.hpp>

#include "majorant/energies/detail/contraction_kernel.h"
#include "majorant/energies/detail/determinant_derivatives.h"
#include "majorant/energies/internal/point_densities.h"

namespace majorant::kernel {

// The number of polynomials of degree 2 in three dimensions.
inline constexpr int kMaxModes = 10;

// Computes theta at every point.
template <class Arch, class Solid>
[[gnu::always_inline]] inline void project_dilatation(const Frame<Arch, Solid>& frame,
                                                      const ContractionView& t,
                                                      Batch<Arch>* theta) {
  using B = Batch<Arch>;
  B c[kMaxModes], z[Solid::size];
  for (int a = 0; a < t.mode_count; ++a) c[a] = B(0.0);
  for (int l = 0; l < t.points; ++l) {
    frame.at_point(t, l, z);
    const B weighted = frame.weight(t, l) * determinant_of<Solid::dims>(z);
    for (int a = 0; a < t.mode_count; ++a) c[a] += weighted * frame.mode(t, l, a);
  }
  for (int l = 0; l < t.points; ++l) {
    theta[l] = B(0.0);
    for (int a = 0; a < t.mode_count; ++a) theta[l] += c[a] * frame.mode(t, l, a);
  }
}

// Computes the volume part of an element. Returns its mean energy, replaces theta by p at every
// point, and sets the integrals of phi_a phi_b U''.
template <class Arch, class Solid>
[[gnu::always_inline]] inline Batch<Arch> add_volume(const Solid& solid,
                                                     const Frame<Arch, Solid>& frame,
                                                     const ContractionView& t,
                                                     double projection_weight, Batch<Arch>* theta,
                                                     Batch<Arch> (&curvature)[packed(kMaxModes)]) {
  using B = Batch<Arch>;
  B sum(0.0), s[kMaxModes];
  for (int a = 0; a < t.mode_count; ++a) s[a] = B(0.0);
  for (int k = 0; k < packed(t.mode_count); ++k) curvature[k] = B(0.0);
  for (int l = 0; l < t.points; ++l) {
    const PointModel<B, 1> u = solid.volume(theta[l]);
    const B weight = frame.weight(t, l), slope = weight * u.g[0];
    const B bent = weight * xsimd::max(u.k[0], B(1 - projection_weight) * u.k[0]);
    sum += weight * u.f;
    for (int a = 0, k = 0; a < t.mode_count; ++a) {
      const B mode = frame.mode(t, l, a);
      s[a] += slope * mode;
      for (int b = 0; b <= a; ++b, ++k) curvature[k] += bent * mode * frame.mode(t, l, b);
    }
  }
  for (int l = 0; l < t.points; ++l) {
    theta[l] = B(0.0);
    for (int a = 0; a < t.mode_count; ++a) theta[l] += s[a] * frame.mode(t, l, a);
  }
  return sum;
}

template <class Arch, class Solid>
[[gnu::flatten]] void solid_values(const void* object, const ContractionView& t, const BatchView& c,
                                   double* scratch, double* f) {
  using B = Batch<Arch>;
  constexpr int kLanes = static_cast<int>(B::size);
  B* z_control = reinterpret_cast<B*>(scratch);
  B* theta = z_control + Solid::size * t.shape_gradient_count;
  for (int at = 0; at < c.count; at += kLanes) {
    const auto& solid = density_on<Solid>(object, c.elements + at, c.count - at, kLanes);
    const Frame<Arch, Solid> frame(t, c, at, z_control);
    project_dilatation(frame, t, theta);
    B sum(0.0), z[Solid::size];
    for (int l = 0; l < t.points; ++l) {
      frame.at_point(t, l, z);
      const B energy = solid.value(z) + solid.volume(theta[l]).f;
      sum += frame.weight(t, l) * xsimd::select(energy == energy, energy, B(1.0) / B(0.0));
    }
    (sum * frame.measure()).store_unaligned(f + at);
  }
}

template <class Arch, class Solid>
[[gnu::flatten]] void solid_pressures(const void* object, const ContractionView& t,
                                      const BatchView& c, double* scratch, double* p) {
  using B = Batch<Arch>;
  constexpr int kLanes = static_cast<int>(B::size);
  B* z_control = reinterpret_cast<B*>(scratch);
  B* theta = z_control + Solid::size * t.shape_gradient_count;
  B curvature[packed(kMaxModes)];
  for (int at = 0; at < c.count; at += kLanes) {
    const auto& solid = density_on<Solid>(object, c.elements + at, c.count - at, kLanes);
    const Frame<Arch, Solid> frame(t, c, at, z_control);
    project_dilatation(frame, t, theta);
    add_volume<Arch, Solid>(solid, frame, t, 0, theta, curvature);
    for (int l = 0; l < t.points; ++l) theta[l].store_unaligned(p + l * BatchView::stride + at);
  }
}

// Adds the part of the Hessian that couples points: dc_a dc_b.
template <class Arch>
[[gnu::always_inline]] inline void add_coupling(int size, int mode_count, const Batch<Arch>* slopes,
                                                const Batch<Arch> (&curvature)[packed(kMaxModes)],
                                                const Batch<Arch>& factor, double* hessian) {
  using B = Batch<Arch>;
  for (int i = 0; i < size; ++i) {
    B row[kMaxModes];
    for (int b = 0; b < mode_count; ++b) {
      row[b] = B(0.0);
      for (int a = 0; a < mode_count; ++a)
        row[b] += curvature[packed_index(a, b)] * slopes[a * size + i];
      row[b] *= factor;
    }
    for (int j = 0; j <= i; ++j) {
      double* entry = hessian + packed_index(i, j) * BatchView::stride;
      B sum = B::load_unaligned(entry);
      for (int b = 0; b < mode_count; ++b) sum = xsimd::fma(row[b], slopes[b * size + j], sum);
      sum.store_unaligned(entry);
    }
  }
}

template <class Arch, class Solid>
[[gnu::flatten]] void solid_local(const void* object, const ContractionView& t, const BatchView& c,
                                  BlendedCurvature blend, double* scratch, double* f,
                                  double* gradient, double* hessian) {
  using B = Batch<Arch>;
  using F = Frame<Arch, Solid>;
  constexpr int N = F::N, D = Solid::dims, kEntries = packed(N);
  constexpr int kLanes = static_cast<int>(B::size);
  const double projection_weight = hessian ? blend.projection_weight : 0;
  const int first_count = N * t.shape_gradient_count, size = D * t.nodes;
  const int blocks = packed(D) * t.direction_count * t.direction_count;
  B* z_control = reinterpret_cast<B*>(scratch);
  B* theta = z_control + first_count;
  B* g = theta + t.points;
  B* by_mode = g + first_count;  // gradients of c_a
  B* slopes = by_mode + t.mode_count * first_count;
  B* gradient_products = slopes + t.mode_count * size;
  B* s = gradient_products + kEntries * t.gradient_product_count;
  for (int at = 0; at < c.count; at += kLanes) {
    const auto& solid = density_on<Solid>(object, c.elements + at, c.count - at, kLanes);
    const F frame(t, c, at, z_control);
    B curvature[packed(kMaxModes)], z[N], cofactor[N];
    project_dilatation(frame, t, theta);
    B sum = add_volume<Arch, Solid>(solid, frame, t, projection_weight, theta, curvature);
    for (int k = 0; k < first_count; ++k) g[k] = B(0.0);
    for (int k = 0; hessian && k < t.mode_count * first_count; ++k) by_mode[k] = B(0.0);
    for (int k = 0; hessian && k < kEntries * t.gradient_product_count; ++k)
      gradient_products[k] = B(0.0);
    PointModel<B, N> m;
    for (int l = 0; l < t.points; ++l) {
      frame.at_point(t, l, z);
      if (hessian)
        solid.template model<Curvature::Exact>(z, 0.0, m);
      else
        solid.slope(z, m);
      sum += frame.weight(t, l) * m.f;
      cofactors<D>(z, cofactor);
      for (int r = 0; r < N; ++r) m.g[r] = xsimd::fma(theta[l], cofactor[r], m.g[r]);
      if (frame.rest_step != 0) frame.pull_back_gradient(l, m.g);
      const double* wf = t.weighted_shape_gradient + l * t.shape_gradient_count;
      for (int q = 0; q < t.shape_gradient_count; ++q)
        for (int r = 0; r < N; ++r) g[N * q + r] = xsimd::fma(B(wf[q]), m.g[r], g[N * q + r]);
      if (!hessian) continue;
      if (projection_weight > 0) make_semidefinite_batch<N>(projection_weight, m.k);
      if (projection_weight < 1)
        add_second_determinant<D>(B(1 - projection_weight) * theta[l], z, m.k);
      if (frame.rest_step != 0) {
        frame.pull_back_gradient(l, cofactor);
        frame.pull_back_curvature(l, m.k);
      }
      for (int a = 0; a < t.mode_count; ++a) {
        const B mode = frame.mode(t, l, a);
        for (int q = 0; q < t.shape_gradient_count; ++q)
          for (int r = 0; r < N; ++r) {
            B& entry = by_mode[a * first_count + N * q + r];
            entry = xsimd::fma(B(wf[q]) * mode, cofactor[r], entry);
          }
      }
      const double* wm = t.weighted_gradient_product + l * t.gradient_product_count;
      for (int q = 0; q < t.gradient_product_count; ++q) {
        const B w(wm[q]);
        B* gradient_product = gradient_products + kEntries * q;
        for (int r = 0; r < kEntries; ++r)
          gradient_product[r] = xsimd::fma(w, m.k[r], gradient_product[r]);
      }
    }
    (sum * frame.measure()).store_unaligned(f + at);
    write_gradient<Arch, Solid>(frame, t, g, gradient + at, BatchView::stride);
    if (!hessian) continue;
    for (int q = 0; q < t.gradient_product_count; ++q)
      to_directions<Arch, Solid>(frame, t.direction_count, gradient_products + kEntries * q,
                                 s + blocks * q);
    write_hessian<Arch, D>(t, s, hessian, at);
    for (int a = 0; a < t.mode_count; ++a)
      write_gradient<Arch, Solid>(frame, t, by_mode + a * first_count,
                                  reinterpret_cast<double*>(slopes + a * size), kLanes);
    add_coupling<Arch>(size, t.mode_count, slopes, curvature, B(1.0) / frame.measure(),
                       hessian + at);
  }
}

template <class Arch, class Solid>
int solid_scratch_size(const ContractionView& t) {
  constexpr int kWidest = 8;  // doubles of the widest batch
  constexpr int N = Solid::size;
  return scratch_size<Arch, Solid>(t) +
         kWidest * (t.points + t.mode_count * (N * t.shape_gradient_count + Solid::dims * t.nodes));
}

template <class Arch, class Solid>
DensityKernels make_solid_kernels() {
  DensityKernels kernels{Solid::rows, Solid::dims, &solid_values<Arch, Solid>,
                         &solid_local<Arch, Solid>, &solid_scratch_size<Arch, Solid>};
  kernels.pressures = &solid_pressures<Arch, Solid>;
  return kernels;
}

}  // namespace majorant::kernel

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
