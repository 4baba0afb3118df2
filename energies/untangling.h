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
  static constexpr int rows = 3, dims = 3, size = 9;
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

  double value(const double (&z)[size]) const {
    double cofactors[size];
    const double d = determinant(z, cofactors);
    const Parts parts = parts_at(d);
    const double f = squared_norm(z) * parts.shape[0] + lambda_ * (d * d + 1) * parts.size[0];
    return f == f ? f : std::numeric_limits<double>::infinity();
  }
  void slope(const double (&z)[size], PointModel<double, size>& m) const {
    differentiate<false>(z, m);
  }
  void model(const double (&z)[size], PointModel<double, size>& m) const {
    differentiate<true>(z, m);
  }

 private:
  // chi^(-2/3), chi^(-1) and their first and second derivatives by D, from chi' = chi / r.
  struct Parts {
    double shape[3], size[3];
  };
  Parts parts_at(double d) const {
    const double r = std::hypot(d, eps_);
    const double chi = d > 0 ? (d + r) / 2 : eps_ / (r - d) * (eps_ / 2);
    const auto power = [&](double p, double(&out)[3]) {
      out[0] = std::pow(chi, -p);
      out[1] = -p * out[0] / r;
      out[2] = p * out[0] / r * (p + d / r) / r;
    };
    Parts parts;
    power(2.0 / 3, parts.shape);
    power(1, parts.size);
    return parts;
  }

  static double squared_norm(const double (&z)[size]) {
    double sum = 0;
    for (const double entry : z) sum += entry * entry;
    return sum;
  }
  // Returns the cofactor of entry r, row by row: the minor of the other rows and columns, in the
  // order with sign +.
  static double minor(const double (&z)[size], int r) {
    const int i = (r / 3 + 1) % 3, k = (r / 3 + 2) % 3, j = (r % 3 + 1) % 3, l = (r % 3 + 2) % 3;
    return z[3 * i + j] * z[3 * k + l] - z[3 * i + l] * z[3 * k + j];
  }
  static double determinant(const double (&z)[size], double (&cofactors)[size]) {
    for (int r = 0; r < size; ++r) cofactors[r] = minor(z, r);
    return z[0] * cofactors[0] + z[1] * cofactors[1] + z[2] * cofactors[2];
  }

  // The energy is f = n s(D) + q(D), so df = s dn + (n s' + q') dD, and so on; dn = 2 J.
  template <bool with_curvature>
  void differentiate(const double (&z)[size], PointModel<double, size>& m) const {
    double c[size];
    const double d = determinant(z, c), n = squared_norm(z);
    const auto [s, g] = parts_at(d);
    const double by_d = n * s[1] + lambda_ * (2 * d * g[0] + (d * d + 1) * g[1]);
    m.f = n * s[0] + lambda_ * (d * d + 1) * g[0];
    if (m.f != m.f) m.f = std::numeric_limits<double>::infinity();
    for (int r = 0; r < size; ++r) m.g[r] = 2 * s[0] * z[r] + by_d * c[r];
    if constexpr (with_curvature) {
      const double by_dd = n * s[2] + lambda_ * (2 * g[0] + 4 * d * g[1] + (d * d + 1) * g[2]);
      for (int r = 0, p = 0; r < size; ++r)
        for (int q = 0; q <= r; ++q, ++p)
          m.k[p] = (r == q ? 2 * s[0] : 0) + 2 * s[1] * (z[r] * c[q] + c[r] * z[q]) +
                   by_dd * c[r] * c[q] + by_d * second(z, r, q);
    }
  }
  // Returns the second derivative of D by two entries. If they are in different rows and columns it
  // is the entry of the third row and column, positive if the rows follow each other as the columns
  // do.
  static double second(const double (&z)[size], int r, int q) {
    const int i = r / 3, j = r % 3, k = q / 3, l = q % 3;
    if (i == k || j == l) return 0;
    const bool same = ((k - i + 3) % 3 == 1) == ((l - j + 3) % 3 == 1);
    const double third = z[3 * (3 - i - k) + 3 - j - l];
    return same ? third : -third;
  }

  double eps_, lambda_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
