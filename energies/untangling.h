// The untangling energy: finite for inverted elements too, and for eps -> 0 a barrier that moves
// det J above 0. [GKKPRS21], method.md section 7.
//
//     F_eps(J) = (|J|^2 + lambda (D^2 + 1)) / chi(eps, D),   D = det J,
//     chi = (D + sqrt(eps^2 + D^2)) / 2,  for D < 0 written eps^2 / (2 (sqrt(eps^2 + D^2) - D)).
//
// For volumes (SolidUntanglingDensity), chi^(2/3) makes the first part independent of the scale of
// J:
//
//     F_eps(J) = |J|^2 / chi(eps, D)^(2/3) + lambda (D^2 + 1) / chi(eps, D).
//
//   auto term = make_energy(space, rest, UntanglingDensity(1.0), {rule});
//   TermState state;
//   state.parameters = Vec::Constant(1, 0.5);        // eps shrinks between steps
//
// D^2 + 1 presumes determinants near 1, so the rest shapes should have the target areas. The energy
// does not measure distortion: it trades shape for area. Its Hessian is indefinite, so Projected is
// the curvature to use.
#pragma once

#include <cmath>
#include <limits>
#include <string_view>

#include "majorant/energies/solid_invariants.h"
#include "majorant/energies/spectral.h"
#include "majorant/framework/curvature.h"
#include "majorant/framework/types.h"

namespace majorant {

class UntanglingDensity final : public IsotropicDensity<UntanglingDensity, NoMajorant> {
 public:
  // eps > 0. lambda: weight of the area part relative to the shape part.
  explicit UntanglingDensity(double eps, double lambda = 1.0)
      : IsotropicDensity("untangling",
                         {Domain::Everywhere, Convexity::Unknown, Reweighting::Refused}, {}),
        eps_(eps),
        lambda_(lambda) {}
  // The only parameter is eps.
  static Index parameter_count() { return 1; }
  Vec parameters() const { return Vec::Constant(1, eps_); }
  UntanglingDensity with_parameters(const Vec& parameters) const {
    return UntanglingDensity(parameters[0], lambda_);
  }

  template <class T>
  T value_of(const T& x, const T& y) const {
    T inverse_chi, root;
    regularize(T(x - y), inverse_chi, root);
    return numerator(x, y) * inverse_chi;
  }
  // With g = 1 / chi and r = sqrt(eps^2 + D^2): g' = -g / r, g'' = 2 / r^3.
  template <class T>
  IsotropicJet<T> jet(const T& x, const T& y) const {
    const T two(2.0), four(4.0), lambda2(2.0 * lambda_), d = x - y;
    T g, r;
    regularize(d, g, r);
    const T g1 = T(-1.0) * (g / r), g2 = two / (r * r * r);
    const T n = numerator(x, y), nx = two + lambda2 * d, ny = two - lambda2 * d;
    const T kx = nx * g + n * g1, ky = ny * g - n * g1;
    const T kxx = lambda2 * g + two * nx * g1 + n * g2;
    const T kyy = lambda2 * g - two * ny * g1 + n * g2;
    const T kxy = (ny - nx) * g1 - lambda2 * g - n * g2;
    return {n * g, two * kx, two * ky, four * kxx, four * kxy, four * kyy};
  }

 private:
  template <class T>
  T numerator(const T& x, const T& y) const {
    const T d = x - y;
    return T(2.0) * (x + y) + T(lambda_) * (d * d + T(1.0));
  }
  template <class T>
  void regularize(const T& d, T& inverse_chi, T& root) const {
    using namespace scalar_math;
    root = sqrt(d * d + T(eps_ * eps_));
    const T q = T(0.5) * (root + abs(d));
    inverse_chi = select(d > T(0.0), T(1.0) / q, (q / T(0.25 * eps_)) / T(eps_));
  }

  double eps_, lambda_;
};

// The untangling energy of volumes.
class SolidUntanglingDensity final {
 public:
  static constexpr int rows = 3, dims = 3;
  static constexpr bool kSolidInvariants = true;
  const Traits traits{Domain::Everywhere, Convexity::Unknown, Reweighting::Refused};

  // eps > 0. lambda: weight of the volume part relative to the shape part.
  explicit SolidUntanglingDensity(double eps, double lambda = 1.0) : eps_(eps), lambda_(lambda) {}
  static Index parameter_count() { return 1; }
  Vec parameters() const { return Vec::Constant(1, eps_); }
  SolidUntanglingDensity with_parameters(const Vec& parameters) const {
    return SolidUntanglingDensity(parameters[0], lambda_);
  }
  std::string_view name() const { return "untangling"; }
  bool supports(Curvature c) const { return c == Curvature::Projected || c == Curvature::Exact; }

  double value_at(double n, double, double d) const {
    const double chi = chi_at(d, std::hypot(d, eps_)), root = std::cbrt(chi);
    return number_or_infinity(n / (root * root) + lambda_ * (d * d + 1) / chi);
  }
  // The derivatives of chi follow from chi' = chi / r.
  SolidJet jet_at(double n, double, double d) const {
    const double r = std::hypot(d, eps_), chi = chi_at(d, r), root = std::cbrt(chi);
    const auto derivatives = [&](double p, double(&out)[3]) {
      out[1] = -p * out[0] / r;
      out[2] = p * out[0] / r * (p + d / r) / r;
    };
    double shape[3] = {1 / (root * root)}, size[3] = {1 / chi};
    derivatives(2.0 / 3, shape);
    derivatives(1, size);
    const double area = d * d + 1;
    SolidJet jet(number_or_infinity(n * shape[0] + lambda_ * area * size[0]));
    jet.d = {shape[0], 0, n * shape[1] + lambda_ * (2 * d * size[0] + area * size[1])};
    // (n, n), (q, n), (q, q), (d, n), (d, q), (d, d)
    jet.h = {0, 0,
             0, shape[1],
             0, n * shape[2] + lambda_ * (2 * size[0] + 4 * d * size[1] + area * size[2])};
    return jet;
  }

 private:
  double chi_at(double d, double r) const {
    return d > 0 ? (d + r) / 2 : eps_ / (r - d) * (eps_ / 2);
  }
  static double number_or_infinity(double f) {
    return f == f ? f : std::numeric_limits<double>::infinity();
  }

  double eps_, lambda_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
