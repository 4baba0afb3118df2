// The two small problems: value, gradient and Hessian of one function at one point. A row is a
// fixed number of evaluations, and its energy is the sum of the entries of the last result.
#include "majorant/framework/terms/dual_matrix.h"
#include "rows.h"

namespace majorant::tinyad {
namespace {

constexpr int kEvaluations = 1000000;

template <class F>
End evaluated(Watch& watch, const F& function) {
  SolveResult result;
  result.status = Status::Converged;
  volatile double shift = 0;  // prevents the compiler from removing evaluations
  double sum = 0;
  for (int k = 0; k < kEvaluations; ++k) {
    const auto f = function(shift);
    sum = f.v;
    for (const double d : f.d) sum += d;
    for (std::size_t i = 0; i < f.d.size(); ++i)
      for (std::size_t j = 0; j < f.d.size(); ++j)
        sum += f.hess(static_cast<int>(i), static_cast<int>(j));
  }
  watch.step({}, sum);
  result.y = Vec::Zero(1);
  return {result, sum};
}

End basic_by_variables(const Input&, Watch& watch) {
  return evaluated(watch, [](double shift) {
    // lines: basic, variables
    const auto x0 = Dual2<double, 2>::variable(3.5 + shift, 0);
    const auto x1 = Dual2<double, 2>::variable(5.0, 1);
    const auto z = -log(0.5 * sqrt(x0 * x0 + x1 * x1));
    // end
    return z;
  });
}

End basic_by_vector(const Input&, Watch& watch) {
  return evaluated(watch, [](double shift) {
    // lines: basic, vector
    const auto x = dual2_variables(Vector2(3.5 + shift, 5.0));
    const auto z = -log(0.5 * x.norm());
    // end
    return z;
  });
}

End angle_by_variables(const Input&, Watch& watch) {
  return evaluated(watch, [](double shift) {
    // lines: angle, variables
    using T = Dual2<double, 3>;
    const Eigen::Vector3<T> x(T::variable(shift, 0), T::variable(-1, 1), T::variable(1, 2));
    const Vector3 y(2.0, 3.0, 5.0);
    const auto angle = acos(x.dot(y) / (x.norm() * y.norm()));
    // end
    return angle;
  });
}

End angle_by_vector(const Input&, Watch& watch) {
  return evaluated(watch, [](double shift) {
    // lines: angle, vector
    const auto x = dual2_variables(Vector3(shift, -1.0, 1.0));
    const Vector3 y(2.0, 3.0, 5.0);
    const auto angle = acos(x.dot(y) / (x.norm() * y.norm()));
    // end
    return angle;
  });
}

}  // namespace

std::vector<TinyadProblem> derivatives() {
  return {{"basic", nothing, {{"variables", basic_by_variables}, {"vector", basic_by_vector}}},
          {"angle", nothing, {{"variables", angle_by_variables}, {"vector", angle_by_vector}}}};
}

}  // namespace majorant::tinyad

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
