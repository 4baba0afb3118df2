// Newton's method on springs and fits: Hessians that are singular when clamped, energies that
// vanish at their minimum.
#include <gtest/gtest.h>

#include <cmath>

#include "majorant/framework/argument_check.h"
#include "majorant/framework/levenberg_marquardt.h"
#include "majorant/framework/newton.h"
#include "majorant/framework/terms/least_squares.h"
#include "majorant/framework/terms/local_term.h"
#include "random.h"

namespace majorant {
namespace {

constexpr Index kNodes = 60;
constexpr double kWidth = 2, kHeight = 0.7, kRest = 3.0 / (kNodes + 1);

Vec straight() {
  Vec x(2 * (kNodes + 2));
  for (Index k = 0; k < kNodes + 2; ++k)
    x.segment<2>(2 * k) << kWidth * static_cast<double>(k) / (kNodes + 1) - 1, kHeight;
  return x;
}

// A rope of springs between two nails. Springs that are pressed have no stiffness across where
// their Hessian is clamped, so that of the rope is singular.
ProblemBuilder rope() {
  Cells pairs(kNodes + 1, 2);
  for (Index k = 0; k <= kNodes; ++k) pairs.row(k) << k, k + 1;
  const auto springs = make_term<2, 2>("springs", pairs, [](Index, const auto& z) {
    const auto part = ((z.col(1) - z.col(0)).norm() - kRest) / kRest;
    return 5.0 * kRest * part * part;
  });
  Vec load = Vec::Zero(2 * (kNodes + 2));
  for (Index k = 1; k <= kNodes; ++k) load[2 * k + 1] = 0.05;
  ProblemBuilder builder(load.size());
  builder.add(springs, 1).add(linear_term("load", load), 1);
  builder.add(FixedPoints::at({0, kNodes + 1}, straight()));
  return builder;
}

Vec rough(double amplitude, unsigned seed) {
  test::Random random(seed);
  return straight() + random.vector(straight().size(), -amplitude, amplitude);
}

TEST(Springs, RopesThatArePressedFallToAMinimum) {
  const Problem problem = rope().build();
  for (const double projection : {1.0, 2.0})
    for (const double amplitude : {0.002, 0.02, 0.1})
      for (unsigned seed = 0; seed < 20; ++seed) {
        NewtonOptions options;
        options.projection = projection;
        const SolveResult r =
            NewtonMinimizer(options).minimize(problem, problem.reduce(rough(amplitude, seed)), {});
        EXPECT_EQ(r.status, Status::Converged)
            << r.message << ", " << projection << " " << amplitude << " " << seed;
        EXPECT_LT(r.energy, 1) << projection << " " << amplitude << " " << seed;
        if (seed < 3) RecordProperty("steps", static_cast<int>(r.iterations.size()));
      }
}

class OutsideADisk final : public FeasibilityChecker {
 public:
  std::string_view name() const override { return "outside the disk"; }
  Verdict check(VecIn x) const override {
    Verdict verdict;
    for (Index k = 0; k < kNodes + 2; ++k) {
      const double room = x.segment<2>(2 * k).norm() - 0.5;
      verdict.margin = k == 0 ? room : std::min(verdict.margin, room);
    }
    verdict.feasible = verdict.margin > 0;
    return verdict;
  }
  StepBound max_step(VecIn x, VecIn d, double s) const override {
    for (Index k = 0; k < kNodes + 2; ++k) {
      const Vec2 p = x.segment<2>(2 * k), v = d.segment<2>(2 * k);
      const double a = v.squaredNorm(), b = p.dot(v), c = p.squaredNorm() - 0.25;
      if (a > 0 && b < 0 && b * b > a * c) s = std::min(s, (-b - std::sqrt(b * b - a * c)) / a);
    }
    return {s, {}};
  }

