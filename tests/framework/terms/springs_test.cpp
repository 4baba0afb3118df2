// Newton's method on springs and fits: singular clamped Hessians, energies that are 0 at their
// minimum.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "majorant/framework/argument_check.h"
#include "majorant/framework/curvature_choice.h"
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

// Returns a rope of springs between two fixed ends. The clamped Hessian of compressed springs has
// no transversal stiffness, so that that of the rope is singular.
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

TEST(Springs, CompressedRopesReachAMinimum) {
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

Vec free_net_at_rest(Index n) {
  Vec x(2 * n * n);
  for (Index k = 0; k < n * n; ++k) x.segment<2>(2 * k) << k % n, k / n;
  return x;
}

// Returns the sides and one diagonal of the squares of n by n nodes.
Cells net_edges(Index n) {
  std::vector<std::array<Index, 2>> edges;
  for (Index k = 0; k < n * n; ++k) {
    if (k % n + 1 < n) edges.push_back({k, k + 1});
    if (k / n + 1 < n) edges.push_back({k, k + n});
    if (k % n + 1 < n && k / n + 1 < n) edges.push_back({k, k + n + 1});
  }
  Cells pairs(static_cast<Index>(edges.size()), 2);
  for (Index e = 0; e < pairs.rows(); ++e)
    pairs.row(e) << edges[to_size(e)][0], edges[to_size(e)][1];
  return pairs;
}

// Returns a net of n by n nodes with incompatible springs, whose minimum is above 0.
Problem free_net(Index n) {
  const Cells pairs = net_edges(n);
  const auto springs = make_term<2, 2>("net", pairs, [](Index e, const auto& z) {
    const auto part = (z.col(1) - z.col(0)).norm() - (1 + 0.1 * (e % 5));
    return part * part;
  });
  return ProblemBuilder(2 * n * n).add(springs, 1).build();
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
  // The term z0^2 + (z1 - 1)^2.
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

  // All springs of the grid are at rest in one configuration.
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

TEST(Newton, SaddlesAreReported) {
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

// x^2 - y^2 + y^4 in each pair of unknowns: 2^n saddles and minima, from a start on the ridge.
TEST(Newton, LeavesSaddlesOnRequest) {
  Cells pairs(5, 2);
  for (Index e = 0; e < 5; ++e) pairs.row(e) << 2 * e, 2 * e + 1;
  const auto saddles = make_term<2>("saddles", pairs, [](Index, const auto& z) {
    const auto square = z[1] * z[1];
    return z[0] * z[0] - square + square * square;
  });
  const Problem problem = ProblemBuilder(10).add(saddles, 1).build();
  Vec start = Vec::Zero(10);
  for (Index e = 0; e < 5; ++e) start[2 * e] = 1;
  NewtonOptions options;
  options.saddles_to_leave = 6;
  const SolveResult r = NewtonMinimizer(options).minimize(problem, start, {});
  EXPECT_EQ(r.status, Status::Converged) << r.message;
  EXPECT_EQ(r.definite, Definite::Yes) << r.message;
  EXPECT_NEAR(r.energy, -1.25, 1e-9);
  for (std::size_t k = 0; k < r.iterations.size(); ++k)
    EXPECT_EQ(r.iterations[k].iteration, static_cast<int>(k) + 1);
  options.tests_minimum = false;
  EXPECT_THROW(NewtonStepper(problem, options), InvalidArgument);
}

// The springs of a net are free: two translations and a rotation do not change the energy.
TEST(Newton, AGaugeFixesTheKernelOfTheHessian) {
  const Problem problem = free_net(12);
  test::Random random(4);
  const Vec start = free_net_at_rest(12) + random.vector(problem.size(), -0.2, 0.2);
  NewtonOptions options;
  const SolveResult free = NewtonMinimizer(options).minimize(problem, start, {});
  options.near_null_space = [](const Problem& p) -> Eigen::MatrixXd {
    return Eigen::Matrix2d::Identity().replicate(p.size() / 2, 1);
  };
  options.holds_null_space = true;
  const SolveResult held = NewtonMinimizer(options).minimize(problem, start, {});
  const auto failed = [](const SolveResult& r) {
    int count = 0;
    for (const IterationRecord& record : r.iterations) count += record.failed_factorizations;
    return count;
  };
  EXPECT_EQ(held.status, Status::Converged) << held.message;
  EXPECT_NEAR(held.energy, free.energy, 1e-9 * free.energy);
  EXPECT_LE(failed(held), failed(free));
  EXPECT_LE(held.iterations.size(), free.iterations.size() + 1);
  options.near_null_space = {};
  EXPECT_THROW(NewtonStepper(problem, options), InvalidArgument);
}

TEST(Newton, InvalidProjectionsAreRefused) {
  const Problem problem = rope().build();
  for (const double projection : {-0.5, 2.5, std::nan("")}) {
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

// Runs do not depend on a constant in the energy, on units of energy and unknowns, and on the
// origin.
TEST(Newton, RunsAreTheSameInOtherUnits) {
  struct Units {
    double constant = 0, energy = 1, length = 1, origin = 0;
  };
  const auto run = [](const Units& u, int which, unsigned seed) {
    const double length = u.length, energy = u.energy, origin = u.origin, constant = u.constant;
    test::Random random(seed);
    if (which == 0) {  // the perturbed net
      const Index n = 7;
      const Cells pairs = net_edges(n);
      const double share = constant / static_cast<double>(pairs.rows());
      const auto springs = make_term<2, 2>("net", pairs, [=](Index e, const auto& z) {
        const auto part = (z.col(1) - z.col(0)).norm() / length - (1 + 0.1 * (e % 5));
        return energy * (part * part + share);
      });
      ProblemBuilder builder(2 * n * n);
      builder.add(springs, 1);
      const Vec rest = free_net_at_rest(n);
      Vec start = rest + random.vector(rest.size(), -0.2, 0.2);
      start = length * start + Vec::Constant(rest.size(), origin);
      builder.add(FixedPoints::at({0, n - 1}, start));
      const Problem problem = builder.build();
      return NewtonMinimizer().minimize(problem, problem.reduce(start), {});
    }
    Cells pairs(9, 2);  // a chain of Rosenbrock's valleys
    for (Index e = 0; e < 9; ++e) pairs.row(e) << e, e + 1;
    const auto valleys = make_term<2>("valleys", pairs, [=](Index, const auto& z) {
      const auto x = (z[0] - origin) / length, y = (z[1] - origin) / length;
      const auto a = y - x * x, b = 1 - x;
      return energy * (100.0 * a * a + b * b + constant / 9);
    });
    const Problem problem = ProblemBuilder(10).add(valleys, 1).build();
    const Vec start = length * random.vector(10, -1, 1) + Vec::Constant(10, origin);
    return NewtonMinimizer().minimize(problem, start, {});
  };
  for (const int which : {0, 1})
    for (const unsigned seed : {1u, 2u, 3u}) {
      const SolveResult usual = run({}, which, seed);
      ASSERT_EQ(usual.status, Status::Converged) << usual.message;
      const double e0 = usual.iterations.front().energy;
      std::vector<Units> all;
      for (const double c : {-1.0, 1.0, 1e3, -1e3, 1e6, -1e6}) all.push_back({.constant = c * e0});
      all.push_back({.constant = -usual.energy});
      for (const double s : {1e-12, 1e-6, 1e6, 1e12}) all.push_back({.energy = s});
      for (const double s : {1e-6, 1e-3, 1e3, 1e6}) all.push_back({.length = s});
      for (const double s : {-1e3, 1e3}) all.push_back({.origin = s});
      for (const Units& u : all) {
        const SolveResult r = run(u, which, seed);
        EXPECT_EQ(r.status, usual.status)
            << r.message << " " << which << " " << seed << " constant " << u.constant << " energy "
            << u.energy << " length " << u.length << " origin " << u.origin;
        EXPECT_NEAR(static_cast<double>(r.iterations.size()),
                    static_cast<double>(usual.iterations.size()), 1)
            << r.message << " " << which << " " << seed << " constant " << u.constant << " energy "
            << u.energy << " length " << u.length << " origin " << u.origin;
      }
    }
}

TEST(Newton, AnEnergyWithoutAMinimumEndsSoon) {
  const auto falling = make_term<1>("-log", Cells::Zero(1, 1), [](Index, const auto& z) {
    using std::log;
    return -log(z[0]);
  });
  const Problem problem = ProblemBuilder(1).add(falling, 1).build();
  for (const double start : {1e-3, 1.0, 1e3}) {
    const SolveResult r = NewtonMinimizer().minimize(problem, Vec{{start}}, {});
    EXPECT_EQ(r.status, Status::Failed) << r.message;
    EXPECT_NE(r.message.find("unbounded"), std::string::npos) << r.message;
    EXPECT_LE(r.iterations.size(), 60u) << start;
  }
}

TEST(Newton, TheAdaptiveProjectionSolvesTheProblemsOfBoth) {
  const Problem problem = rope().build();
  for (unsigned seed = 0; seed < 20; ++seed) {
    NewtonOptions options;
    options.set_curvature(*curvature_choice("adaptive"));
    const SolveResult r =
        NewtonMinimizer(options).minimize(problem, problem.reduce(rough(0.02, seed)), {});
    EXPECT_EQ(r.status, Status::Converged) << r.message << " " << seed;
    EXPECT_LT(r.energy, 1) << seed;
    EXPECT_EQ(r.iterations.front().projection_weight, 2);
  }
  EXPECT_FALSE(curvature_choice("best"));
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
