// A cube of tetrahedra, four edges of which are pulled to other places, with four energies.
//
// The rows of hard pins hold the edges exactly, after soft pins have moved them there without an
// inverted tetrahedron. Their energy is that of the tetrahedra alone, which is smaller with soft
// pins.
#include "majorant/elements/bernstein_space.h"
#include "majorant/energies/energies.h"
#include "majorant/framework/constraint.h"
#include "majorant/framework/terms/local_term.h"
#include "majorant/framework/terms/quadratic_penalty.h"
#include "rows.h"

namespace majorant::tinyad {
namespace {

// Factorizations take most of the time of volumes; the rows of densities use each for a few steps.
// lines: deformation
const auto sd = [](const auto& J) { return J.squaredNorm() + J.inverse().squaredNorm(); };
// end
// lines: deformation
const auto exp_sd = [](const auto& J) {
  using std::exp;
  return exp(J.squaredNorm() + J.inverse().squaredNorm());
};
// end
// lines: deformation
const auto amips = [](const auto& J) {
  using std::exp;
  const auto det = J.determinant();
  return exp(0.5 * (J.squaredNorm() / det + 0.5 * (det + 1.0 / det)));
};
// end
// lines: deformation
const auto conformal_amips = [](const auto& J) {
  using std::pow;
  return J.squaredNorm() / pow(J.determinant(), 2.0 / 3);
};
// end

template <class Formula>
End by_lambda(const Formula& formula, const Input& input, Watch& watch) {
  const RowMatrix &positions = input.array("positions"), &targets = input.array("targets");
  const Cells cells = input.cells("cells"), pins = input.cells("pins");
  // lines: deformation, lambda
  std::vector<Eigen::Matrix3d> inverse(cells.rows());
  Vec volume(cells.rows());
  for (Index t = 0; t < cells.rows(); ++t) {
    Eigen::Matrix3d rest;
    for (int k = 0; k < 3; ++k)
      rest.col(k) = (positions.row(cells(t, k + 1)) - positions.row(cells(t, 0))).transpose();
    inverse[t] = rest.inverse();
    volume[t] = rest.determinant() / 6;
  }
  const auto energy = make_term<4, 3>("energy", cells, [&](Index t, const auto& z) {
    using T = typename std::decay_t<decltype(z)>::Scalar;
    const auto J = ((z.template rightCols<3>().colwise() - z.col(0)) * inverse[t]).eval();
    return J.determinant() > 0.0 ? T(volume[t] * formula(J)) : T(INFINITY);
  });
  const auto pull = make_term<1, 3>("pull", pins, [&](Index e, const auto& z) {
    return (z.col(0) - targets.row(e).transpose()).squaredNorm();
  });
  ProblemBuilder builder(static_cast<Index>(positions.size()));
  builder.add(energy, 1).add(pull, 1e5);
  const Vec start = positions.reshaped<Eigen::RowMajor>();
  const NewtonMinimizer newton(watch.options());
  const SolveResult result = newton.minimize(builder.build(), start, &watch);
  // end
  return end_of(result);
}

template <class Formula>
End by_density(const Formula& formula, const Input& input, Watch& watch) {
  const RowMatrix &positions = input.array("positions"), &targets = input.array("targets");
  const Cells cells = input.cells("cells"), pins = input.cells("pins");
  // lines: deformation, density
  const auto space = std::make_shared<const BezierTetrahedronSpace>(cells, positions.rows(), 1);
  std::vector<FixedPoint3> held;
  for (Index e = 0; e < pins.rows(); ++e) held.push_back({pins(e, 0), targets.row(e)});
  const FixedPoints edges = FixedPoints::in_space(held);
  ProblemBuilder builder(static_cast<Index>(positions.size()));
  const RestShapes rest = flat_simplices(positions, cells);
  builder.add(make_energy(space, rest, density<3, 3>("energy", formula)), 1);
  builder.add(std::make_shared<QuadraticPenalty>(edges), 1e5);
  const Vec start = positions.reshaped<Eigen::RowMajor>();
  NewtonOptions options = watch.options();
  options.lagged.below = 0.1;
  const NewtonMinimizer newton(options);
  const SolveResult result = newton.minimize(builder.build(), start, &watch);
  // end
  return end_of(result);
}

template <class Formula>
End by_hard_pins(const Formula& formula, const Input& input, Watch& watch) {
  const RowMatrix &positions = input.array("positions"), &targets = input.array("targets");
  const Cells cells = input.cells("cells"), pins = input.cells("pins");
  // lines: deformation, hard pins
  const auto space = std::make_shared<const BezierTetrahedronSpace>(cells, positions.rows(), 1);
  std::vector<FixedPoint3> held;
  for (Index e = 0; e < pins.rows(); ++e) held.push_back({pins(e, 0), targets.row(e)});
  const FixedPoints edges = FixedPoints::in_space(held);
  ProblemBuilder soft(static_cast<Index>(positions.size())), hard = soft;
  const RestShapes rest = flat_simplices(positions, cells);
  const auto energy = make_energy(space, rest, density<3, 3>("energy", formula));
  soft.add(energy, 1).add(std::make_shared<QuadraticPenalty>(edges), 1e5);
  NewtonOptions options = watch.options(), rough = options;
  options.lagged.below = 0.1;
  rough.stopping.relative_decrease = 1e-2;
  const Vec start = positions.reshaped<Eigen::RowMajor>();
  const Vec x = NewtonMinimizer(rough).minimize(soft.build(), start, &watch).y;
  const Problem problem = hard.add(energy, 1).add(edges).build();
  const NewtonMinimizer newton(options);
  const SolveResult result = newton.minimize(problem, problem.reduce(x), &watch);
  // end
  return end_of(result);
}

template <class Formula>
TinyadProblem deformation_by(const std::string& name, const Formula& formula) {
  const auto row = [&formula](auto solve) {
    return [&formula, solve](const Input& i, Watch& w) { return solve(formula, i, w); };
  };
  return {"deformation " + name,
          cube,
          {{"lambda", row(by_lambda<Formula>)},
           {"density", row(by_density<Formula>)},
           {"hard pins", row(by_hard_pins<Formula>)}}};
}

}  // namespace

std::vector<TinyadProblem> deformation() {
  return {deformation_by("SD", sd), deformation_by("exp SD", exp_sd),
          deformation_by("AMIPS", amips), deformation_by("conformal AMIPS", conformal_amips)};
}

}  // namespace majorant::tinyad

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
