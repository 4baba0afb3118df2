// Isotropic energies from one line of code.
//
//   auto sd = spectral("symmetric-dirichlet", Domain::PositiveDeterminant, Convexity::Convex,
//       [](auto S, auto s) { return S * S + s * s + 1.0 / (S * S) + 1.0 / (s * s); });
//   builder.add(make_energy(space, rest_shapes, sd, rules), 1.0 / area);
//
// `spectral` takes h(Sigma, sigma), sigma signed; `invariant` takes k(x, y) of x = |alpha|^2,
// y = |beta|^2 and is cheaper and exact at similarities (no square roots): prefer it where the
// density is smooth in x and y. Both are differentiated by Dual2. h must be even under B -> -B,
// that is symmetric in its arguments.
#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <utility>

#include "majorant/energies/isotropic.h"

namespace majorant {

// The two classes repeat their traits on purpose: a common base would be inline code shared by kernels
// of different instruction sets.
template <class H>
class InvariantDensity {
 public:
  InvariantDensity(std::string name, Domain domain, Convexity convexity, H h)
      : h_(std::move(h)), name_(std::move(name)), domain_(domain), convexity_(convexity) {}
  std::string_view name() const { return name_; }
  Domain domain() const { return domain_; }
  Convexity convexity() const { return convexity_; }

  template <class T>
  T value(const T& x, const T& y) const {
    return h_(x, y);
  }
  template <class T>
  IsotropicJet<T> jet(const T& x, const T& y) const {
    const auto variables = dual2_variables<T>(x, y);
    const Dual2<T, 2> k = h_(variables[0], variables[1]);
    return {k.v,
            T(2.0) * k.d[0],
            T(2.0) * k.d[1],
            T(4.0) * k.hess(0, 0),
            T(4.0) * k.hess(1, 0),
            T(4.0) * k.hess(1, 1)};
  }

 private:
  H h_;
  std::string name_;
  Domain domain_;
  Convexity convexity_;
};

template <class H>
class SpectralDensity {
 public:
  SpectralDensity(std::string name, Domain domain, Convexity convexity, H h)
      : h_(std::move(h)), name_(std::move(name)), domain_(domain), convexity_(convexity) {}
  std::string_view name() const { return name_; }
  Domain domain() const { return domain_; }
  Convexity convexity() const { return convexity_; }

  template <class T>
  T value(const T& x, const T& y) const {
    using namespace scalar_math;
    const T a = sqrt(x), b = sqrt(y);
    return h_(a + b, a - b);
  }
  // k_A = h_S + h_s, k_B = h_S - h_s. Below B = 1e-5 A the even expansion in B takes over: there
  // k_B / B = k_BB to 1e-10, while the quotient has lost five digits.
  template <class T>
  IsotropicJet<T> jet(const T& x, const T& y) const {
    using namespace scalar_math;
    const T a = sqrt(x), b = sqrt(y);
    const auto [S, s] = dual2_variables<T>(a + b, a - b);
    const Dual2<T, 2> h = h_(S, s);
    const T kA = h.d[0] + h.d[1], kB = h.d[0] - h.d[1];
    const T sum = h.hess(0, 0) + h.hess(1, 1), twice = T(2.0) * h.hess(1, 0);
    const T kAA = sum + twice, kBB = sum - twice, kAB = h.hess(0, 0) - h.hess(1, 1);
    const T tiny(kSmallestA), small = T(1e-5) * a;
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
  std::string name_;
  Domain domain_;
  Convexity convexity_;
};

template <class H>
InvariantDensity<H> invariant(std::string name, Domain domain, Convexity convexity, H h) {
  return {std::move(name), domain, convexity, std::move(h)};
}

template <class H>
SpectralDensity<H> spectral(std::string name, Domain domain, Convexity convexity, H h) {
  return {std::move(name), domain, convexity, std::move(h)};
}

}  // namespace majorant
