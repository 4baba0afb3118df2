// The untangling energy: finite for inverted elements too, and for eps -> 0 a barrier that pushes
// det J above 0. [GKKPRS21], method.md section 7.
//
//     F_eps(J) = (|J|^2 + lambda (D^2 + 1)) / chi(eps, D),   D = det J,
//     chi = (D + sqrt(eps^2 + D^2)) / 2,  for D < 0 written eps^2 / (2 (sqrt(eps^2 + D^2) - D)).
//
//   auto term = make_energy(space, rest, UntanglingDensity(1.0), {rule});
//   TermState state;
//   state.parameters = Vec::Constant(1, 0.5);        // eps shrinks between steps
//
// D^2 + 1 presumes determinants near 1: scale the rest shapes to the areas that are wanted. Not for
// measuring distortion: it trades shape for area. Its Hessian is indefinite: use Projected.
#pragma once

#include "majorant/energies/spectral.h"
#include "majorant/framework/types.h"

namespace majorant {

class UntanglingDensity final : public IsotropicDensity<UntanglingDensity, NoMajorant> {
 public:
  // eps > 0; lambda: weight of the area part against the shape part.
  explicit UntanglingDensity(double eps, double lambda = 1.0)
      : IsotropicDensity("untangling",
                         {Domain::Everywhere, Convexity::Unknown, Reweighting::Refused}, {}),
        eps_(eps),
        lambda_(lambda) {}
  // The one parameter is eps.
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

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
