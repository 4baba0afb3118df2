// The one contraction: density of the Jacobian + element tables -> local value, gradient,
// curvature.
//
// Batches of elements side by side in SIMD registers. Per quadrature point only alpha and beta, the
// density's jet and ten curvature entries appear; sums over points are moments (method.md section
// 4), recombined into basis pairs once per element. Works for any density with
//   value(x, y), jet(x, y), domain(), convexity()     (energies/spectral.h)
// and any element with a ContractionTable.
#pragma once

#include <limits>
#include <xsimd/xsimd.hpp>

#include "majorant/energies/contraction.h"
#include "majorant/energies/isotropic.h"

namespace majorant::kernel {

template <class Arch>
using Batch = xsimd::batch<double, Arch>;

// Frame of one batch of elements: derivative directions mapped to the rest frame, Jacobian control
// values as (alpha, beta).
template <class Arch>
struct Frame {
  using B = Batch<Arch>;
  static constexpr int kMaxDirections = 4;
  B direction[kMaxDirections][2];
  B measure;
  B* z;  // first_count by 4: alpha0, alpha1, beta0, beta1

  Frame(const ContractionView& t, const ChunkView& c, int at, B* scratch) : z(scratch) {
    const auto load = [&](const double* p) { return B::load_unaligned(p + at); };
    B m[4];
    for (int k = 0; k < 4; ++k) m[k] = load(c.rest + k * ChunkView::stride);
    measure = load(c.rest + 4 * ChunkView::stride);
    for (int a = 0; a < t.direction_count; ++a) {
      const B g0(t.directions[2 * a]), g1(t.directions[2 * a + 1]);
      direction[a][0] = g0 * m[0] + g1 * m[2];
      direction[a][1] = g0 * m[1] + g1 * m[3];
    }
    for (int k = 0; k < 4 * t.first_count; ++k) z[k] = B(0.0);
    for (int q = 0; q < t.gradient_count; ++q) {
      const GradientEntry& e = t.gradient[q];
      const B u = load(c.x + 2 * e.node * ChunkView::stride) * B(0.5 * e.coefficient);
      const B v = load(c.x + (2 * e.node + 1) * ChunkView::stride) * B(0.5 * e.coefficient);
      const B* d = direction[e.direction];
      B* zk = z + 4 * e.first;
      const B ud0 = u * d[0], ud1 = u * d[1], vd0 = v * d[0], vd1 = v * d[1];
      zk[0] += ud0 + vd1;
      zk[1] += vd0 - ud1;
      zk[2] += ud0 - vd1;
      zk[3] += vd0 + ud1;
    }
  }

