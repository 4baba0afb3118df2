// Levenberg-Marquardt and dogleg of Ceres on least-squares terms: equal minima, and refusals.
#include <glog/logging.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "framework/barrier_chain.h"
#include "majorant/framework/ceres_minimizer.h"
#include "majorant/framework/error.h"
#include "majorant/framework/levenberg_marquardt.h"
#include "majorant/framework/residual_term.h"
#include "majorant/framework/terms/least_squares.h"
#include "majorant/framework/terms/local_term.h"
#include "majorant/framework/terms/parameter_blocks.h"

namespace majorant {
namespace {

using test::Random;
using test::Rows;

constexpr std::array<CeresOptions::Method, 2> kTrustRegions{
    CeresOptions::Method::LevenbergMarquardt, CeresOptions::Method::Dogleg};

SolveResult by_ceres(CeresOptions::Method method, const Problem& problem, const Vec& y0,
                     RunObserver* observer = nullptr) {
  FLAGS_minloglevel = google::GLOG_FATAL;
  return CeresMinimizer({.method = method}).minimize(problem, y0, observer);
}

void expect_same_minimum(const Problem& problem, const Vec& y0) {
  const SolveResult ours = LevenbergMarquardtMinimizer().minimize(problem, y0, {});
  EXPECT_EQ(ours.status, Status::Converged) << ours.message;
  for (const CeresOptions::Method method : kTrustRegions) {
    double before = Evaluator(problem).value(y0);
    StepObserver observer([&](const TraceEntry& row, const Vec& y) {
      EXPECT_EQ(row.record.energy, Evaluator(problem).value(y));
      EXPECT_LE(row.record.energy, before);
      EXPECT_GE(row.record.factorizations, 1);
      before = row.record.energy;
      return Directive::Continue;
    });
    const SolveResult r = by_ceres(method, problem, y0, &observer);
    EXPECT_EQ(r.status, Status::Converged) << r.message;
    EXPECT_NEAR(r.energy, ours.energy, 1e-7 * ours.energy + 1e-15);
    EXPECT_GE(r.iterations.size(), 2u);
    EXPECT_EQ(r.energy, r.iterations.back().energy);
  }
}

// Returns a fit of y = a exp(b t) + c, perhaps with outliers.
std::shared_ptr<const EnergyTerm> curve(RobustLoss loss = {}, double outlier = 0) {
  Random random(1);
  const Vec t = Vec::LinSpaced(30, 0, 2);
  Vec y = (2 * (-1.5 * t.array()).exp() + 0.3).matrix() + 0.05 * random.vector(30);
  for (Index i = 0; i < 30; i += 7) y[i] += outlier;
  const Cells unknowns = Cells::Ones(30, 1) * Eigen::RowVector3i(0, 1, 2);
  return make_least_squares<3>(
      "curve", unknowns,
      [=](Index e, const auto& z) {
        using std::exp;
        return z[0] * exp(z[1] * t[e]) + z[2] - y[e];
      },
      std::move(loss));
}

TEST(CeresLeastSquares, Fits) {
  const Problem plain = ProblemBuilder(3).add(curve(), 1).build();
  expect_same_minimum(plain, Vec{{1, -1, 0}});
  for (const RobustLoss& loss : {huber_loss(0.1), soft_l1_loss(0.1), cauchy_loss(0.2)}) {
    const Problem robust = ProblemBuilder(3).add(curve(loss, 1), 1).build();
    expect_same_minimum(robust, Vec{{1, -1, 0}});
  }
}

TEST(CeresLeastSquares, WeightsCount) {
  const Problem problem = ProblemBuilder(3).add(curve(), 1).build();
  const TermId id = problem.terms().front();
  Vec weights = Vec::LinSpaced(30, 0, 3);  // the first sample has weight 0
  for (const double weight : {1e-3, 7.0}) {
    const Problem weighted = problem.with({{id, TermState{weight, weights}}});
    expect_same_minimum(weighted, Vec{{1, -1, 0}});
    const Problem robust =
        ProblemBuilder(3).add(curve(huber_loss(0.1), 1), TermState{weight, weights}).build();
    expect_same_minimum(robust, Vec{{1, -1, 0}});
  }
}

// Cameras of 3 and points of 2 unknowns, with a ring of observations of two residuals; the frame is
// free.
TEST(CeresLeastSquares, BlocksOfDifferentSizes) {
  constexpr Index cameras = 4, points = 10;
  Random random(2);
  const Vec truth = random.vector(3 * cameras + 2 * points);
  Cells first(cameras * points, 2);
  RowMatrix seen(first.rows(), 2);
  const auto view = [](const auto& camera, const auto& point) {
    using std::cos;
    using std::sin;
    using T = typename std::decay_t<decltype(camera)>::Scalar;
    const T c = cos(camera[2]), s = sin(camera[2]);
    return std::array<T, 2>{c * point[0] - s * point[1] + camera[0],
                            s * point[0] + c * point[1] + camera[1]};
  };
  for (Index c = 0, e = 0; c < cameras; ++c)
    for (Index p = 0; p < points; ++p, ++e) {
      first.row(e) << 3 * c, 3 * cameras + 2 * p;
      const std::array<double, 2> at =
          view(Vec(truth.segment<3>(3 * c)), Vec(truth.segment<2>(3 * cameras + 2 * p)));
      seen.row(e) << at[0] + 0.01 * random.uniform(), at[1] + 0.01 * random.uniform();
    }
  const auto term = make_least_squares("seen", ParameterBlocks<3, 2>(first),
                                       [=](Index e, const auto& camera, const auto& point) {
                                         auto r = view(camera, point);
                                         r[0] = r[0] - seen(e, 0);
                                         r[1] = r[1] - seen(e, 1);
                                         return r;
                                       });
  const Problem problem = ProblemBuilder(truth.size()).add(term, 2).build();
  expect_same_minimum(problem, truth + 0.1 * random.vector(truth.size()));
}

// Constraints are eliminated before Ceres gets residuals: fixed, tied and affine unknowns.
TEST(CeresLeastSquares, EliminatedUnknowns) {
  const Index n = 12;
  Random random(3);
  const Vec target = random.vector(n);
  Cells pairs(n - 1, 2);
  for (Index e = 0; e + 1 < n; ++e) pairs.row(e) << e, e + 1;
  const auto term = make_least_squares<2>("pairs", pairs, [target](Index e, const auto& z) {
    using T = typename std::decay_t<decltype(z)>::Scalar;
    return std::array<T, 2>{z[0] * z[1] - target[e], z[0] - z[1] - 0.3 * target[e + 1]};
  });
  Rows rows;
  rows.row({{0, 1}}, 0.7);
  rows.row({{3, 1}, {8, -1}}, 0);          // tied
  rows.row({{2, 1}, {5, 2}, {6, -1}}, 1);  // one unknown depends on two others
  const Problem problem = ProblemBuilder(n).add(term, 1).add(rows).build();
  ASSERT_EQ(problem.size(), n - 3);
  expect_same_minimum(problem, problem.reduce(Vec::Constant(n, 0.7)));
  const SolveResult r = by_ceres(kTrustRegions[0], problem, problem.reduce(Vec::Constant(n, 0.7)));
  double violation = 0;
  const Vec x = problem.expand(r.y);
  problem.reduce(x, &violation);
  EXPECT_LE(violation, 1e-12);
  EXPECT_EQ(x[0], 0.7);
}

TEST(CeresLeastSquares, OtherTermsAreRefusedByName) {
  const auto spring = make_term<2>("spring", Cells(Eigen::RowVector2i(0, 1)),
                                   [](Index, const auto& z) { return z[0] * z[0] + z[1]; });
  for (const CeresOptions::Method method : kTrustRegions)
    for (const auto& other : {spring, linear_term("load", Vec::Ones(3))}) {
      const Problem problem = ProblemBuilder(3).add(curve(), 1).add(other, 1).build();
      try {
        by_ceres(method, problem, Vec{{1, -1, 0}});
        ADD_FAILURE() << other->name();
      } catch (const InvalidArgument& e) {
        EXPECT_EQ(std::string(e.what()),
                  "CeresMinimizer: term '" + std::string(other->name()) +
                      "' is no sum of squares, which Levenberg-Marquardt and dogleg are for: make "
                      "it by make_least_squares(), or choose another method");
      }
    }
}

TEST(CeresLeastSquares, BadOptionsThrow) {
  const Problem problem = ProblemBuilder(3).add(curve(), 1).build();
  for (const CeresOptions::Method method : kTrustRegions)
    for (const CeresOptions& o : {CeresOptions{.method = method, .max_iterations = -1},
                                  CeresOptions{.method = method, .scale = 0},
                                  CeresOptions{.method = method, .function_tolerance = -1}})
      EXPECT_THROW(CeresMinimizer(o).minimize(problem, Vec{{1, -1, 0}}, {}), InvalidArgument);
}

// Minimizes (x - 3)^2 + (y - 1)^2 with x <= 1.
TEST(CeresLeastSquares, CheckersHoldPoints) {
  class Wall final : public FeasibilityChecker {
   public:
    std::string_view name() const override { return "wall"; }
    Verdict check(VecIn x) const override {
      Verdict v;
      v.feasible = x[0] <= 1;
      if (!v.feasible) v.blocking = {0};
      return v;
    }
    StepBound max_step(VecIn, VecIn, double s) const override { return {s, {}}; }
  };
  const auto term =
      make_least_squares<1>("targets", Cells(Eigen::Vector2i(0, 1)),
                            [](Index e, const auto& z) { return z[0] - (e == 0 ? 3.0 : 1.0); });
  const Problem problem =
      ProblemBuilder(2).add(term, 1).add(std::make_shared<const Wall>()).build();
  for (const CeresOptions::Method method : kTrustRegions) {
    StepObserver observer([&](const TraceEntry&, const Vec& y) {
      EXPECT_LE(y[0], 1);
      return Directive::Continue;
    });
    const SolveResult r = by_ceres(method, problem, Vec{{0, 0}}, &observer);
    EXPECT_EQ(r.status, Status::Stalled) << r.message;
    EXPECT_EQ(r.blocking, std::vector<Index>{0});
    EXPECT_LE(r.y[0], 1);
    EXPECT_EQ(r.energy, Evaluator(problem).value(r.y));
  }
}

// log z, NaN for negative z, which a first Gauss-Newton step from 4 reaches.
TEST(CeresLeastSquares, DomainsAreKept) {
  int outside = 0;
  const auto term =
      make_least_squares<1>("log", Cells(Cells::Zero(1, 1)), [&outside](Index, const auto& z) {
        using std::log;
        outside += z[0] < 0.0;
        return log(z[0]);
      });
  const Problem problem = ProblemBuilder(1).add(term, 1).build();
  for (const CeresOptions::Method method : kTrustRegions) {
    const SolveResult r = by_ceres(method, problem, Vec{{20}});
    EXPECT_EQ(r.status, Status::Converged) << r.message;
    EXPECT_NEAR(r.y[0], 1, 1e-6);
  }
  EXPECT_GT(outside, 0) << "the case is not tested";
}

TEST(CeresLeastSquares, RunsEndAtTheirLimits) {
  const Problem problem = ProblemBuilder(3).add(curve(), 1).build();
  const Vec start{{1, -1, 0}};
  for (const CeresOptions::Method method : kTrustRegions) {
    StepObserver observer([](const TraceEntry& row, const Vec&) {
      return row.record.iteration == 2 ? Directive::Interrupt : Directive::Continue;
    });
    const SolveResult stopped = by_ceres(method, problem, start, &observer);
    EXPECT_EQ(stopped.status, Status::Interrupted);
    EXPECT_EQ(stopped.iterations.size(), 2u);
    EXPECT_EQ(stopped.energy, Evaluator(problem).value(stopped.y));
    for (const int limit : {0, 1}) {
      const SolveResult r =
          CeresMinimizer({.method = method, .max_iterations = limit}).minimize(problem, start, {});
      EXPECT_EQ(r.status, Status::MaxIterations);
      EXPECT_EQ(static_cast<int>(r.iterations.size()), limit);
    }
    int polls = 0;
    const StopCheck check(
        [&polls] { return ++polls > 3 ? Directive::TimeLimit : Directive::Continue; });
    const SolveResult late =
        CeresMinimizer({.method = method, .stop = check}).minimize(problem, start, {});
    EXPECT_EQ(late.status, Status::TimeLimit);
  }
}

TEST(CeresLeastSquares, ExceptionsOfResidualsArrive) {
  int calls = 0;
  const auto term =
      make_least_squares<1>("thrower", Cells(Cells::Zero(1, 1)), [&calls](Index, const auto& z) {
        if (++calls > 5) throw std::domain_error("enough");
        return z[0] * z[0] - 2.0;
      });
  const Problem problem = ProblemBuilder(1).add(term, 1).build();
  for (const CeresOptions::Method method : kTrustRegions) {
    calls = 0;
    EXPECT_THROW(by_ceres(method, problem, Vec{{9}}), std::domain_error);
  }
}

// Residuals and Jacobians match the energy: J^T r is its gradient.
TEST(CeresLeastSquares, ResidualsOfATerm) {
  const auto term = curve();
  const auto* squares = dynamic_cast<const ResidualTerm*>(term.get());
  ASSERT_NE(squares, nullptr);
  const Vec x{{1.2, -0.7, 0.1}};
  Vec sum = Vec::Zero(3), r;
  double energy = 0;
  RowMatrix J;
  for (Index e = 0; e < 30; ++e) {
    squares->residuals(x, e, {}, r, &J);
    sum += J.transpose() * r;
    energy += 0.5 * squares->loss(r.squaredNorm())[0];
    Vec alone;
    squares->residuals(x, e, {}, alone, nullptr);
    EXPECT_EQ(alone, r);
  }
  const Problem problem = ProblemBuilder(3).add(term, 1).build();
  Vec gradient;
  EXPECT_NEAR(Evaluator(problem).gradient(x, gradient), energy, 1e-14 * energy);
  EXPECT_LE((gradient - sum).norm(), 1e-13 * sum.norm());
  EXPECT_EQ(dynamic_cast<const ResidualTerm*>(linear_term("load", x).get()), nullptr);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
