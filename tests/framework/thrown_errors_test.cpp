// Exceptions of the caller's code pass through every minimizer, also out of parallel loops, and do
// not affect a concurrent solve.
#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <memory>
#include <thread>

#include "framework/scalar_terms.h"
#include "majorant/framework/ceres_minimizer.h"
#include "majorant/framework/first_order.h"
#include "majorant/framework/newton.h"
#include "majorant/framework/parallel.h"

namespace majorant {
namespace {

using test::Chain;
using test::Scalar;

struct Mine {  // not a std::exception
  int number;
};

constexpr Index kCount = 4000;  // enough batches for several threads

// Returns a term that throws in this call (of values or derivatives); never if it is negative.
Scalar throwing(std::shared_ptr<std::atomic<long>> calls, long limit) {
  const auto count = [calls, limit] {
    if (++*calls == limit) throw Mine{42};
  };
  const Scalar well = test::double_well();
  return {[=](double t) { return count(), well.f(t); },
          [=](double t) { return count(), well.f1(t); }, well.f2};
}

Problem chain(const Scalar& phi, std::shared_ptr<const FeasibilityChecker> checker = nullptr) {
  ProblemBuilder builder(kCount);
  builder.add(std::make_shared<const Chain>(kCount, phi), 1.0);
  if (checker) builder.add(std::move(checker));
  return builder.build();
}
Problem throwing_chain(long limit) {
  return chain(throwing(std::make_shared<std::atomic<long>>(0), limit));
}
Vec start() { return Vec::LinSpaced(kCount, 0.3, 2.0); }

std::vector<std::pair<const char*, std::shared_ptr<const Minimizer>>> minimizers() {
  return {{"newton", std::make_shared<NewtonMinimizer>()},
          {"lbfgs", std::make_shared<LbfgsMinimizer>()},
          {"flow", std::make_shared<GradientFlowMinimizer>()},
          {"ceres", std::make_shared<CeresMinimizer>()}};
}

void expect_mine(const std::function<void()>& call, const char* who) {
  try {
    call();
    ADD_FAILURE() << who << ": nothing was thrown";
  } catch (const Mine& mine) {
    EXPECT_EQ(mine.number, 42) << who;
  }
}

TEST(ThrownErrors, ErrorsOfTermsLeaveEveryMinimizer) {
  for (const int threads : {1, 4}) {
    const ThreadCount count(threads);
    for (const auto& [name, minimizer] : minimizers())
      for (const long limit : {1L, 1000L, 2L * kCount + 5, 7L * kCount})
        expect_mine([&, m = minimizer] { m->minimize(throwing_chain(limit), start(), {}); }, name);
  }
}

TEST(ThrownErrors, ErrorsOfObserversLeaveEveryMinimizer) {
  StepObserver throws([](const TraceEntry&, const Vec&) -> Directive { throw Mine{42}; });
  for (const auto& [name, minimizer] : minimizers())
    expect_mine([&, m = minimizer] { m->minimize(throwing_chain(-1), start(), &throws); }, name);
}

class ThrowingChecker final : public FeasibilityChecker {
 public:
  explicit ThrowingChecker(int harmless) : harmless_(harmless) {}
  std::string_view name() const override { return "throwing"; }
  Verdict check(VecIn) const override {
    if (harmless_-- <= 0) throw Mine{42};
    return {};
  }
  StepBound max_step(VecIn, VecIn, double s) const override {
    if (harmless_ < -1000) throw Mine{42};
    return {s, {}};
  }

 private:
  mutable std::atomic<int> harmless_;
};

TEST(ThrownErrors, ErrorsOfCheckersLeaveEveryMinimizer) {
  for (const auto& [name, minimizer] : minimizers())
    for (const int harmless : {0, 2})
      expect_mine(
          [&, m = minimizer, n = harmless] {
            m->minimize(chain(test::double_well(), std::make_shared<ThrowingChecker>(n)), start(),
                        {});
          },
          name);
}

class ThrowingSolver final : public LinearSolver {
 public:
  explicit ThrowingSolver(int where) : where_(where) {}
  void analyze(const SparsePattern& pattern) override {
    if (where_ == 0) throw Mine{42};
    solver_->analyze(pattern);
  }
  FactorStatus factorize(const Vec& values, double shift) override {
    if (where_ == 1) throw Mine{42};
    return solver_->factorize(values, shift);
  }
  Solution solve(const Vec& r, Vec& p, double tolerance) override {
    if (where_ == 2) throw Mine{42};
    return solver_->solve(r, p, tolerance);
  }
  std::string description() const override { return "throwing"; }

 private:
  int where_;
  std::unique_ptr<LinearSolver> solver_ = make_direct_solver();
};

TEST(ThrownErrors, ErrorsOfSolversLeaveEveryMinimizer) {
  for (const int where : {0, 1, 2}) {
    const auto make = [where] { return std::make_unique<ThrowingSolver>(where); };
    const Problem problem = chain(test::double_well());
    expect_mine([&] { NewtonMinimizer({.linear_solver = make}).minimize(problem, start(), {}); },
                "newton");
    expect_mine([&] { LbfgsMinimizer({.linear_solver = make}).minimize(problem, start(), {}); },
                "lbfgs");
    expect_mine(
        [&] { GradientFlowMinimizer({.linear_solver = make}).minimize(problem, start(), {}); },
        "flow");
  }
}

// One of two concurrent solves throws; the other one is not affected.
TEST(ThrownErrors, DoNotAffectAnotherSolve) {
  const ThreadCount two(2);
  const Problem good = chain(test::double_well());
  for (const auto& [name, minimizer] : minimizers()) {
    const SolveResult alone = minimizer->minimize(good, start(), {});
    SolveResult beside;
    bool thrown = false;
    std::thread other([&, m = minimizer] {
      const ThreadCount threads(2);
      for (int k = 0; k < 3; ++k) try {
          m->minimize(throwing_chain((3 + k) * kCount + 17), start(), {});
        } catch (const Mine&) {
          thrown = true;
        }
    });
    std::thread own([&, m = minimizer] {
      const ThreadCount threads(2);
      beside = m->minimize(good, start(), {});
    });
    other.join();
    own.join();
    EXPECT_TRUE(thrown) << name;
    EXPECT_EQ(beside.status, alone.status) << name;
    EXPECT_EQ(beside.energy, alone.energy) << name;
    EXPECT_EQ(beside.iterations.size(), alone.iterations.size()) << name;
    ASSERT_EQ(beside.y.size(), alone.y.size());
    EXPECT_TRUE((beside.y.array() == alone.y.array()).all()) << name;
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
