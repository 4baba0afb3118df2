// Any density of the Jacobian from one line of code: anisotropic, of volumes, of surfaces in space.
//
//   auto mips = density<2, 2>("mips", [](const auto& J) {
//     return J.squaredNorm() / J.determinant();
//   });
//   builder.add(make_energy(space, rest, mips, {rule}), 1.0 / area);
//
// J is M by D: M unknowns per node, D the dimension of the element, in the frame of the rest shape
// (RestShapes). Derivatives come from Dual2, the projected Hessian from an eigendecomposition of
// the MD by MD block at every quadrature point: for isotropic planar energies spectral() and
// invariant() are several times faster and know more curvature models.
#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <utility>

#include "majorant/energies/detail/contraction.h"
#include "majorant/energies/detail/isotropic.h"
#include "majorant/energies/detail/small_matrix.h"
#include "majorant/framework/dual2.h"
#include "majorant/framework/packed_symmetric.h"

namespace majorant {

namespace detail {

template <int N>
void project(double clamp, PointModel<double, N>& m) {
  clamp_eigenvalues<N>(clamp, m.k);
}

// Lane by lane.
template <int N, class Batch>
void project(double clamp, PointModel<Batch, N>& m) {
  constexpr int kPacked = N * (N + 1) / 2;
  constexpr auto kLanes = Batch::size;
  double lanes[kPacked][kLanes], one[kPacked];
  for (int p = 0; p < kPacked; ++p) m.k[p].store_unaligned(lanes[p]);
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    for (int p = 0; p < kPacked; ++p) one[p] = lanes[p][lane];
    clamp_eigenvalues<N>(clamp, one);
    for (int p = 0; p < kPacked; ++p) lanes[p][lane] = one[p];
  }
  for (int p = 0; p < kPacked; ++p) m.k[p] = Batch::load_unaligned(lanes[p]);
}

}  // namespace detail

template <int M, int D, class F>
class GeneralDensity {
 public:
  static constexpr int rows = M, dims = D, size = M * D;
  const Traits traits;  // public: kernels must not call shared functions

  GeneralDensity(std::string name, F f, const Traits& t)
      : traits(t), f_(std::move(f)), name_(std::move(name)) {}
  std::string_view name() const { return name_; }
  static constexpr bool defines(Curvature c) {
    return c == Curvature::Projected || c == Curvature::Exact;
  }
  bool supports(Curvature c) const { return defines(c); }

  template <class T>
  T value(const T (&z)[size]) const {
    SmallMatrix<T, M, D> J;
    for (int r = 0; r < size; ++r) J(r / D, r % D) = z[r];
    return inside_domain(T(f_(J)), J);
  }
  template <Curvature C, class T>
  void model(const T (&z)[size], double clamp, PointModel<T, size>& m) const {
    using Scalar = Dual2<T, size>;
    SmallMatrix<T, M, D> at;
    SmallMatrix<Scalar, M, D> J;
    for (int r = 0; r < size; ++r) {
      at(r / D, r % D) = z[r];
      J(r / D, r % D) = Scalar::variable(z[r], r);
    }
    const Scalar e = f_(J);
    m.f = inside_domain(e.v, at);
    for (int r = 0; r < size; ++r) m.g[r] = e.d[static_cast<std::size_t>(r)];
    for (std::size_t p = 0; p < e.h.size(); ++p) m.k[p] = e.h[p];
    if constexpr (C != Curvature::Exact) detail::project(clamp, m);
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
    for (int r = 0; r < size * (size + 1) / 2; ++r) out[r] = k[r];
  }

 private:
  template <class T>
  T inside_domain(const T& f, const SmallMatrix<T, M, D>& J) const {
    using namespace scalar_math;
    const T infinity(std::numeric_limits<double>::infinity());
    if constexpr (M == D)
      if (traits.domain == Domain::PositiveDeterminant)
        return select((J.determinant() > T(0.0)) && (f == f), f, infinity);
    return select(f == f, f, infinity);
  }
  F f_;
  std::string name_;
};

// f(J): J a SmallMatrix<T, M, D>. Domain::PositiveDeterminant needs M = D <= 3 and is not looked at
// otherwise; convexity and reweighting never are.
template <int M, int D, class F>
GeneralDensity<M, D, F> density(std::string name, F f, const Traits& traits = {}) {
  return {std::move(name), std::move(f), traits};
}

}  // namespace majorant