  void at_point(const double* first, int count, B (&out)[4]) const {
    for (int c = 0; c < 4; ++c) out[c] = B(first[0]) * z[c];
    for (int k = 1; k < count; ++k)
      for (int c = 0; c < 4; ++c) out[c] = xsimd::fma(B(first[k]), z[4 * k + c], out[c]);
  }
};

template <class Arch, class Density>
Batch<Arch> inside_domain(const Density& density, const Batch<Arch>& f, const Batch<Arch>& x,
                          const Batch<Arch>& y) {
  using B = Batch<Arch>;
  const B infinity(std::numeric_limits<double>::infinity());
  if (density.domain() == Domain::PositiveDeterminant)
    return xsimd::select((x > y) && (f == f), f, infinity);
  return xsimd::select(f == f, f, infinity);
}

template <class Arch, class Density>
void values(const void* object, const ContractionView& t, const ChunkView& c, double* scratch,
            double* f) {
  using B = Batch<Arch>;
  const Density& density = *static_cast<const Density*>(object);
  for (int at = 0; at < c.count; at += static_cast<int>(B::size)) {
    const Frame<Arch> frame(t, c, at, reinterpret_cast<B*>(scratch));
    B sum(0.0), z[4];
    for (int l = 0; l < t.points; ++l) {
      frame.at_point(t.first + l * t.first_count, t.first_count, z);
      const B x = z[0] * z[0] + z[1] * z[1], y = z[2] * z[2] + z[3] * z[3];
      sum += B(t.weights[l]) * inside_domain<Arch>(density, density.value(x, y), x, y);
    }
    (sum * frame.measure).store_unaligned(f + at);
  }
}

// Rows of the ten distinct entries of the curvature in (alpha, beta).
enum { A00, A01, A11, C00, C01, C10, C11, B00, B01, B11, kEntries };

template <class Arch>
void curvature_entries(const CurvatureCoefficients<Batch<Arch>>& c, const Batch<Arch> (&z)[4],
                       Batch<Arch> (&k)[kEntries]) {
  const auto qa0 = c.qa * z[0], qa1 = c.qa * z[1], qb0 = c.qb * z[2], qb1 = c.qb * z[3];
  const auto qc0 = c.qab * z[0], qc1 = c.qab * z[1];
  k[A00] = c.pa + qa0 * z[0];
  k[A01] = qa0 * z[1];
  k[A11] = c.pa + qa1 * z[1];
  k[C00] = qc0 * z[2];
  k[C01] = qc0 * z[3];
  k[C10] = qc1 * z[2];
  k[C11] = qc1 * z[3];
  k[B00] = c.pb + qb0 * z[2];
  k[B01] = qb0 * z[3];
  k[B11] = c.pb + qb1 * z[3];
}

// One moment of the curvature in (alpha, beta) -> 3 blocks (uu, uv, vv) of direction pairs, each
// direction_count squared: s[block][a][b] = dir_a^T K^{pq} dir_b * measure.
template <class Arch>
void to_directions(const Frame<Arch>& frame, int directions, const Batch<Arch>* k, Batch<Arch>* s) {
  using B = Batch<Arch>;
  const B q = frame.measure * B(0.25);
  const B aa = q * (k[A00] + k[C00] + k[C00] + k[B00]),
          dd = q * (k[A00] - k[C00] - k[C00] + k[B00]);
  const B bb = q * (k[A11] - k[C11] - k[C11] + k[B11]),
          cc = q * (k[A11] + k[C11] + k[C11] + k[B11]);
  const B ab = q * (k[C01] - k[C10] + k[B01] - k[A01]),
          cd = q * (k[A01] - k[C10] + k[C01] - k[B01]);
  const B ac = q * (k[A01] + k[C01] + k[C10] + k[B01]),
          bd = q * (k[C10] + k[C01] - k[A01] - k[B01]);
  const B ad = q * (k[A00] - k[B00]), bc = q * (k[B11] - k[A11]);
  const B blocks[3][4] = {{aa, ab, ab, bb}, {ac, ad, bc, bd}, {cc, cd, cd, dd}};
  for (int p = 0; p < 3; ++p)
    for (int b = 0; b < directions; ++b) {
      const B* d = frame.direction[b];
      const B r0 = blocks[p][0] * d[0] + blocks[p][1] * d[1];
      const B r1 = blocks[p][2] * d[0] + blocks[p][3] * d[1];
      for (int a = 0; a < directions; ++a)
        s[(p * directions + a) * directions + b] =
            frame.direction[a][0] * r0 + frame.direction[a][1] * r1;
    }
}

template <class Arch>
void write_gradient(const Frame<Arch>& frame, const ContractionView& t, const Batch<Arch>* g,
                    double* out, int at) {
  using B = Batch<Arch>;
  for (int i = 0; i < 2 * t.nodes; ++i) B(0.0).store_unaligned(out + i * ChunkView::stride + at);
  for (int q = 0; q < t.gradient_count; ++q) {
    const GradientEntry& e = t.gradient[q];
    const B* gz = g + 4 * e.first;
    const B* d = frame.direction[e.direction];
    const B scale = frame.measure * B(0.5 * e.coefficient);
    const B ga = gz[0] + gz[2], gd = gz[0] - gz[2], gb = gz[3] - gz[1], gc = gz[3] + gz[1];
    double* u = out + 2 * e.node * ChunkView::stride + at;
    double* v = u + ChunkView::stride;
    (B::load_unaligned(u) + scale * (ga * d[0] + gb * d[1])).store_unaligned(u);
    (B::load_unaligned(v) + scale * (gc * d[0] + gd * d[1])).store_unaligned(v);
  }
}

template <class Arch>
void write_hessian(const ContractionView& t, const Batch<Arch>* s, double* out, int at) {
  using B = Batch<Arch>;
  const int n = t.direction_count, square = n * n;
  const auto store = [&](int row, int column, const B& h) {
    h.store_unaligned(out + (row * (row + 1) / 2 + column) * ChunkView::stride + at);
  };
  for (int i = 0, pair = 0; i < t.nodes; ++i)
    for (int j = 0; j <= i; ++j, ++pair) {
      B h00(0.0), h01(0.0), h10(0.0), h11(0.0);
      for (int q = t.pair_starts[pair]; q < t.pair_starts[pair + 1]; ++q) {
        const HessianEntry& e = t.hessian[q];
        const B* m = s + 3 * square * e.moment;
        const B w(e.coefficient);
        const int ab = e.direction_i * n + e.direction_j, ba = e.direction_j * n + e.direction_i;
        h00 = xsimd::fma(w, m[ab], h00);
        h01 = xsimd::fma(w, m[square + ab], h01);
        h10 = xsimd::fma(w, m[square + ba], h10);
        h11 = xsimd::fma(w, m[2 * square + ab], h11);
      }
      store(2 * i, 2 * j, h00);
      store(2 * i + 1, 2 * j, h10);
      if (j < i) store(2 * i, 2 * j + 1, h01);
      store(2 * i + 1, 2 * j + 1, h11);
    }
}

template <class Arch, class Density, class Model>
void local_with(const Density& density, const Model& model, const ContractionView& t,
                const ChunkView& c, double* scratch, double* f, double* gradient, double* hessian) {
  using B = Batch<Arch>;
  B* z_control = reinterpret_cast<B*>(scratch);
  B* g = z_control + 4 * t.first_count;
  B* moments = g + 4 * t.first_count;
  B* s = moments + kEntries * t.moment_count;
  const int square = t.direction_count * t.direction_count;
  for (int at = 0; at < c.count; at += static_cast<int>(B::size)) {
    const Frame<Arch> frame(t, c, at, z_control);
    for (int k = 0; k < 4 * t.first_count; ++k) g[k] = B(0.0);
    for (int k = 0; k < kEntries * t.moment_count; ++k) moments[k] = B(0.0);
    B sum(0.0), z[4], k[kEntries];
    for (int l = 0; l < t.points; ++l) {
      frame.at_point(t.first + l * t.first_count, t.first_count, z);
      const B x = z[0] * z[0] + z[1] * z[1], y = z[2] * z[2] + z[3] * z[3];
      const IsotropicJet<B> jet = density.jet(x, y);
      sum += B(t.weights[l]) * inside_domain<Arch>(density, jet.f, x, y);
      const B gz[4] = {jet.ga * z[0], jet.ga * z[1], jet.gb * z[2], jet.gb * z[3]};
      const double* wf = t.weighted_first + l * t.first_count;
      for (int q = 0; q < t.first_count; ++q)
        for (int r = 0; r < 4; ++r) g[4 * q + r] = xsimd::fma(B(wf[q]), gz[r], g[4 * q + r]);
      curvature_entries<Arch>(model(jet, x, y), z, k);
      const double* wm = t.weighted_moment + l * t.moment_count;
      for (int q = 0; q < t.moment_count; ++q) {
        const B w(wm[q]);
        B* m = moments + kEntries * q;
        for (int r = 0; r < kEntries; ++r) m[r] = xsimd::fma(w, k[r], m[r]);
      }
    }
    (sum * frame.measure).store_unaligned(f + at);
    write_gradient<Arch>(frame, t, g, gradient, at);
    for (int q = 0; q < t.moment_count; ++q)
      to_directions<Arch>(frame, t.direction_count, moments + kEntries * q, s + 3 * square * q);
    write_hessian<Arch>(t, s, hessian, at);
  }
}

template <class Arch, class Density>
void local(const void* object, const ContractionView& t, const ChunkView& c, Curvature curvature,
           double* scratch, double* f, double* gradient, double* hessian) {
  using B = Batch<Arch>;
  const Density& density = *static_cast<const Density*>(object);
  const auto run = [&](const auto& model) {
    local_with<Arch>(density, model, t, c, scratch, f, gradient, hessian);
  };
  const bool convex = density.convexity() == Convexity::Convex;
  if (curvature == Curvature::Exact)
    run([](const IsotropicJet<B>& j, const B&, const B&) { return exact_coefficients(j); });
  else if (curvature == Curvature::PaperMajorizer)
    run([](const IsotropicJet<B>& j, const B& x, const B& y) { return paper_majorizer(j, x, y); });
  else if (convex)  // Projected and Majorizer agree
    run([](const IsotropicJet<B>& j, const B& x, const B&) { return convex_projection(j, x); });
  else
    run([](const IsotropicJet<B>& j, const B& x, const B& y) {
      return general_projection(j, x, y);
    });
}

// Templates on Arch, although they do not use it: a function that several instruction sets define
// would be merged by the linker, possibly to one the machine cannot run.
template <class Arch, class Density>
bool supports(const void* object, Curvature curvature) {
  const bool convex = static_cast<const Density*>(object)->convexity() == Convexity::Convex;
  switch (curvature) {
    case Curvature::Projected:
    case Curvature::Exact:
      return true;
    case Curvature::Majorizer:
    case Curvature::PaperMajorizer:
      return convex;
    case Curvature::Reweighted:
      return false;
  }
  return false;
}

template <class Arch>
int scratch_size(const ContractionView& t) {
  constexpr int kWidest = 8;  // doubles of the widest batch
  return kWidest * (8 * t.first_count +
                    (kEntries + 3 * t.direction_count * t.direction_count) * t.moment_count);
}

template <class Arch, class Density>
DensityKernels make_kernels() {
  return {&supports<Arch, Density>, &values<Arch, Density>, &local<Arch, Density>,
          &scratch_size<Arch>};
}

}  // namespace majorant::kernel
