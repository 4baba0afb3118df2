// Newton's method: convergence, every stopping rule; the cases of all minimizers.
#include "majorant/framework/newton.h"

#include <gtest/gtest.h>

#include <cmath>

#include "framework/counting_solver.h"
#include "framework/minimizer_cases.h"
#include "framework/scalar_terms.h"
#include "majorant/framework/problem_parts.h"

namespace majorant {

template <Curvature curvature>
struct NewtonTraits {
  static constexpr Status kAmongGaps = Status::Converged;
  static std::unique_ptr<Minimizer> make(int max_iterations) {
    NewtonOptions o;
    o.curvature = curvature;
    if (curvature == Curvature::Exact) o.linear_solver = make_eigen_ldlt_solver;
    o.stopping.max_iterations = max_iterations;
    return std::make_unique<NewtonMinimizer>(o);
  }
};

namespace test {
using NewtonKinds =
    testing::Types<NewtonTraits<Curvature::Projected>, NewtonTraits<Curvature::Exact>>;
INSTANTIATE_TYPED_TEST_SUITE_P(Newton, MinimizerCases, NewtonKinds);
}  // namespace test

namespace {

using test::Chain;
using test::double_well;
using test::kInfinity;
using test::parabola;
using test::QuadraticTerm;
using test::Random;
using test::Rows;
using test::Scalar;

NewtonOptions options(Curvature curvature = Curvature::Exact) {
  NewtonOptions o;
  o.curvature = curvature;
  return o;
}

TEST(Newton, SolvesAQuadraticInOneStep) {
  Random random(1);
  const auto term =
      std::make_shared<const QuadraticTerm>(test::band_elements(30, 3, 2), random, true);
  Rows rows;
  rows.row({{0, 1}}, 1).row({{5, 1}, {9, -2}}, 0.5);
  const Problem problem = ProblemBuilder(64).add(term, 1.0).add(rows).build();
  const SolveResult r = NewtonMinimizer(options()).minimize(problem, random.vector(62), {});
  ASSERT_EQ(r.status, Status::Converged) << r.message;
  ASSERT_GE(r.iterations.size(), 1u);
  EXPECT_NEAR(r.iterations[0].step, 1.0, 1e-6);
  EXPECT_EQ(r.iterations[0].shift, 0.0);
  EXPECT_NEAR(r.iterations[0].energy, r.energy, 1e-12 * std::abs(r.energy));

  Eigen::MatrixXd h = Eigen::MatrixXd::Zero(64, 64);
  Vec g = Vec::Zero(64);
  term->add_dense(Vec(problem.expand(Vec::Zero(62))), problem.state(problem.terms().front()), h, g);
  const Eigen::MatrixXd z = test::dense_z(ProblemParts::elimination(problem));
  const Vec expected = (z.transpose() * h * z).ldlt().solve(-z.transpose() * g);
  EXPECT_LE((r.y - expected).norm(), 1e-8 * expected.norm());
}

TEST(Newton, EnergiesDecreaseAndRecordsAgree) {
  const Problem problem =
      ProblemBuilder(5).add(std::make_shared<const Chain>(5, double_well()), 1).build();
  Vec y0(5);
  y0 << 0.3, -0.7, 3, 0.6, -1.5;
  double previous = Evaluator(problem).value(y0);
  int calls = 0;
  StepObserver observer([&](const TraceEntry& row, const Vec& y) {
    const IterationRecord& r = row.record;
    EXPECT_EQ(r.iteration, ++calls);
    EXPECT_LT(r.energy, previous);
    EXPECT_EQ(r.energy, Evaluator(problem).value(y));
    EXPECT_NEAR(r.relative_decrease, (previous - r.energy) / previous, 1e-15);
    EXPECT_GT(r.newton_decrement, 0);
    EXPECT_GE(r.trials, 1);
    previous = r.energy;
    return Directive::Continue;
  });
  const SolveResult r = NewtonMinimizer(options()).minimize(problem, y0, &observer);
  EXPECT_EQ(r.status, Status::Converged) << r.message;
  EXPECT_EQ(static_cast<int>(r.iterations.size()), calls);
  for (const double t : r.y) EXPECT_NEAR(std::abs(t), 1, 1e-3);
  EXPECT_NEAR(r.energy, 5, 1e-6);
}

// The curvature is negative at the start: the shift is recorded, and the iteration moves away.
TEST(Newton, ShiftsIndefiniteHessians) {
  const Problem problem =
      ProblemBuilder(2).add(std::make_shared<const Chain>(2, double_well()), 1).build();
  const SolveResult r = NewtonMinimizer(options()).minimize(problem, Vector2(0.5, 2.0), {});
  ASSERT_EQ(r.status, Status::Converged) << r.message;
  EXPECT_GT(r.iterations.at(0).shift, 0);
  EXPECT_NEAR(r.y[0], 1, 1e-3);
}

// Records count every factorization: shifted ones, failed exact Hessians, those of good steps. The
// last step, which detects the minimum, is not in the list.
TEST(Newton, RecordsCountFactorizations) {
  for (const Curvature curvature : {Curvature::Projected, Curvature::Exact}) {
    const test::ChainProblem chain(40);
    const auto counts = std::make_shared<test::SolverCounts>();
    NewtonOptions o = options(curvature);
    o.blend.misled_steps = 0;
    o.linear_solver = test::counting(counts);
    NewtonStepper stepper(chain.problem, o);
    Vec y = chain.start;
    double energy = stepper.evaluator().value(y);
    test::SolverCounts sum;
    StepResult step;
    do {
      step = stepper.step(y, energy);
      sum.factorizations += step.record.factorizations;
      sum.failed += step.record.failed_factorizations;
    } while (step.outcome == StepResult::Outcome::Moved);
    EXPECT_EQ(sum.factorizations, counts->factorizations);
    EXPECT_EQ(sum.failed, counts->failed);
    EXPECT_EQ(sum.failed > 0, curvature == Curvature::Exact);
  }
}

// t falls with every step. It rises with every failed factorization and every step that the model
// predicts badly, through 0.1 and 0.5 to 1, and then stays for `hold` steps.
TEST(Newton, BlendsFollowTheFactorizations) {
  int failed = 0, exact = 0;
  for (const unsigned seed : {1u, 2u, 3u, 4u}) {
    const test::ChainProblem chain(60, seed);
    NewtonOptions o = options(Curvature::Projected);
    o.blend.below = kInfinity;
    o.blend.short_step = 0;
    NewtonStepper stepper(chain.problem, o);
    Vec y = chain.start;
    double energy = stepper.evaluator().value(y), t = 1;
    int hold = 0;
    const auto raise = [&] {
      t = t < 0.1 ? 0.1 : t < 0.5 ? 0.5 : 1;
      hold = o.blend.hold;
    };
    for (StepResult step = stepper.step(y, energy); step.outcome == StepResult::Outcome::Moved;
         step = stepper.step(y, energy)) {
      const IterationRecord& r = step.record;
      for (int k = 0; k < r.failed_factorizations; ++k) raise();
      EXPECT_EQ(r.projection_weight, t) << seed;
      EXPECT_EQ(r.curvature == Curvature::Exact, t == 0);
      failed += r.failed_factorizations;
      exact += t == 0;
      const double promised = relative_to(step.energy_before, r.newton_decrement);
      if (t < 1 && promised > LineSearch::kResolution && r.relative_decrease < 0.1 * promised)
        raise();
      else if (hold > 0)
        --hold;
      else
        t = t * o.blend.fall < o.blend.least ? 0 : t * o.blend.fall;
    }
  }
  EXPECT_GT(failed, 3);
  EXPECT_GT(exact, 3);
}

TEST(Newton, NoBlendFarFromAMinimumNorAfterShortSteps) {
  const test::ChainProblem chain(60);
  const double start = Evaluator(chain.problem).value(chain.start);
  NewtonOptions o = options(Curvature::Projected);
  o.blend.misled_steps = 0;
  o.stopping.scale = EnergyScale::Value;
  for (const double below : {0.0, 3.0}) {
    o.blend.below = below;
    const SolveResult r = NewtonMinimizer(o).minimize(chain.problem, chain.start, {});
    ASSERT_EQ(r.status, Status::Converged);
    int blends = 0;
    for (std::size_t k = 1; k < r.iterations.size(); ++k) {
      const double before = k == 1 ? start : r.iterations[k - 2].energy;
      if (relative_to(before, r.iterations[k - 1].newton_decrement) > below)
        EXPECT_EQ(r.iterations[k].projection_weight, 1) << k;
      else
        blends += r.iterations[k].projection_weight < 1;
    }
    EXPECT_EQ(blends > 0, below > 0);
  }
  o.blend.below = kInfinity;
  o.blend.short_step = kInfinity;  // every step is short
  for (const IterationRecord& r :
       NewtonMinimizer(o).minimize(chain.problem, chain.start, {}).iterations)
    EXPECT_EQ(r.projection_weight, 1);
}

// The Hessian is negative definite: a shift of one mean diagonal entry is not enough.
TEST(Newton, ShiftsNegativeDefiniteHessians) {
  const Problem problem =
      ProblemBuilder(1).add(std::make_shared<const Chain>(1, double_well()), 1).build();
  const SolveResult r = NewtonMinimizer(options()).minimize(problem, Vec::Constant(1, 0.1), {});
  EXPECT_EQ(r.status, Status::Converged) << r.message;
}

TEST(Newton, StopsAtTheIterationLimit) {
  NewtonOptions o = options();
  o.stopping.max_iterations = 2;
  const Problem problem =
      ProblemBuilder(1).add(std::make_shared<const Chain>(1, double_well()), 1).build();
  const SolveResult r = NewtonMinimizer(o).minimize(problem, Vec::Constant(1, 30), {});
  EXPECT_EQ(r.status, Status::MaxIterations);
  EXPECT_EQ(r.iterations.size(), 2u);
}

TEST(Newton, ObserversStopIt) {
  const Problem problem =
      ProblemBuilder(1).add(std::make_shared<const Chain>(1, double_well()), 1).build();
  for (const auto& [directive, status] : {std::pair(Directive::TimeLimit, Status::TimeLimit),
                                          {Directive::Interrupt, Status::Interrupted}}) {
    StepObserver observer([d = directive](const TraceEntry& row, const Vec&) {
      return row.record.iteration == 2 ? d : Directive::Continue;
    });
    const SolveResult r =
        NewtonMinimizer(options()).minimize(problem, Vec::Constant(1, 30), &observer);
    EXPECT_EQ(r.status, status);
    EXPECT_EQ(r.iterations.size(), 2u);
    EXPECT_EQ(r.energy, Evaluator(problem).value(r.y));
  }
}

// The weight of a term doubles after each of the first steps; reported energies have weight 1.
class Growing final : public Descent {
 public:
  Growing(Problem problem, NewtonStepper& stepper)
      : problem_(std::move(problem)), stepper_(stepper) {
    result.y = Vec::Constant(1, 30);
    result.energy = energy = stepper.evaluator().value(result.y);
  }
  Answer after_step(const StepResult& step) override {
    result.energy = energy / weight_;
    if (++steps == last) return {Directive::TimeLimit};
    if (step.outcome != StepResult::Outcome::Moved || steps > 3) return {};
    TermState state;
    state.weight = weight_ *= 2;
    problem_ = problem_.with({{TermId(0), state}});
    stepper_.reset(problem_);
    energy = stepper_.evaluator().value(result.y);
    return {Directive::Continue, StoppingTest::Since::ProblemChanged};
  }
  int steps = 0, last = -1;

