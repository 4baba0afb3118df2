// Isotropic energies from one line of code.
//
//   auto sd = spectral("symmetric-dirichlet",
//       [](auto S, auto s) { return S * S + s * s + 1.0 / (S * S) + 1.0 / (s * s); });
//   builder.add(make_energy(space, rest, sd), 1.0 / area);
//
// `spectral` takes h(Sigma, sigma), sigma signed. `invariant` takes k(x, y) of x = |alpha|^2, y =
// |beta|^2. It is cheaper and exact at similarities (no square roots), so it is preferable if the
// density is smooth in x and y. Both are differentiated by Dual2. h must be even under B -> -B,
// that is, symmetric in its arguments; energy_factory() and make_energy() test that at one point.
//
// For densities that are not isotropic or not planar, use density() (make_energy.h); for formulas
// with data of their element, see the end of that file.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "majorant/energies/detail/isotropic.h"

namespace majorant {

// States that no majorant(x, y) is known. A majorant m >= 0 makes exact Hessian + m |d alpha|^2 a
// majorizer if k is not convex; it is declared, like Traits.
struct NoMajorant {};

namespace detail {

// Computes the curvature of an isotropic density from its jet.
template <Curvature C, class Majorant, class T>
void write_model(const Traits& traits, const Majorant& majorant, const IsotropicJet<T>& j,
                 const T& x, const T& y, const T (&z)[4], double projection_weight,
                 PointModel<T, 4>& m) {
  m.f = j.f;
  m.g[0] = j.ga * z[0];
  m.g[1] = j.ga * z[1];
  m.g[2] = j.gb * z[2];
  m.g[3] = j.gb * z[3];
  const bool convex = traits.convexity == Convexity::Convex;
  if constexpr (C == Curvature::Exact) {
    write_curvature(exact_coefficients(j), z, m);
  } else if constexpr (C == Curvature::CompositeMajorizer) {
    write_curvature(composite_majorizer(j, x, y), z, m);
  } else if constexpr (C == Curvature::Reweighted) {
    write_reweighted(j, x, y, z, m);
  } else if constexpr (C == Curvature::Majorizer && !std::is_same_v<Majorant, NoMajorant>) {
    CurvatureCoefficients<T> c = exact_coefficients(j);
    c.pa = c.pa + majorant(x, y);
    write_curvature(c, z, m);
  } else {  // for convex k, Projected and Majorizer agree
    write_curvature(convex ? convex_projection(j, x, T(projection_weight))
                           : general_projection(j, x, y, T(projection_weight)),
                    z, m);
  }
}

}  // namespace detail

// The coordinates z = (alpha, beta) of J = (a, b, c, d), row by row, and the transformation of
// gradients and packed curvatures back to J.
struct SimilarityCoordinates {
  static constexpr int rows = 2, dims = 2;  // of J

  template <class T>
  static void to_coordinates(const T (&J)[4], T (&z)[4]) {
    const T half(0.5);
    z[0] = half * (J[0] + J[3]);
    z[1] = half * (J[2] - J[1]);
    z[2] = half * (J[0] - J[3]);
    z[3] = half * (J[1] + J[2]);
  }
  template <class T>
  static void gradient_to_jacobian(const T* g, T* out) {
    const T half(0.5);
    out[0] = half * (g[0] + g[2]);
    out[1] = half * (g[3] - g[1]);
    out[2] = half * (g[3] + g[1]);
    out[3] = half * (g[0] - g[2]);
  }
  template <class T>
  static void curvature_to_jacobian(const T* k, T* out) {
    enum { A00, A01, A11, C00, C10, B00, C01, C11, B01, B11 };
    const T q(0.25);
    out[0] = q * (k[A00] + k[C00] + k[C00] + k[B00]);  // aa
    out[1] = q * (k[C01] - k[C10] + k[B01] - k[A01]);  // ba
    out[2] = q * (k[A11] - k[C11] - k[C11] + k[B11]);  // bb
    out[3] = q * (k[A01] + k[C01] + k[C10] + k[B01]);  // ca
    out[4] = q * (k[B11] - k[A11]);                    // cb
    out[5] = q * (k[A11] + k[C11] + k[C11] + k[B11]);  // cc
    out[6] = q * (k[A00] - k[B00]);                    // da
    out[7] = q * (k[C10] + k[C01] - k[A01] - k[B01]);  // db
    out[8] = q * (k[A01] - k[C10] + k[C01] - k[B01]);  // dc
    out[9] = q * (k[A00] - k[C00] - k[C00] + k[B00]);  // dd
  }
};

// The common part of both forms: J in the coordinates z = (alpha, beta), traits, curvature models.
// `Derived` supplies value_of(x, y, data...) and jet(x, y, data...), where data are those of the
// element.
template <class Derived, class Majorant>
class IsotropicDensity : public SimilarityCoordinates {
 public:
  const Traits traits;  // public: kernels must not call shared functions

  std::string_view name() const { return name_; }
  const Majorant& majorant() const { return majorant_; }
  static constexpr bool defines(Curvature) { return true; }
  bool supports(Curvature curvature) const {
    const bool convex = traits.convexity == Convexity::Convex;
    if (curvature == Curvature::Majorizer) return convex || !std::is_same_v<Majorant, NoMajorant>;
    if (curvature == Curvature::CompositeMajorizer) return convex;
    if (curvature == Curvature::Reweighted) return traits.reweighting == Reweighting::Separable;
    return true;
  }

  template <class T, class... Data>
  T value_at(const T& x, const T& y, const Data&... data) const {
    return inside_domain(derived().value_of(x, y, data...), x, y);
  }
  template <class T, class... Data>
  IsotropicJet<T> jet_at(const T& x, const T& y, const Data&... data) const {
    IsotropicJet<T> j = derived().jet(x, y, data...);
    j.f = inside_domain(j.f, x, y);
    return j;
  }

