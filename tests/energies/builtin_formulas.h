// Textbook formulas of the built-in densities in the entries of J, and their documented properties,
// independent of the library.
#pragma once

#include <ceres/jet.h>

#include <Eigen/Dense>
#include <cmath>
#include <string>
#include <vector>

#include "energies/density_fixture.h"

namespace majorant::test {

using Real = long double;  // 11 bits more than double
using InnerJet = ceres::Jet<Real, 4>;
using NestedJet = ceres::Jet<InnerJet, 4>;

template <class T>
T constant(double c) {
  if constexpr (std::is_same_v<T, NestedJet>)
    return NestedJet(InnerJet(Real(c)));
  else
    return T(c);
}

// J = [[a, b], [c, d]].
template <class T>
struct Entries {
  T a, b, c, d;
  T norm() const { return a * a + b * b + c * c + d * d; }
  T det() const { return a * d - b * c; }
  // (Sigma + sigma)^2 and (Sigma - sigma)^2.
  T sum_squared() const { return (a + d) * (a + d) + (c - b) * (c - b); }
  T difference_squared() const { return (a - d) * (a - d) + (b + c) * (b + c); }
};

// (log Sigma + log sigma)^2 / 2 + (log Sigma - log sigma)^2 / 2. The second term is 2 atanh^2 of
// the square root of w = (Sigma - sigma)^2 / (Sigma + sigma)^2, a power series in w.
template <class T>
T log_isometric_formula(const Entries<T>& J, bool nearly_similar) {
  using std::log;
  using std::sqrt;
  const T half = constant<T>(0.5), one = constant<T>(1), logs = log(J.det());
  const T w = J.difference_squared() / J.sum_squared();
  if (nearly_similar) {
    const T series =
        one +
        w * (constant<T>(2) / constant<T>(3) +
             w * (constant<T>(23) / constant<T>(45) + w * (constant<T>(44) / constant<T>(105))));
    return half * logs * logs + constant<T>(2) * w * series;
  }
  const T t = sqrt(w), ratio = log((one + t) / (one - t));
  return half * logs * logs + half * ratio * ratio;
}

template <class T>
T builtin_formula(const std::string& name, const Entries<T>& J, bool nearly_similar) {
  using std::exp;
  using std::sqrt;
  const T one = constant<T>(1), two = constant<T>(2), four = constant<T>(4);
  const T n = J.norm(), det = J.det();
  if (name == "symmetric-dirichlet") return n + n / (det * det);
  if (name == "asap") return J.difference_squared();
  if (name == "mips") return n / det;
  if (name == "arap") return n - two * sqrt(J.sum_squared()) + two;
  if (name == "symmetric-arap") {  // sum of inverses = (Sigma + sigma) / det
    const T sum = sqrt(J.sum_squared());
    return n + n / (det * det) - two * sum - two * sum / det + four;
  }
  if (name == "log-isometric") return log_isometric_formula(J, nearly_similar);
  if (name == "authalic") return det + one / det;
  if (name == "amips-exponential") {
    const T average = (n / det + det + one / det) / four;
    return exp(constant<T>(5) * (average - one));
  }
  ADD_FAILURE() << "no formula for " << name << ": write one";
  return one;
}

// Returns value, gradient and Hessian by automatic differentiation.
inline PointResult builtin_oracle(const std::string& name, const Eigen::Matrix2d& j) {
  const double x[4] = {j(0, 0), j(0, 1), j(1, 0), j(1, 1)};
  NestedJet v[4];
  for (int i = 0; i < 4; ++i) v[i] = NestedJet(InnerJet(Real(x[i]), i), i);
  const bool near = norm_beta(j) < 1e-2 * norm_alpha(j);
  const NestedJet f = builtin_formula<NestedJet>(name, {v[0], v[1], v[2], v[3]}, near);
  PointResult m;
  m.value = static_cast<double>(f.a.a);
  for (int i = 0; i < 4; ++i) {
    m.gradient[i] = static_cast<double>(f.v[i].a);
    for (int k = 0; k < 4; ++k) m.hessian(i, k) = static_cast<double>(f.v[i].v[k]);
  }
  return m;
}

inline bool finite(const PointResult& m) {
  return std::isfinite(m.value) && m.gradient.allFinite() && m.hessian.allFinite();
}

// Properties of an energy that its header documents (energies/densities/*.h).
struct EnergyProperties {
  std::string name;
  bool everywhere;  // defined for every J
  bool majorizer, composite_majorizer, reweighted;
  double identity;  // value of an isometry
};
inline const std::vector<EnergyProperties>& documented_properties() {
  static const std::vector<EnergyProperties> all{
      {"symmetric-dirichlet", false, true, true, true, 4},
      {"asap", true, true, true, false, 0},
      {"mips", false, true, false, false, 2},
      {"arap", true, true, true, true, 0},
      {"symmetric-arap", false, true, true, true, 0},
      {"log-isometric", false, false, false, true, 0},
      {"authalic", false, false, false, false, 2},
      {"amips-exponential", false, false, false, false, 1},
  };
  return all;
}

// Returns Jacobians far from singularities: 0.2 <= B / A <= 0.85 (or above 1 where the density is
// defined there), scales 0.3..3.
inline std::vector<Eigen::Matrix2d> generic_jacobians(bool everywhere, int count = 60) {
  Random random(5);
  const auto direction = [&] {
    const double t = random.uniform(0, 2 * std::numbers::pi);
    return Vector2(std::cos(t), std::sin(t));
  };
  std::vector<Eigen::Matrix2d> out;
  for (int k = 0; k < count; ++k) {
    const double ratio =
        everywhere && k % 3 == 0 ? random.uniform(1.05, 4) : random.uniform(0.05, 0.85);
    const double scale = random.uniform(0.3, 3);
    out.push_back(from_parts(scale * direction(), scale * ratio * direction()));
  }
  return out;
}

}  // namespace majorant::test

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