 private:
  Problem problem_;
  NewtonStepper& stepper_;
  double weight_ = 1;
};

TEST(Descent, TheProblemMayChangeBetweenSteps) {
  const Problem problem =
      ProblemBuilder(1).add(std::make_shared<const Chain>(1, double_well()), 1).build();
  const SolveResult fixed = NewtonMinimizer(options()).minimize(problem, Vec::Constant(1, 30), {});
  for (const int last : {-1, 2}) {
    NewtonStepper stepper(problem, options());
    Growing descent(problem, stepper);
    descent.last = last;
    stepper.descend(descent, options().stopping);
    const SolveResult& r = descent.result;
    EXPECT_NEAR(r.energy, Evaluator(problem).value(r.y), 1e-12 * r.energy);
    EXPECT_EQ(descent.energy, stepper.evaluator().value(r.y));
    if (last < 0) {
      EXPECT_EQ(r.status, Status::Converged);
      EXPECT_EQ(r.iterations.size(),
                fixed.iterations.size());  // weights do not matter for the steps
      EXPECT_NEAR(r.y[0], fixed.y[0], 1e-9);
      EXPECT_NEAR(descent.energy, 8 * r.energy, 1e-12 * descent.energy);
    } else {
      EXPECT_EQ(r.status, Status::TimeLimit);
      EXPECT_EQ(r.iterations.size(), 2u);
    }
  }
}

TEST(Newton, WithoutUnknownsThereIsNothingToDo) {
  Rows rows;
  rows.row({{0, 1}}, 0.5);
  const Problem problem =
      ProblemBuilder(1).add(std::make_shared<const Chain>(1, parabola(0, 1)), 1).add(rows).build();
  ASSERT_EQ(problem.size(), 0);
  const SolveResult r = NewtonMinimizer(options()).minimize(problem, Vec(), {});
  EXPECT_EQ(r.status, Status::Converged);
  EXPECT_TRUE(r.iterations.empty());
  EXPECT_EQ(r.energy, 1.25);
}

TEST(Newton, StartingAtTheMinimumTakesNoStep) {
  const Problem problem =
      ProblemBuilder(1).add(std::make_shared<const Chain>(1, parabola(2, 1)), 1).build();
  const SolveResult r = NewtonMinimizer(options()).minimize(problem, Vec::Constant(1, 2), {});
  EXPECT_EQ(r.status, Status::Converged);
  EXPECT_TRUE(r.iterations.empty());
}

// sum of (a_e . x_e - b_e)^2 over three successive unknowns, b_e from a known solution.
class LeastSquares final : public EnergyTerm {
 public:
  explicit LeastSquares(Random& random) : a_(40, 3), b_(40) {
    const Vec solution = random.vector(42);
    for (Index e = 0; e < 40; ++e) {
      a_.row(e) << random.uniform(), random.uniform(), 3;
      b_[e] = a_.row(e).dot(solution.segment<3>(e));
    }
  }
  std::string_view name() const override { return "least squares"; }
  const ElementDofs& element_dofs() const override { return element_dofs_; }
  bool supports(Curvature) const override { return true; }
  void values(VecIn x, const ElementBatch& batch, const TermState&, Workspace&,
              std::span<double> f) const override {
    for (std::size_t p = 0; p < batch.elements.size(); ++p)
      f[p] = std::pow(residual(x, batch.elements[p]), 2);
  }
  void local(VecIn x, const ElementBatch& batch, BlendedCurvature, const TermState& state,
             Workspace& workspace, LocalSystem& out) const override {
    values(x, batch, state, workspace, {out.value, batch.elements.size()});
    for (std::size_t p = 0; p < batch.elements.size(); ++p) {
      const Index e = batch.elements[p];
      for (int i = 0, k = 0; i < 3; ++i) {
        out.gradient[static_cast<std::size_t>(i) * LocalSystem::stride + p] =
            2 * residual(x, e) * a_(e, i);
        for (int j = 0; out.hessian && j <= i; ++j, ++k)
          out.hessian[static_cast<std::size_t>(k) * LocalSystem::stride + p] =
              2 * a_(e, i) * a_(e, j);
      }
    }
  }

