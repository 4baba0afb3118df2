// Gradient flow in a metric: the cases of all minimizers, rates, metrics of other problems.
#include "framework/counting_solver.h"
#include "framework/minimizer_cases.h"
#include "majorant/framework/error.h"
#include "majorant/framework/first_order.h"

namespace majorant {
namespace {

using test::ChainProblem;
using test::QuadraticTerm;
using test::Random;
using test::Rows;

// The chain's Dirichlet energy, the sum of d^2 / 2 over the gaps, with the problem's constraints.
class Springs final : public EnergyTerm {
 public:
  explicit Springs(Index gaps) : element_dofs_(test::band_elements(gaps, 2, 1)) {}
  std::string_view name() const override { return "springs"; }
  const ElementDofs& element_dofs() const override { return element_dofs_; }
  bool supports(Curvature) const override { return true; }
  void values(VecIn x, const ElementBatch& batch, const TermState&, Workspace&,
              std::span<double> f) const override {
    for (std::size_t p = 0; p < batch.elements.size(); ++p)
      f[p] = std::pow(x[batch.elements[p] + 1] - x[batch.elements[p]], 2) / 2;
  }
  void local(VecIn x, const ElementBatch& batch, BlendedCurvature, const TermState& state,
             Workspace& workspace, LocalSystem& out) const override {
    constexpr std::size_t stride = LocalSystem::stride;
    values(x, batch, state, workspace, {out.value, batch.elements.size()});
    for (std::size_t p = 0; p < batch.elements.size(); ++p) {
      const double d = x[batch.elements[p] + 1] - x[batch.elements[p]];
      out.gradient[p] = -d;
      out.gradient[stride + p] = d;
      if (!out.hessian) continue;
      out.hessian[p] = out.hessian[2 * stride + p] = 1;
      out.hessian[stride + p] = -1;
    }
  }

 private:
  ElementDofs element_dofs_;
};

// Returns the Dirichlet problem for the unknowns of `problem`, if that is a chain's.
std::optional<Problem> dirichlet(const Problem& problem) {
  const Index n = problem.full_size() - 1;
  Rows rows;
  if (problem.size() == n) rows.row({{0, 1}, {n, 1}}, 1);
  return ProblemBuilder(n + 1).add(std::make_shared<const Springs>(n), 1).add(rows).build();
}

// The flow with a metric for each problem: chains use Dirichlet's, others their own.
class FlowForTests final : public Minimizer {
 public:
  explicit FlowForTests(int max_iterations) { options_.stopping.max_iterations = max_iterations; }
  SolveResult minimize(const Problem& problem, Vec y0, RunObserver* observer) const override {
    GradientFlowOptions o = options_;
    if (problem.terms().size() == 1 &&
        problem.term(problem.terms().front()).name() == "barrier chain")
      o.metric = dirichlet(problem);
    return GradientFlowMinimizer(o).minimize(problem, std::move(y0), observer);
  }