 private:
  using Vec2 = Eigen::Vector2d;
};

TEST(Springs, AStallLosesNoProgress) {
  const Problem problem = rope().add(std::make_shared<const OutsideADisk>()).build();
  for (const Vec& start : {straight(), rough(0.02, 3)}) {
    const SolveResult r = NewtonMinimizer().minimize(problem, problem.reduce(start), {});
    ASSERT_FALSE(r.iterations.empty());
    double least = r.iterations.front().energy;
    for (const IterationRecord& record : r.iterations) least = std::min(least, record.energy);
    EXPECT_EQ(r.energy, least) << r.message;
    EXPECT_LT(r.energy, r.iterations.front().energy);
  }
}

TEST(Springs, EnergiesThatVanishEndTheRun) {
  // z0^2 + (z1 - 1)^2
  Cells both(1, 2);
  both << 0, 1;
  const auto parabola = make_term<2>("parabola", both, [](Index, const auto& z) {
    return z[0] * z[0] + (z[1] - 1.0) * (z[1] - 1.0);
  });
  const Problem quadratic = ProblemBuilder(2).add(parabola, 1).build();
  for (const double scale : {1e-6, 1.0, 1e6}) {
    const SolveResult r = NewtonMinimizer().minimize(quadratic, Vec{{3 * scale, -4 * scale}}, {});
    EXPECT_EQ(r.status, Status::Converged) << r.message;
    EXPECT_LE(r.iterations.size(), 3u) << scale;
  }

  // Springs of a grid that are all at rest somewhere.
  constexpr Index n = 20;
  std::vector<std::array<Index, 2>> edges;
  Vec rest(2 * n * n);
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) {
      rest.segment<2>(2 * (n * i + j)) << static_cast<double>(i), static_cast<double>(j);
      if (i + 1 < n) edges.push_back({n * i + j, n * i + n + j});
      if (j + 1 < n) edges.push_back({n * i + j, n * i + j + 1});
      if (i + 1 < n && j + 1 < n) edges.push_back({n * i + j, n * i + n + j + 1});
    }
  Cells pairs(static_cast<Index>(edges.size()), 2);
  Vec length(pairs.rows());
  for (Index e = 0; e < pairs.rows(); ++e) {
    pairs.row(e) << edges[e][0], edges[e][1];
    length[e] = (rest.segment<2>(2 * pairs(e, 1)) - rest.segment<2>(2 * pairs(e, 0))).norm();
  }
  const auto fit = make_least_squares<2, 2>("springs", pairs, [length](Index e, const auto& z) {
    return (z.col(1) - z.col(0)).norm() - length[e];
  });
  ProblemBuilder builder(rest.size());
  const Problem springs = builder.add(fit, 1).add(FixedPoints::at({0, 1}, rest)).build();
  test::Random random(5);
  const Vec start = springs.reduce(rest + random.vector(rest.size(), -0.05, 0.05));
  NewtonOptions options;
  const SolveResult r = NewtonMinimizer(options).minimize(springs, start, {});
  EXPECT_EQ(r.status, Status::Converged) << r.message;
  EXPECT_LT(r.energy, 1e-18);
  EXPECT_LE(r.iterations.size(), 8u);
  const SolveResult lm = LevenbergMarquardtMinimizer().minimize(springs, start, {});
  EXPECT_EQ(lm.status, Status::Converged) << lm.message;
  EXPECT_LE(lm.iterations.size(), 20u);
}

// Far from a minimum the exact Hessian is indefinite in every step.
TEST(Newton, ShiftsAreRemembered) {
  Cells nodes(200, 2);
  for (Index k = 0; k < nodes.rows(); ++k) nodes.row(k) << k, k + 1;
  const auto wells = make_term<2>("wells", nodes, [](Index, const auto& z) {
    const auto d = z[1] - z[0];
    return d * d * d * d - 2.0 * d * d + 0.01 * z[0] * z[0] * z[1] * z[1];
  });
  const Problem problem = ProblemBuilder(201).add(wells, 1).build();
  NewtonOptions options;
  options.curvature = Curvature::Exact;
  test::Random random(2);
  const SolveResult r =
      NewtonMinimizer(options).minimize(problem, random.vector(201, -0.3, 0.3), {});
  EXPECT_EQ(r.status, Status::Converged) << r.message;
  int factorizations = 0;
  for (const IterationRecord& record : r.iterations) factorizations += record.factorizations;
  EXPECT_LE(factorizations, 2 * static_cast<int>(r.iterations.size()) + 8);
}

TEST(Newton, SaddlesAreSaid) {
  Cells both(1, 2);
  both << 0, 1;
  const auto saddle = make_term<2>("saddle", both, [](Index, const auto& z) {
    return z[0] * z[0] - z[1] * z[1] + z[1] * z[1] * z[1] * z[1];
  });
  const Problem problem = ProblemBuilder(2).add(saddle, 1).build();
  const SolveResult at_saddle = NewtonMinimizer().minimize(problem, Vec{{1, 0}}, {});
  EXPECT_EQ(at_saddle.status, Status::Converged);
  EXPECT_EQ(at_saddle.definite, Definite::No);
  EXPECT_NE(at_saddle.message.find("saddle"), std::string::npos) << at_saddle.message;
  const SolveResult at_minimum = NewtonMinimizer().minimize(problem, Vec{{1, 0.3}}, {});
  EXPECT_EQ(at_minimum.definite, Definite::Yes) << at_minimum.message;
  EXPECT_NEAR(at_minimum.energy, -0.25, 1e-9);
}

TEST(Newton, ProjectionsThatAreNone) {
  const Problem problem = rope().build();
  for (const double projection : {0.5, 2.5, std::nan("")}) {
    NewtonOptions options;
    options.projection = projection;
    EXPECT_THROW(NewtonStepper(problem, options), InvalidArgument) << projection;
  }
  NewtonOptions options;
  options.projection = 2;
  options.curvature = Curvature::Exact;
  EXPECT_THROW(NewtonStepper(problem, options), InvalidArgument);
  for (const auto change : {+[](NewtonOptions& o) { o.blend.fall = 2; },
                            +[](NewtonOptions& o) { o.blend.below = std::nan(""); },
                            +[](NewtonOptions& o) { o.line_search.boundary_fraction = 0; },
                            +[](NewtonOptions& o) { o.shifts.least = -1; },
                            +[](NewtonOptions& o) { o.shifts.fall = 1; }}) {
    NewtonOptions wrong;
    change(wrong);
    EXPECT_THROW(NewtonStepper(problem, wrong), InvalidArgument);
  }
  NewtonOptions negative;
  negative.stopping.relative_decrease = -1;
  EXPECT_THROW(NewtonMinimizer(negative).minimize(problem, problem.reduce(straight()), {}),
               InvalidArgument);
}

class SolverThatAnswersZero final : public LinearSolver {
 public:
  void analyze(const SparsePattern&) override {}
  FactorStatus factorize(const Vec&, double) override { return FactorStatus::Ok; }
  Solution solve(const Vec& b, Vec& p, double) override {
    p = Vec::Zero(b.size());
    return {};
  }
  std::string description() const override { return "zero"; }
};

TEST(Newton, ADirectionOfZeroIsNoMinimum) {
  NewtonOptions options;
  options.linear_solver = [] { return std::make_shared<SolverThatAnswersZero>(); };
  const Problem problem = rope().build();
  const SolveResult r =
      NewtonMinimizer(options).minimize(problem, problem.reduce(rough(0.1, 1)), {});
  EXPECT_EQ(r.status, Status::Failed);
  EXPECT_NE(r.message.find("answers 0"), std::string::npos) << r.message;
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