 private:
  double residual(VecIn x, Index e) const { return a_.row(e).dot(x.segment<3>(e)) - b_[e]; }
  Points3 a_;
  Vec b_;
  ElementDofs element_dofs_ = test::band_elements(40, 3, 1);
};

// The minimum has energy 0, where a rule relative to the energy never holds.
TEST(Newton, MinimaOfEnergyZeroConverge) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    Random random(seed);
    Rows rows;
    rows.row({{0, 1}}, 0).row({{1, 1}}, 0);  // 40 free unknowns for 40 squares
    const Problem problem =
        ProblemBuilder(42).add(std::make_shared<const LeastSquares>(random), 1).add(rows).build();
    const Vec y0 = random.vector(40);
    const double start = Evaluator(problem).value(y0);
    const SolveResult r = NewtonMinimizer(options()).minimize(problem, y0, {});
    EXPECT_LT(r.energy, 1e-18 * start);
    EXPECT_EQ(r.status, Status::Converged) << r.message << ", E = " << r.energy;
  }
}

// Energy, gradient and point are exactly 0, so that every ratio of the stopping rules is 0 / 0.
TEST(Newton, AStartAtAMinimumOfEnergyZeroConvergesAtOnce) {
  const Scalar square{[](double t) { return t * t; }, [](double t) { return 2 * t; },
                      [](double) { return 2.0; }};
  const Problem problem =
      ProblemBuilder(1).add(std::make_shared<const Chain>(1, square), 1).build();
  const SolveResult r = NewtonMinimizer(options()).minimize(problem, Vec::Zero(1), {});
  EXPECT_EQ(r.status, Status::Converged) << r.message;
  EXPECT_TRUE(r.iterations.empty());
}