 private:
  GradientFlowOptions options_;
};

}  // namespace

struct FlowTraits {
  static constexpr Status kAmongGaps = Status::Converged;
  static std::unique_ptr<Minimizer> make(int max_iterations) {
    return std::make_unique<FlowForTests>(max_iterations);
  }
};

namespace test {
INSTANTIATE_TYPED_TEST_SUITE_P(GradientFlow, MinimizerCases, FlowTraits);
}  // namespace test

namespace {

TEST(GradientFlow, SolvesAQuadraticInOneStepWithItsOwnMetric) {
  Random random(1);
  const auto term =
      std::make_shared<const QuadraticTerm>(test::band_elements(30, 3, 2), random, true);
  Rows rows;
  rows.row({{0, 1}, {7, 1}}, 1).row({{5, 1}, {9, -1}}, 0.5);
  const Problem problem = ProblemBuilder(64).add(term, 1.0).add(rows).build();
  const SolveResult r = GradientFlowMinimizer().minimize(problem, random.vector(62), {});
  ASSERT_EQ(r.status, Status::Converged) << r.message;
  EXPECT_EQ(r.iterations.size(), 1u);
  EXPECT_NEAR(r.iterations[0].step, 1, 1e-6);
}

TEST(GradientFlow, RecordsCountFactorizations) {
  const ChainProblem chain(20);
  const auto counts = std::make_shared<test::SolverCounts>();
  GradientFlowOptions o;
  o.curvature = Curvature::Exact;  // indefinite at the start, hence shifted
  o.stopping.max_iterations = 3;
  o.linear_solver = test::counting(counts);
  const SolveResult r = GradientFlowMinimizer(o).minimize(chain.problem, chain.start, {});
  ASSERT_EQ(r.iterations.size(), 3u);
  EXPECT_GT(counts->failed, 0);
  EXPECT_EQ(r.iterations[0].factorizations, counts->factorizations);
  EXPECT_EQ(r.iterations[0].failed_factorizations, counts->failed);
  EXPECT_EQ(r.iterations[1].factorizations, 0);
}

// In the Dirichlet metric the chain decouples into its gaps: the number of iterations does not grow
// with their number, as it would in the Euclidean metric.
TEST(GradientFlow, IterationsDoNotGrowWithTheChainInTheDirichletMetric) {
  std::size_t iterations[2];
  for (const Index gaps : {20, 200}) {
    const ChainProblem chain(gaps);
    GradientFlowOptions o;
    o.metric = dirichlet(chain.problem);
    const SolveResult r = GradientFlowMinimizer(o).minimize(chain.problem, chain.start, {});
    EXPECT_EQ(r.status, Status::Converged) << r.message;
    iterations[gaps == 200] = r.iterations.size();
  }
  EXPECT_LT(iterations[1], 2 * iterations[0]);
}

// -g.p is g.M^-1 g with the metric's Hessian M.
TEST(GradientFlow, RecordsTheSobolevNormOfTheGradient) {
  const ChainProblem chain(8);
  GradientFlowOptions o;
  o.metric = dirichlet(chain.problem);
  o.stopping.max_iterations = 1;
  const SolveResult r = GradientFlowMinimizer(o).minimize(chain.problem, chain.start, {});
  Eigen::MatrixXd m(8, 8);
  Vec g;
  Evaluator dirichlet_energy(*o.metric);
  const Vec zero = Vec::Zero(8);
  Vec at_zero, column;
  dirichlet_energy.gradient(zero, at_zero);
  for (Index j = 0; j < 8; ++j) {
    dirichlet_energy.gradient(Vec::Unit(8, j), column);
    m.col(j) = column - at_zero;
  }
  Evaluator(chain.problem).gradient(chain.start, g);
  const double expected = g.dot(m.ldlt().solve(g));
  EXPECT_NEAR(r.iterations.at(0).newton_decrement, expected, 1e-10 * expected);
}

// A metric of wrong scale only changes the step's scale, which is remembered.
TEST(GradientFlow, TheScaleOfTheMetricHardlyMatters) {
  const ChainProblem chain(10);
  for (const double weight : {1e-6, 1.0, 1e6}) {
    GradientFlowOptions o;
    const Problem metric = *dirichlet(chain.problem);
    TermState state;
    state.weight = weight;
    o.metric = metric.with({{metric.terms().front(), state}});
    o.stopping.decrement = 1e-14 / weight;
    const SolveResult r = GradientFlowMinimizer(o).minimize(chain.problem, chain.start, {});
    EXPECT_NEAR(r.energy, chain.best_energy(), 1e-8 * std::abs(chain.best_energy())) << weight;
    EXPECT_NEAR(std::log10(r.iterations.at(5).step), std::log10(weight), 1.5);
    EXPECT_LT(r.iterations.size(), 2000u);
  }
}

TEST(GradientFlow, RefusesForeignMetrics) {
  const ChainProblem chain(5);
  GradientFlowOptions o;
  o.metric = test::chain_of(6, test::parabola(0, 0));
  EXPECT_THROW(GradientFlowMinimizer(o).minimize(chain.problem, chain.start, {}), InvalidArgument);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
