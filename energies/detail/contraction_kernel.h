// The contraction of all energies: density of the Jacobian + element tables -> local value,
// gradient, curvature.
//
// Elements are processed in batches, side by side in SIMD registers. Per quadrature point only J
// (in the density's own coordinates), its gradient and its packed curvature appear. Sums over
// points are gradient_products (method.md section 4), recombined into basis pairs once per element.
// Works for any element with a ContractionTable and any density with
//     rows, dims                                         J is rows by dims
//     defines(Curvature)                                 constexpr: models worth compiling
//     value(z), model<Curvature>(z, t, PointModel&)       z: rows * dims coordinates of J;
//                                                         t: BlendedCurvature::projection_weight
//     slope(z, PointModel&)                              without curvature; optional
//     to_coordinates, gradient_to_jacobian, curvature_to_jacobian
// as in energies/spectral.h and energies/make_energy.h.
//
// Every function here is a template on Arch, even if it does not use it, or always inlined. A
// function that several instruction sets define would be merged by the linker, possibly to one that
// the machine cannot run.
#pragma once

#include <limits>
#include <type_traits>

#include "majorant/energies/detail/contraction_frame.h"

namespace majorant::kernel {

// The rounding of a 2 by 2 determinant of differences, relative to its two products: somewhat more
// than 3 unit roundoffs.
inline constexpr double kStarRounding = 4e-16;

// Returns the density of a batch of elements: the object itself or, if the object is a function
// that is called through pointers (point_functions.h), its caller.
template <class Density>
[[gnu::always_inline]] inline decltype(auto) density_on(const void* object, const int* elements,
                                                        int element_count, int lanes) {
  if constexpr (requires { typename Density::Function; })
    return Density(*static_cast<const typename Density::Function*>(object),
                   {lanes, elements, element_count < lanes ? element_count : lanes});
  else
    return (*static_cast<const Density*>(object));
}

// Computes a point model. hessian: null if the curvature is not needed.
template <Curvature C, class Density, class B, int N>
[[gnu::always_inline]] inline void differentiate(const Density& density, const B (&z)[N],
                                                 double projection_weight, const double* hessian,
                                                 PointModel<B, N>& m) {
  if constexpr (requires { density.slope(z, m); })
    if (!hessian) return density.slope(z, m);
  density.template model<C>(z, projection_weight, m);
}

template <class Arch, class Density>
[[gnu::flatten]] void values(const void* object, const ContractionView& t, const BatchView& c,
                             double* scratch, double* f) {
  using B = Batch<Arch>;
  using F = Frame<Arch, Density>;
  constexpr int kLanes = static_cast<int>(B::size);
  for (int at = 0; at < c.count; at += kLanes) {
    const auto& density = density_on<Density>(object, c.elements + at, c.count - at, kLanes);
    const F frame(t, c, at, reinterpret_cast<B*>(scratch));
    B sum(0.0), z[F::N];
    for (int l = 0; l < t.points; ++l) {
      frame.at_point(t, l, z);
      sum += frame.weight(t, l) * density.value(z);
    }
    (sum * frame.measure()).store_unaligned(f + at);
  }
}

// Flattened, since the compiler's budget for a file with many densities would leave calls in the
// loop.
template <class Arch, class Density, Curvature C>
[[gnu::flatten]] void local_with(const void* object, const ContractionView& t, const BatchView& c,
                                 double projection_weight, double* scratch, double* f,
                                 double* gradient, double* hessian) {
  using B = Batch<Arch>;
  using F = Frame<Arch, Density>;
  constexpr int N = F::N, kEntries = packed(N), kLanes = static_cast<int>(B::size);
  B* z_control = reinterpret_cast<B*>(scratch);
  B* g = z_control + N * t.shape_gradient_count;
  B* gradient_products = g + N * t.shape_gradient_count;
  B* s = gradient_products + kEntries * t.gradient_product_count;
  const int blocks = packed(F::M) * t.direction_count * t.direction_count;
  for (int at = 0; at < c.count; at += kLanes) {
    const auto& density = density_on<Density>(object, c.elements + at, c.count - at, kLanes);
    const F frame(t, c, at, z_control);
    for (int k = 0; k < N * t.shape_gradient_count; ++k) g[k] = B(0.0);
    for (int k = 0; hessian && k < kEntries * t.gradient_product_count; ++k)
      gradient_products[k] = B(0.0);
    B sum(0.0), z[N];
    PointModel<B, N> m;
    for (int l = 0; l < t.points; ++l) {
      frame.at_point(t, l, z);
      differentiate<C>(density, z, projection_weight, hessian, m);
      sum += frame.weight(t, l) * m.f;
      if (frame.rest_step != 0) frame.pull_back_gradient(l, m.g);
      const double* wf = t.weighted_shape_gradient + l * t.shape_gradient_count;
      for (int q = 0; q < t.shape_gradient_count; ++q)
        for (int r = 0; r < N; ++r) g[N * q + r] = xsimd::fma(B(wf[q]), m.g[r], g[N * q + r]);
      if (!hessian) continue;
      if (frame.rest_step != 0) frame.pull_back_curvature(l, m.k);
      const double* wm = t.weighted_gradient_product + l * t.gradient_product_count;
      for (int q = 0; q < t.gradient_product_count; ++q) {
        const B w(wm[q]);
        B* gradient_product = gradient_products + kEntries * q;
        for (int r = 0; r < kEntries; ++r)
          gradient_product[r] = xsimd::fma(w, m.k[r], gradient_product[r]);
      }
    }
    (sum * frame.measure()).store_unaligned(f + at);
    write_gradient<Arch, Density>(frame, t, g, gradient + at, BatchView::stride);
    if (!hessian) continue;
    for (int q = 0; q < t.gradient_product_count; ++q)
      to_directions<Arch, Density>(frame, t.direction_count, gradient_products + kEntries * q,
                                   s + blocks * q);
    write_hessian<Arch, F::M>(t, s, hessian, at);
  }
}

// The curvature models that kernels have code for: all, or those that are not for_comparisons().
enum class Models { All, Usual };

template <class Arch, class Density, Models models>
void local(const void* object, const ContractionView& t, const BatchView& c,
           BlendedCurvature curvature, double* scratch, double* f, double* gradient,
           double* hessian) {
  const double projection_weight = hessian ? curvature.projection_weight : 0;
  const auto run = [&](auto model) {
    constexpr Curvature C = decltype(model)::value;
    // A curvature that a density does not define is not compiled; DensityTerm::supports() prevents
    // its use.
    constexpr bool known = Density::defines(C) && (models == Models::All || !for_comparisons(C));
    constexpr Curvature defined = known ? C : Curvature::Exact;
    local_with<Arch, Density, defined>(object, t, c, projection_weight, scratch, f, gradient,
                                       hessian);
  };
  using C = Curvature;
  switch (hessian ? curvature.model : C::Exact) {
    case C::Projected:
      return run(std::integral_constant<C, C::Projected>());
    case C::Majorizer:
      return run(std::integral_constant<C, C::Majorizer>());
    case C::CompositeMajorizer:
      return run(std::integral_constant<C, C::CompositeMajorizer>());
    case C::Exact:
      return run(std::integral_constant<C, C::Exact>());
    case C::Reweighted:
      return run(std::integral_constant<C, C::Reweighted>());
  }
}

template <class Arch, class Density>
int scratch_size(const ContractionView& t) {
  constexpr int kWidest = 8;  // doubles of the widest batch
  constexpr int M = Density::rows, N = M * Density::dims;
  return kWidest * (2 * N * t.shape_gradient_count +
                    (packed(N) + packed(M) * t.direction_count * t.direction_count) *
                        t.gradient_product_count);
}

// Adds the terms of one batch of triangles to the sums: f, gx, gy, hxx, hxy, hyy.
template <class Arch, class Density>
void add_to_star(const Density& density, const StarView& s, int at, const Batch<Arch>& vx,
                 const Batch<Arch>& vy, Batch<Arch> (&sums)[6], Batch<Arch>& area_margin) {
  using B = Batch<Arch>;
  const auto row = [&](int r) { return B::load_unaligned(s.rows + r * StarView::stride + at); };
  const B ga0 = row(StarView::GaX), ga1 = row(StarView::GaY);
  const B gb0 = row(StarView::GbX), gb1 = row(StarView::GbY), weight = row(StarView::Weight);
  const B ax = row(StarView::AX) - vx, ay = row(StarView::AY) - vy;
  const B bx = row(StarView::BX) - vx, by = row(StarView::BY) - vy;
  const B left = ax * by, right = ay * bx;
  area_margin = xsimd::min(
      area_margin, left - right - B(kStarRounding) * (xsimd::abs(left) + xsimd::abs(right)));
  const B J[4] = {ax * ga0 + bx * gb0, ax * ga1 + bx * gb1, ay * ga0 + by * gb0,
                  ay * ga1 + by * gb1};
  B z[4], g[4], K[10];
  PointModel<B, 4> m;
  Density::to_coordinates(J, z);
  density.template model<Curvature::Exact>(z, 0.0, m);
  Density::gradient_to_jacobian(m.g, g);
  Density::curvature_to_jacobian(m.k, K);
  // J changes by -(change of v) w^T.
  const B w0 = ga0 + gb0, w1 = ga1 + gb1;
  const B w00 = weight * w0 * w0, w01 = weight * w0 * w1, w11 = weight * w1 * w1;
  sums[0] += weight * m.f;
  sums[1] -= weight * (g[0] * w0 + g[1] * w1);
  sums[2] -= weight * (g[2] * w0 + g[3] * w1);
  sums[3] += w00 * K[0] + (w01 + w01) * K[1] + w11 * K[2];
  sums[4] += w00 * K[3] + w01 * (K[4] + K[6]) + w11 * K[7];
  sums[5] += w00 * K[5] + (w01 + w01) * K[8] + w11 * K[9];
}

template <class Arch, class Density>
[[gnu::flatten]] void star(const void* object, const StarView& s, double vx, double vy,
                           StarModel& out) {
  using B = Batch<Arch>;
  const auto& density = density_on<Density>(object, nullptr, 0, static_cast<int>(B::size));
  B sums[6], area_margin(std::numeric_limits<double>::max());
  for (B& sum : sums) sum = B(0.0);
  for (int at = 0; at < s.count; at += static_cast<int>(B::size))
    add_to_star<Arch, Density>(density, s, at, B(vx), B(vy), sums, area_margin);
  double* const totals[] = {&out.f, &out.gx, &out.gy, &out.hxx, &out.hxy, &out.hyy};
  double lanes[B::size];
  for (int k = 0; k < 6; ++k) {
    sums[k].store_unaligned(lanes);
    *totals[k] = lanes[0];
    for (std::size_t lane = 1; lane < B::size; ++lane) *totals[k] += lanes[lane];
  }
  area_margin.store_unaligned(lanes);
  out.area_margin = lanes[0];
  for (const double lane : lanes) out.area_margin = lane < out.area_margin ? lane : out.area_margin;
}

template <class Arch, class Density, Models models = Models::All>
DensityKernels make_kernels() {
  DensityKernels kernels{Density::rows, Density::dims, &values<Arch, Density>,
                         &local<Arch, Density, models>, &scratch_size<Arch, Density>};
  if constexpr (Density::rows == 2 && Density::dims == 2) kernels.star = &star<Arch, Density>;
  return kernels;
}

}  // namespace majorant::kernel

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