TEST(Newton, NumericalBreakdownIsAStatus) {
  const Scalar broken{[](double t) { return t; }, [](double) { return 1.0; },
                      [](double) { return std::nan(""); }};
  const Problem problem =
      ProblemBuilder(1).add(std::make_shared<const Chain>(1, broken), 1).build();
  const SolveResult r = NewtonMinimizer(options()).minimize(problem, Vec::Constant(1, 2), {});
  EXPECT_EQ(r.status, Status::Failed);
  EXPECT_EQ(r.y[0], 2);
}

TEST(Newton, StepperGoesOnWithAnotherState) {
  Random random(2);
  const auto a = std::make_shared<const Chain>(3, parabola(0, 1));
  const auto b = std::make_shared<const Chain>(3, parabola(1, 1));
  const Problem problem = ProblemBuilder(3).add(a, 1).add(b, 0).build();
  NewtonStepper stepper(problem, options());
  SolveResult r = stepper.minimize(Vector3(3, 4, 5), {});
  EXPECT_EQ(r.status, Status::Converged);
  EXPECT_LE(r.y.norm(), 1e-6);
  TermState first, second;
  first.weight = 0;
  stepper.reset(problem.with({{problem.terms()[0], first}, {problem.terms()[1], second}}));
  r = stepper.minimize(r.y, {});
  EXPECT_LE((r.y - Vec::Ones(3)).norm(), 1e-6);
}

