// Compares Newton, with the library's factorization and with CHOLMOD, with Ceres on the same
// problems: ten surfaces, degrees 1 to 3, three energies, up to 2000 unknowns. If both converge,
// the energies agree to 1e-7, and Newton's result satisfies Ceres' gradient tolerance.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "apps/compare/least_squares.h"
#include "majorant/framework/ceres_minimizer.h"
#include "majorant/framework/cholmod_solver.h"
#include "majorant/framework/newton.h"
#include "majorant/maps/quadrature_hierarchy.h"
#include "majorant/parametrization/initialization/start.h"
#include "majorant/parametrization/solve/normalized_start.h"
#include "majorant/parametrization/solve/parametrize.h"
#include "maps/test_maps.h"
#include "mesh/test_meshes.h"

namespace majorant {
namespace {

constexpr double kGradientTolerance = 1e-10;  // Ceres' default

struct Surface {
  std::string name;
  std::shared_ptr<const SurfaceMesh> mesh;
  BoundaryCondition boundary;
};

std::vector<Surface> surfaces() {
  const auto waves = [](double a, double b, double h) {
    return [=](double x, double y) { return h * std::sin(a * x + 0.2) * std::cos(b * y - 0.4); };
  };
  const auto dome = [](double x, double y) { return 1.2 - 2 * std::hypot(x - 0.5, y - 0.4); };
  using enum BoundaryCondition;
  return {{"bumpy", surface(grid(4, bumpy)), Free},
          {"bumpy, fixed", surface(grid(5, bumpy)), Fixed},
          {"waves", surface(grid(5, waves(4, 1, 0.3))), Free},
          {"steep waves", surface(grid(6, waves(3, 5, 0.5))), Free},
          {"steep waves, fixed", surface(grid(4, waves(5, 3, 0.4))), Fixed},
          {"pyramid", surface(grid(5, dome)), Free},
          {"pyramid, fixed", surface(grid(6, dome)), Fixed},
          {"open fan", surface(cone(7, false)), Free},
          {"cone", surface(cone(9, true)), Free},
          {"shallow", surface(grid(6, waves(2, 2, 0.1))), Fixed}};
}

// The problem of all solvers. Degree 1 starts from Tutte's map, higher degrees from the elevated
// optimum of degree 1, so that paths are short and lead to the same minimum.
struct Case {
  MapSpecification specification;
  std::shared_ptr<const BezierTriangleSpace> space;
  Quadrature rule;
  Problem problem;
  Vec y0;

  Case(const Surface& s, const NamedEnergy& energy, int degree) {
    ParametrizationOptions options;
    options.map.degree = 1;
    options.map.energy = {{energy.make}};
    options.map.boundary = s.boundary;
    // Scale and position of a conformal map are arbitrary, so that two far corners are held.
    if (energy.make.traits().free_scale != FreeScale::Determined &&
        s.boundary == BoundaryCondition::Free)
      options.map.pins = {{1, {}}, {s.mesh->vertex_count() - 1, {}}};
    const NormalizedStart start(BezierMap::linear(s.mesh, initial_map(*s.mesh, options.map)),
                                options.map);
    const BezierMap linear = start.map();
    specification = start.specification();
    if (degree == 1) {  // from the initial map itself
      y0 = build(linear.shared_space(), linear.control_points());
      return;
    }
    BezierMap map(linear.shared_mesh(), linear.shared_space(),
                  optimum(linear.shared_space(), linear.control_points()));
    map = elevated_to(map, degree);
    y0 = build(map.shared_space(), map.control_points());
  }

