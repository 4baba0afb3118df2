// A linkage that moves: a crank turns once in 50 steps and swings a rocker by a rod; a weight hangs
// on a string where both meet. Bars are equalities, each step starts where the last one ended.
#include <numbers>

#include "majorant/framework/barrier_minimizer.h"
#include "majorant/framework/constraint.h"
#include "majorant/framework/terms/equality.h"
#include "majorant/framework/terms/local_term.h"
#include "outcome.h"
using namespace majorant;

int main() {
  // 1. Points of the plane: the end of the crank, where rod and rocker meet, the pivot of the
  // rocker, the weight. The crank turns about the origin.
  const double rod = 3.5, rocker = 3, string = 1;
  const Vector2 pivot(4, 0);
  const Vec lengths{{rod, rocker, string}};
  const auto bars =
      equality<2, 2>("bars", Cells{{0, 1}, {1, 2}, {1, 3}}, [lengths](Index e, const auto& z) {
        return (z.col(1) - z.col(0)).squaredNorm() / (lengths[e] * lengths[e]) - 1.0;
      });
  const auto weight = linear_term("weight", Vec::Unit(8, 7));  // its height
  // 2. The closed form: the lower one of the points where two circles meet.
  const auto joint = [&](const Vector2& crank) {
    const Vector2 along = (pivot - crank).normalized();
    const double distance = (pivot - crank).norm();
    const double part = (rod * rod - rocker * rocker + distance * distance) / (2 * distance);
    return Vector2(crank + part * along +
                   std::sqrt(rod * rod - part * part) * Vector2(along[1], -along[0]));
  };
  // 3. One turn. The first start is a sketch that no bar fits.
  Vec x{{1, 0, 3, -2, 4, 0, 3, -4}};
  BarrierResult result;
  double error = 0;
  std::size_t iterations = 0;
  const int steps = 50;
  for (int k = 0; k <= steps; ++k) {
    const double angle = 2 * std::numbers::pi * k / steps;
    const Vector2 crank(std::cos(angle), std::sin(angle));
    ProblemBuilder builder(8);
    builder.add(bars, 1).add(weight, 1).add(FixedPoints({{0, crank}, {2, pivot}}));
    const Problem problem = builder.build();
    result = BarrierMinimizer({}).run(problem, problem.reduce(x));
    if (result.status != Status::Converged) break;
    x = problem.expand(result.y);
    error = std::max(error, (x.segment<2>(2) - joint(crank)).norm());
    iterations += result.iterations.size();
  }
  std::cout << "joint within " << error << ", " << iterations << " iterations in all\n";
  // 4. The string carries the weight: its force is its multiplier times the derivative of g.
  const double force = 2 * result.multipliers.front()[2] / string;
  return outcome(result, "the force in the string", force, 1, error < 1e-8 ? 1e-8 : -1);
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