// Nearness to the minimum of one state does not carry over to another state.
TEST(Newton, AnotherStateForgetsTheLastDecrement) {
  const auto a = std::make_shared<const Chain>(3, parabola(0, 1));
  const auto b = std::make_shared<const Chain>(3, double_well());
  const Problem problem = ProblemBuilder(3).add(a, 1).add(b, 0).build();
  NewtonStepper stepper(problem, options(Curvature::Projected));
  const SolveResult r = stepper.minimize(Vector3(1e-3, 1e-3, 1e-3), {});
  ASSERT_EQ(r.status, Status::Converged);
  TermState off, on;
  off.weight = 0;
  stepper.reset(problem.with({{problem.terms()[0], off}, {problem.terms()[1], on}}));
  Vec y = Vector3(2, 3, 4);
  double energy = stepper.evaluator().value(y);
  EXPECT_EQ(stepper.step(y, energy).record.curvature, Curvature::Projected);
}

TEST(Newton, StatusNames) {
  EXPECT_EQ(status_name(Status::Converged), "converged");
  EXPECT_EQ(status_name(Status::MaxIterations), "max_iterations");
  EXPECT_EQ(status_name(Status::TimeLimit), "time_limit");
  EXPECT_EQ(status_name(Status::Interrupted), "interrupted");
  EXPECT_EQ(status_name(Status::Stalled), "stalled");
  EXPECT_EQ(status_name(Status::Infeasible), "infeasible");
  EXPECT_EQ(status_name(Status::Failed), "failed");
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
