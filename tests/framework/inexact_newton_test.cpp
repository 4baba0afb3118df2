// Iterative linear solvers, which receive the required accuracy and report the reached one.
#include <gtest/gtest.h>

#include <Eigen/SparseCore>
#include <memory>
#include <utility>
#include <vector>

#include "framework/barrier_chain.h"
#include "framework/scalar_terms.h"
#include "majorant/framework/error.h"
#include "majorant/framework/first_order.h"
#include "majorant/framework/newton.h"

namespace majorant {
namespace {

using test::BarrierChain;

struct Requested {
  std::vector<double> tolerances;
  std::vector<double> shifts;
};

// Conjugate gradients with a limit of iterations. `broken`: the first solves report a breakdown.
class Cg final : public LinearSolver {
 public:
  Cg(std::shared_ptr<Requested> requested, int most, int broken)
      : requested_(std::move(requested)), most_(most), broken_(broken) {}
  void analyze(const SparsePattern& p) override { pattern_ = &p; }
  FactorStatus factorize(const Vec& values, double shift) override {
    requested_->shifts.push_back(shift);
    const Index n = pattern_->size;
    h_ = Eigen::Map<const Eigen::SparseMatrix<double>>(n, n, pattern_->nonzeros(),
                                                       pattern_->column_starts.data(),
                                                       pattern_->rows.data(), values.data());
    for (Index i = 0; i < n; ++i) h_.coeffRef(i, i) += shift;
    return FactorStatus::Ok;
  }
  Solution solve(const Vec& r, Vec& p, double tolerance) override {
    requested_->tolerances.push_back(tolerance);
    if (broken_-- > 0) return {SolveStatus::Indefinite, 1, 1};
    Vec rest = r, d = r;
    p = Vec::Zero(r.size());
    for (int k = 0; k < most_; ++k) {
      const double before = rest.squaredNorm();
      if (std::sqrt(before) <= tolerance * r.norm())
        return {SolveStatus::Solved, std::sqrt(before) / r.norm(), k};
      const Vec image = h_.selfadjointView<Eigen::Lower>() * d;
      const double length = before / d.dot(image);
      if (!(length > 0)) return {SolveStatus::Indefinite, 1, k};
      p += length * d;
      rest -= length * image;
      d = rest + (rest.squaredNorm() / before) * d;
    }
    return {SolveStatus::NotConverged, rest.norm() / r.norm(), most_};
  }
  std::string description() const override { return "cg"; }

 private:
  std::shared_ptr<Requested> requested_;
  const SparsePattern* pattern_ = nullptr;
  Eigen::SparseMatrix<double> h_;
  int most_, broken_;
};

struct Given {
  std::shared_ptr<Requested> requested = std::make_shared<Requested>();
  Problem problem = make_problem();
  Vec y0 = start();

