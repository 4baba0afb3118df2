// Any density of the Jacobian from one line of code: anisotropic, of volumes, of surfaces in space.
//
//   auto mips = density<2, 2>("mips", [](const auto& J) {
//     return J.squaredNorm() / J.determinant();
//   });
//   builder.add(make_energy(space, rest, mips), 1.0 / area);
//
// J is M by D, both 1 to 3: M unknowns per node, D the dimension of the element, in the frame of
// the rest shape (RestShapes; turned() turns it). Derivatives come from Dual1 and Dual2 (dual2.h),
// so the formula may do what these do; branches too. The projected Hessian comes from an
// eigendecomposition of the MD by MD block at every quadrature point: for isotropic planar energies
// spectral() and invariant() are faster and know more curvature models.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

#include "majorant/energies/detail/contraction.h"
#include "majorant/energies/detail/small_matrix.h"
#include "majorant/energies/element_data.h"
#include "majorant/energies/traits.h"
#include "majorant/framework/curvature.h"
#include "majorant/framework/dual2.h"

namespace majorant {

template <int M, int D, class F>
class GeneralDensity {
  static_assert(M >= 1 && M <= 3 && D >= 1 && D <= 3, "J has 1 to 3 rows and columns");

 public:
  static constexpr int rows = M, dims = D, size = M * D;
  const Traits traits;

  GeneralDensity(std::string name, F f, const Traits& t)
      : traits(t), f_(std::move(f)), name_(std::move(name)) {}
  std::string_view name() const { return name_; }
  bool supports(Curvature c) const { return c == Curvature::Projected || c == Curvature::Exact; }

  // At J, row by row; data: what the formula takes beside J.
  template <class... Data>
  double value(const double (&z)[size], const Data&... data) const {
    const auto J = matrix<double>([&z](int r) { return z[r]; });
    return inside_domain(f_(J, data...), z);
  }
  // With the exact Hessian.
  template <class... Data>
  void model(const double (&z)[size], PointModel<double, size>& m, const Data&... data) const {
    differentiate<Dual2<double, size>>(z, m, data...);
  }
  // m.k is left alone.
  template <class... Data>
  void slope(const double (&z)[size], PointModel<double, size>& m, const Data&... data) const {
    differentiate<Dual1<double, size>>(z, m, data...);
  }

 private:
  template <class Scalar, class... Data>
  void differentiate(const double (&z)[size], PointModel<double, size>& m,
                     const Data&... data) const {
    const Scalar e = f_(matrix<Scalar>([&z](int r) { return Scalar::variable(z[r], r); }), data...);
    m.f = inside_domain(e.v, z);
    for (std::size_t r = 0; r < e.d.size(); ++r) m.g[r] = e.d[r];
    for (std::size_t p = 0; p != e.h.size(); ++p) m.k[p] = e.h[p];
  }
  template <class T, class Entry>
  static SmallMatrix<T, M, D> matrix(const Entry& entry) {
    SmallMatrix<T, M, D> J;
    for (int r = 0; r < size; ++r) J(r / D, r % D) = entry(r);
    return J;
  }
  double inside_domain(double f, const double (&z)[size]) const {
    bool inside = f == f;
    if constexpr (M == D)
      if (traits.domain == Domain::PositiveDeterminant)
        inside = inside && matrix<double>([&z](int r) { return z[r]; }).determinant() > 0;
    return inside ? f : std::numeric_limits<double>::infinity();
  }
  F f_;
  std::string name_;
};

// f(J): J a SmallMatrix<T, M, D>. Domain::PositiveDeterminant means something for M = D alone;
// convexity and reweighting never do.
template <int M, int D, class F>
GeneralDensity<M, D, F> density(std::string name, F f, const Traits& traits = {}) {
  return {std::move(name), std::move(f), traits};
}

// f(J, data of the element): see element_data.h. Throws InvalidArgument for numbers that are
// not finite; make_energy() and drivers do so unless there are data for each element.
template <int M, int D, class F, DataOfElements Data>
auto density(std::string name, F f, const Data& data, const Traits& traits = {}) {
  auto rows = detail::element_data(name, data);
  return WithData(GeneralDensity<M, D, F>(std::move(name), std::move(f), traits), std::move(rows));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