  Vec build(const std::shared_ptr<const BezierTriangleSpace>& on, const Vec& x) {
    space = on;
    rule = optimizer_quadrature(on->degree(), 0).guarded.front();
    const auto injectivity =
        std::make_shared<const LocalInjectivity>(on, 2 * specification.rest->measure);
    problem =
        map_problem(specification, on, x, energy_terms(specification, on, {rule}), injectivity)
            .problem;
    return problem.reduce(x);
  }
  Vec optimum(const std::shared_ptr<const BezierTriangleSpace>& on, const Vec& x) {
    const Vec y = build(on, x);
    return problem.expand(NewtonMinimizer().minimize(problem, y, {}).y);
  }
};

NewtonOptions tight() {
  NewtonOptions options;
  options.stopping.relative_decrease = 1e-15;
  options.stopping.decrement = 1e-24;
  return options;
}

class CeresCrossCheck : public testing::TestWithParam<const char*> {};

TEST_P(CeresCrossCheck, EnergiesAgree) {
  int compared = 0, total = 0;
  std::size_t iterations = 0;
  for (const Surface& s : surfaces())
    for (int degree = 1; degree <= 3; ++degree) {
      const Case c(s, *find_energy(GetParam()), degree);
      SCOPED_TRACE(fmt::format("{}, degree {}, {} unknowns", s.name, degree, c.problem.size()));
      ASSERT_LE(c.problem.size(), 2000);
      ++total;
      const SolveResult ours = NewtonMinimizer(tight()).minimize(c.problem, c.y0, {});
      NewtonOptions by_cholmod = tight();
      by_cholmod.linear_solver = [] { return make_cholmod_solver(); };
      const SolveResult same = NewtonMinimizer(by_cholmod).minimize(c.problem, c.y0, {});
      EXPECT_NEAR(same.energy, ours.energy, 1e-9 * std::abs(ours.energy) + 1e-12);
      const SolveResult theirs = CeresMinimizer().minimize(c.problem, c.y0, {});
      // MIPS at degree 3, without the remedies of parametrize(): on some surfaces Newton stops at
      // the injectivity limit (up to 1.5 % above Ceres, or with small decreases near the minimum),
      // and Ceres does not converge on the pyramid.
      const bool may_end_early = std::string(GetParam()) == "mips" && degree == 3;
      const bool both = ours.status == Status::Converged && theirs.status == Status::Converged;
      EXPECT_TRUE(both || may_end_early) << ours.message << "; " << theirs.message;
      if (!both) continue;
      ++compared;
      iterations += theirs.iterations.size();
      EXPECT_NEAR(ours.energy, theirs.energy, 1e-7 * std::abs(theirs.energy) + 1e-12);
      if (may_end_early) continue;
      Vec gradient;
      Evaluator(c.problem).gradient(ours.y, gradient);
      EXPECT_LE(gradient.cwiseAbs().maxCoeff(), kGradientTolerance);
    }
  EXPECT_GT(iterations,
            static_cast<std::size_t>(10 * total));  // Ceres did not start at the minimum
  EXPECT_GE(3 * compared, 2 * total);
}

INSTANTIATE_TEST_SUITE_P(Energies, CeresCrossCheck,
                         testing::Values("symmetric-dirichlet", "mips", "arap"));

// Tests the least-squares formulation: residuals J and J^-1, damped Gauss-Newton, Ceres' assembly.
TEST(CeresCrossCheck, LeastSquaresFindsTheSameMinimum) {
  for (const Surface& s : surfaces())
    for (int degree = 1; degree <= 2; ++degree) {
      const Case c(s, *find_energy("symmetric-dirichlet"), degree);
      SCOPED_TRACE(fmt::format("{}, degree {}", s.name, degree));
      LeastSquaresOptions options;
      options.max_iterations = 3000;
      const LeastSquaresMinimizer lm(c.space, *c.specification.rest, c.rule, options);
      const SolveResult theirs = lm.minimize(c.problem, c.y0, {});
      const SolveResult ours = NewtonMinimizer(tight()).minimize(c.problem, c.y0, {});
      // Ceres reports the energy of the problem at its result.
      EXPECT_NEAR(theirs.energy, Evaluator(c.problem).value(theirs.y), 1e-12 * theirs.energy);
      EXPECT_EQ(ours.status, Status::Converged) << ours.message;
      EXPECT_EQ(theirs.status, Status::Converged) << theirs.message;
      EXPECT_NEAR(ours.energy, theirs.energy, 1e-7 * theirs.energy);
    }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