  static constexpr Index kGaps = 200;
  static Problem make_problem() {
    test::Random random(3);
    ProblemBuilder builder(kGaps + 1);
    builder.add(std::make_shared<const BarrierChain>(kGaps, random), 1.0);
    builder.add(test::Rows().row({{0, 1}}, 0));
    return builder.build();
  }
  Vec start() const { return problem.reduce(Vec::LinSpaced(kGaps + 1, 0, kGaps)); }
  NewtonOptions options(int most, int broken = 0) const {
    NewtonOptions o;
    o.linear_solver = [a = requested, most, broken] {
      return std::make_unique<Cg>(a, most, broken);
    };
    return o;
  }
};

TEST(InexactNewton, ReachesTheMinimumOfTheDirectSolver) {
  const Given s;
  const SolveResult direct = NewtonMinimizer().minimize(s.problem, s.y0, {});
  const SolveResult own = NewtonMinimizer(s.options(100000)).minimize(s.problem, s.y0, {});
  ASSERT_EQ(direct.status, Status::Converged) << direct.message;
  EXPECT_EQ(own.status, Status::Converged) << own.message;
  EXPECT_NEAR(own.energy, direct.energy, 1e-9 * std::abs(direct.energy));
  for (const IterationRecord& r : direct.iterations) {
    EXPECT_EQ(r.residual, 0);
    EXPECT_EQ(r.solver_iterations, 0);
  }
  ASSERT_FALSE(own.iterations.empty());
  for (const IterationRecord& r : own.iterations) {
    EXPECT_GT(r.solver_iterations, 0);
    EXPECT_LE(r.residual, 0.1);
  }
}

TEST(InexactNewton, TightensTheToleranceAsItConverges) {
  const Given s;
  NewtonMinimizer(s.options(100000)).minimize(s.problem, s.y0, {});
  const std::vector<double>& requested = s.requested->tolerances;
  ASSERT_GE(requested.size(), 3u);
  EXPECT_EQ(requested.front(), 0.1) << "nothing is known of the first step";
  for (const double eta : requested) {
    EXPECT_GT(eta, 0);
    EXPECT_LE(eta, 0.1);
  }
  EXPECT_LT(*std::min_element(requested.begin(), requested.end()), 1e-2);
}

TEST(InexactNewton, TakesUnconvergedDescentDirections) {
  const Given s;
  NewtonOptions options = s.options(20);
  options.stopping.max_iterations = 3000;
  options.stopping.relative_decrease = 1e-14;
  const SolveResult own = NewtonMinimizer(options).minimize(s.problem, s.y0, {});
  const SolveResult direct = NewtonMinimizer().minimize(s.problem, s.y0, {});
  EXPECT_NEAR(own.energy, direct.energy, 1e-6 * std::abs(direct.energy));
  EXPECT_GT(own.iterations.front().residual, 0.1) << "20 iterations are not enough";
}

TEST(InexactNewton, ShiftsWhereTheSolverFindsTheMatrixIndefinite) {
  const Given s;
  const SolveResult own = NewtonMinimizer(s.options(100000, 3)).minimize(s.problem, s.y0, {});
  EXPECT_EQ(own.status, Status::Converged) << own.message;
  const IterationRecord& first = own.iterations.front();
  EXPECT_EQ(first.failed_factorizations, 3);
  EXPECT_EQ(first.factorizations, 4);
  EXPECT_GT(first.shift, 0);
  ASSERT_GE(s.requested->shifts.size(), 4u);
  EXPECT_EQ(s.requested->shifts[0], 0);
  EXPECT_NEAR(s.requested->shifts[3], 100 * s.requested->shifts[1], 1e-9 * s.requested->shifts[3]);
}

TEST(InexactNewton, FailsWithAMessageIfNoShiftHelps) {
  const Given s;
  const SolveResult own = NewtonMinimizer(s.options(100000, 1000)).minimize(s.problem, s.y0, {});
  EXPECT_EQ(own.status, Status::Failed);
  EXPECT_EQ(own.message, "no finite direction: no shift makes the Hessian positive definite");
  EXPECT_TRUE(own.y == s.y0);
}

TEST(InexactNewton, MetricsAreSolvedToTheirOwnTolerance) {
  const Given s;
  const auto make = s.options(100000).linear_solver;
  LbfgsMinimizer({.linear_solver = make}).minimize(s.problem, s.y0, {});
  GradientFlowMinimizer({.stopping = brief_rules(3, kAnyDecrease), .linear_solver = make})
      .minimize(s.problem, s.y0, {});
  ASSERT_FALSE(s.requested->tolerances.empty());
  for (const double tolerance : s.requested->tolerances)
    EXPECT_EQ(tolerance, kPreconditionerTolerance);
}

class Short final : public LinearSolver {
 public:
  void analyze(const SparsePattern&) override {}
  FactorStatus factorize(const Vec&, double) override { return FactorStatus::Ok; }
  Solution solve(const Vec&, Vec& p, double) override { return p = Vec::Zero(2), Solution{}; }
  std::string description() const override { return "short"; }
};

TEST(InexactNewton, RefusesADirectionOfAnotherSize) {
  const Given s;
  const NewtonMinimizer newton({.linear_solver = [] { return std::make_unique<Short>(); }});
  EXPECT_THROW(newton.minimize(s.problem, s.y0, {}), InvalidArgument);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