  template <class T>
  T value(const T (&z)[4]) const {
    const T x = z[0] * z[0] + z[1] * z[1], y = z[2] * z[2] + z[3] * z[3];
    return value_at(x, y);
  }
  template <Curvature C, class T>
  void model(const T (&z)[4], double projection_weight, PointModel<T, 4>& m) const {
    const T x = z[0] * z[0] + z[1] * z[1], y = z[2] * z[2] + z[3] * z[3];
    detail::write_model<C>(traits, majorant_, jet_at(x, y), x, y, z, projection_weight, m);
  }

 protected:
  IsotropicDensity(std::string name, const Traits& t, Majorant majorant)
      : traits(t), majorant_(std::move(majorant)), name_(std::move(name)) {}

 private:
  const Derived& derived() const { return static_cast<const Derived&>(*this); }
  template <class T>
  T inside_domain(const T& f, const T& x, const T& y) const {
    using namespace scalar_math;
    const T infinity(std::numeric_limits<double>::infinity());
    if (traits.domain == Domain::PositiveDeterminant)
      return select((x > y) && (f == f), f, infinity);
    return select(f == f, f, infinity);
  }
  Majorant majorant_;
  std::string name_;
};

template <class K, class Majorant = NoMajorant>
class InvariantDensity : public IsotropicDensity<InvariantDensity<K, Majorant>, Majorant> {
 public:
  InvariantDensity(std::string name, K k, const Traits& t, Majorant majorant = {})
      : IsotropicDensity<InvariantDensity, Majorant>(std::move(name), t, std::move(majorant)),
        k_(std::move(k)) {}

  template <class T, class... Data>
  T value_of(const T& x, const T& y, const Data&... data) const {
    return k_(x, y, data...);
  }
  // Square roots and logarithms of x have no derivatives at 0, so x is bounded below.
  template <class T, class... Data>
  IsotropicJet<T> jet(const T& x, const T& y, const Data&... data) const {
    using namespace scalar_math;
    const auto [vx, vy] = dual2_variables<T>(max(x, T(kSmallestA * kSmallestA)), y);
    const Dual2<T, 2> k = k_(vx, vy, data...);
    const T two(2.0), four(4.0);
    return {k.v,
            two * k.d[0],
            two * k.d[1],
            four * k.hess(0, 0),
            four * k.hess(1, 0),
            four * k.hess(1, 1)};
  }

 private:
  K k_;
};

template <class H, class Majorant = NoMajorant>
class SpectralDensity : public IsotropicDensity<SpectralDensity<H, Majorant>, Majorant> {
 public:
  SpectralDensity(std::string name, H h, const Traits& t, Majorant majorant = {})
      : IsotropicDensity<SpectralDensity, Majorant>(std::move(name), t, std::move(majorant)),
        h_(std::move(h)) {}

  template <class T, class... Data>
  T value_of(const T& x, const T& y, const Data&... data) const {
    using namespace scalar_math;
    const T a = sqrt(x), b = sqrt(y);
    return h_(a + b, a - b, data...);
  }
  // Replaces (S, s) by (h(S, s), h(s, S)), which are equal for a function of singular values.
  template <class T, class... Data>
  void in_both_orders(T (&values)[2], const Data&... data) const {
    const T S = values[0], s = values[1];
    values[0] = h_(S, s, data...);
    values[1] = h_(s, S, data...);
  }
  // Below B = kEvenBelow A the even expansion in B replaces k_A = h_S + h_s, k_B = h_S - h_s. There
  // k_B / B = k_BB to a few 1e-11, while the quotient has lost as many digits to cancellation.
  static constexpr double kEvenBelow = 5e-6;
  template <class T, class... Data>
  IsotropicJet<T> jet(const T& x, const T& y, const Data&... data) const {
    using namespace scalar_math;
    const T a = sqrt(x), b = sqrt(y);
    const auto [S, s] = dual2_variables<T>(a + b, a - b);
    const Dual2<T, 2> h = h_(S, s, data...);
    const T kA = h.d[0] + h.d[1], kB = h.d[0] - h.d[1];
    const T sum = h.hess(0, 0) + h.hess(1, 1), twice = T(2.0) * h.hess(1, 0);
    const T kAA = sum + twice, kBB = sum - twice, kAB = h.hess(0, 0) - h.hess(1, 1);
    const T tiny(kSmallestA), small = T(kEvenBelow) * a;
    const T safe_a = max(a, tiny), safe_b = max(b, max(small, tiny));
    IsotropicJet<T> j;
    j.f = h.v;
    j.ga = kA / safe_a;
    j.gb = select(b > small, kB / safe_b, kBB);
    j.caa = (kAA - j.ga) / (safe_a * safe_a);
    j.cab = kAB / (safe_a * max(b, tiny));
    j.cbb = select(b > small, (kBB - j.gb) / (safe_b * safe_b), T(0.0));
    j.cab = select(b > tiny, j.cab, T(0.0));
    return j;
  }

 private:
  H h_;
};

template <class K, class Majorant = NoMajorant>
InvariantDensity<K, Majorant> invariant(std::string name, K k, const Traits& traits = {},
                                        Majorant majorant = {}) {
  return {std::move(name), std::move(k), traits, std::move(majorant)};
}

template <class H, class Majorant = NoMajorant>
SpectralDensity<H, Majorant> spectral(std::string name, H h, const Traits& traits = {},
                                      Majorant majorant = {}) {
  return {std::move(name), std::move(h), traits, std::move(majorant)};
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
