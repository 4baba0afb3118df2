// A hexagon whose corners are pulled, with the triangulation of least stretch: a discrete choice
// within the energy.
#include "majorant/framework/terms/dual_matrix.h"
#include "majorant/framework/terms/local_term.h"
#include "rows.h"

namespace majorant::tinyad {
namespace {

constexpr int kCorners = 6;
using Hexagon = Eigen::Matrix<double, 2, kCorners>;

Hexagon regular_hexagon() {
  Hexagon out;
  for (int k = 0; k < kCorners; ++k) out.col(k) << std::cos(k * M_PI / 3), std::sin(k * M_PI / 3);
  return out;
}

// lines: polygon
template <class Z>
auto distortion(const Z& z, const Hexagon& rest, int a, int b, int c) {
  using T = typename Z::Scalar;
  Eigen::Matrix<T, 2, 2> now;
  Eigen::Matrix2d then;
  now << z.col(b) - z.col(a), z.col(c) - z.col(a);
  then << rest.col(b) - rest.col(a), rest.col(c) - rest.col(a);
  if (!(now.determinant() > 0.0)) return T(INFINITY);
  const auto J = (now * then.inverse()).eval();
  return T(0.5 * then.determinant() * (J.squaredNorm() + J.inverse().squaredNorm()));
}
// end

// lines: polygon
template <class Z>
auto pulls(const Z& z) {
  return (z.col(0) - Vector2(-2, -1)).squaredNorm() + (z.col(1) - Vector2(2, -1)).squaredNorm() +
         (z.col(3) - Vector2(0, -1)).squaredNorm() + (z.col(4) - Vector2(-4, 1)).squaredNorm();
}
// end

// Finds the best triangulation of the values by dynamic programming, and then evaluates the energy
// of its triangles.
End by_lambda(const Input&, Watch& watch) {
  const Hexagon rest = regular_hexagon();
  // lines: polygon, lambda
  const auto term =
      make_term<6, 2>("hexagon", Cells{{0, 1, 2, 3, 4, 5}}, [&](Index, const auto& z) {
        using T = typename std::decay_t<decltype(z)>::Scalar;
        const auto values = passive(z);
        Eigen::Matrix<double, 6, 6> cost = Eigen::Matrix<double, 6, 6>::Zero();
        Eigen::Matrix<int, 6, 6> between;
        for (int gap = 2; gap < 6; ++gap)
          for (int i = 0, k = gap; k < 6; ++i, ++k) {
            cost(i, k) = INFINITY;
            for (int j = i + 1; j < k; ++j) {
              const double c = cost(i, j) + distortion(values, rest, i, j, k) + cost(j, k);
              if (!(c <= cost(i, k))) continue;
              cost(i, k) = c;
              between(i, k) = j;
            }
          }
        T energy = pulls(z);
        const auto add = [&](const auto& again, int i, int k) -> void {
          if (k - i < 2) return;
          const int j = between(i, k);
          energy += distortion(z, rest, i, j, k);
          again(again, i, j);
          again(again, j, k);
        };
        add(add, 0, 5);
        return energy;
      });
  ProblemBuilder builder(12);
  builder.add(term, 1);
  const NewtonMinimizer newton(watch.options());
  const SolveResult result = newton.minimize(builder.build(), rest.reshaped(), &watch);
  // end
  return end_of(result);
}

// Computes the minimum over all triangulations with its derivatives: min() of dual numbers has
// those of the smaller argument, or of the first one if both are equal.
End by_minimum(const Input&, Watch& watch) {
  const Hexagon rest = regular_hexagon();
  // lines: polygon, minimum
  const auto term =
      make_term<6, 2>("hexagon", Cells{{0, 1, 2, 3, 4, 5}}, [&](Index, const auto& z) {
        using std::min;
        using T = typename std::decay_t<decltype(z)>::Scalar;
        const auto least = [&](const auto& again, int i, int k) -> T {
          T best = k - i < 2 ? 0.0 : INFINITY;
          for (int j = i + 1; j < k; ++j)
            best = min(T(again(again, i, j) + distortion(z, rest, i, j, k) + again(again, j, k)),
                       best);
          return best;
        };
        return T(least(least, 0, 5) + pulls(z));
      });
  ProblemBuilder builder(12);
  builder.add(term, 1);
  const NewtonMinimizer newton(watch.options());
  const SolveResult result = newton.minimize(builder.build(), rest.reshaped(), &watch);
  // end
  return end_of(result);
}

}  // namespace

std::vector<TinyadProblem> polygon() {
  return {{"polygon", nothing, {{"lambda", by_lambda}, {"minimum", by_minimum}}}};
}

}  // namespace majorant::tinyad

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
