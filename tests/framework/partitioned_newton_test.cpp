// A problem in one process and in parts takes equal steps to the same minimum.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>
#include <utility>

#include "framework/thread_ranks.h"
#include "majorant/framework/ceres_minimizer.h"
#include "majorant/framework/error.h"
#include "majorant/framework/first_order.h"
#include "majorant/framework/newton.h"

namespace majorant {
namespace {

// The term w (d + 1 / d) of the gaps d of nodes on a line, which keeps their order.
class Gaps final : public EnergyTerm {
 public:
  Gaps(std::vector<std::array<Index, 2>> ends, std::vector<double> weight)
      : weight_(std::move(weight)) {
    element_dofs_.block = 1;
    element_dofs_.nodes.resize(static_cast<Index>(ends.size()), 2);
    for (std::size_t e = 0; e < ends.size(); ++e)
      element_dofs_.nodes.row(static_cast<Index>(e)) << ends[e][0], ends[e][1];
  }
  std::string_view name() const override { return "gaps"; }
  const ElementDofs& element_dofs() const override { return element_dofs_; }
  bool supports(Curvature c) const override {
    return c == Curvature::Projected || c == Curvature::Exact;
  }
  double gap(VecIn x, Index e) const {
    return x[element_dofs_.nodes(e, 1)] - x[element_dofs_.nodes(e, 0)];
  }
  void values(VecIn x, const ElementBatch& batch, const TermState&, Workspace&,
              std::span<double> f) const override {
    for (std::size_t p = 0; p < batch.elements.size(); ++p) {
      const double d = gap(x, batch.elements[p]);
      f[p] = d > 0 ? weight_[batch.elements[p]] * (d + 1 / d)
                   : std::numeric_limits<double>::infinity();
    }
  }
  void local(VecIn x, const ElementBatch& batch, BlendedCurvature, const TermState& state,
             Workspace& workspace, LocalSystem& out) const override {
    values(x, batch, state, workspace, {out.value, batch.elements.size()});
    constexpr std::size_t n = LocalSystem::stride;
    for (std::size_t p = 0; p < batch.elements.size(); ++p) {
      const double d = gap(x, batch.elements[p]), w = weight_[batch.elements[p]];
      const double slope = w * (1 - 1 / (d * d)), bend = w * 2 / (d * d * d);
      out.gradient[p] = -slope;
      out.gradient[n + p] = slope;
      if (!out.hessian) continue;
      out.hessian[p] = bend;
      out.hessian[n + p] = -bend;
      out.hessian[2 * n + p] = bend;
    }
  }

 private:
  ElementDofs element_dofs_;
  std::vector<double> weight_;
};

class Ordered final : public FeasibilityChecker {
 public:
  explicit Ordered(std::shared_ptr<const Gaps> gaps) : gaps_(std::move(gaps)) {}
  std::string_view name() const override { return "order"; }
  Verdict check(VecIn x) const override {
    Verdict v;
    for (Index e = 0; e < gaps_->element_dofs().element_count(); ++e)
      if (!(gaps_->gap(x, e) > 0)) v.blocking.push_back(e);
    v.feasible = v.blocking.empty();
    return v;
  }
  StepBound max_step(VecIn x, VecIn d, double s) const override {
    StepBound bound{s, {}};
    for (Index e = 0; e < gaps_->element_dofs().element_count(); ++e)
      if (const double fall = -gaps_->gap(d, e); fall > 0 && gaps_->gap(x, e) / fall < bound.step)
        bound = {gaps_->gap(x, e) / fall, {e}};
    return bound;
  }

 private:
  std::shared_ptr<const Gaps> gaps_;
};

// A dense solver of the whole matrix on every rank.
class DenseSolver final : public SharedSolver {
 public:
  void analyze(const SparsePattern& pattern) override {
    whole_ = Partition(pattern.size);
    analyze_shared(pattern, whole_);
  }
  void analyze_shared(const SparsePattern& pattern, const Partition& partition) override {
    pattern_ = &pattern;
    partition_ = &partition;
  }
  FactorStatus factorize(const Vec& values, double shift) override {
    const auto n = static_cast<Index>(partition_->global_size());
    Eigen::MatrixXd h = Eigen::MatrixXd::Zero(n, n);
    for (Index c = 0; c < pattern_->size; ++c)
      for (Index k = pattern_->column_starts[c]; k < pattern_->column_starts[c + 1]; ++k) {
        const auto i = number(pattern_->rows[k]), j = number(c);
        h(i, j) += values[k];
        if (i != j || pattern_->rows[k] != c) h(j, i) += values[k];
      }
    partition_->ranks().sum({h.data(), static_cast<std::size_t>(h.size())});
    factor_.compute(h + shift * Eigen::MatrixXd::Identity(n, n));
    return factor_.info() == Eigen::Success ? FactorStatus::Ok : FactorStatus::NotPositiveDefinite;
  }
  Solution solve(const Vec& r, Vec& p, double) override {
    Vec all = Vec::Zero(static_cast<Index>(partition_->global_size()));
    for (Index i = 0; i < r.size(); ++i) all[number(i)] += r[i];
    partition_->ranks().sum({all.data(), static_cast<std::size_t>(all.size())});
    all = factor_.solve(all).eval();
    p.resize(r.size());
    for (Index i = 0; i < r.size(); ++i) p[i] = all[number(i)];
    return {};
  }
  std::string description() const override { return "dense"; }

 private:
  Index number(Index local) const { return static_cast<Index>(partition_->global(local)); }
  const SparsePattern* pattern_ = nullptr;
  const Partition* partition_ = nullptr;
  Partition whole_;
  Eigen::LLT<Eigen::MatrixXd> factor_;
};

class Held final : public Constraint {
 public:
  Held(Index unknown, double value) : unknown_(unknown), value_(value) {}
  void append_rows(ConstraintRows& rows) const override {
    rows.begin_row("held");
    rows.add(unknown_, 1);
    rows.end_row(value_);
  }

 private:
  Index unknown_;
  double value_;
};

constexpr Index kGaps = 47;
double weight(Index e) { return 1 + 0.5 * std::sin(3.0 * e); }
// Returns a start with uneven gaps.
double start(Index node) { return node + 0.45 * std::sin(7.0 * node); }
double last() { return 1.7 * kGaps; }

// Returns the rank of a gap: ranks in turn, in groups of four; the last of several ranks has none.
int rank_of(Index gap, int count) { return count == 1 ? 0 : (gap / 4) % (count - 1); }

// The part of the line on one rank; the line is held at node 0 and at its end.
struct Part {
  std::vector<Index> node;  // number on the line; repeated where a group begins
  std::shared_ptr<const Partition> partition;
  std::shared_ptr<const Gaps> gaps;

  explicit Part(const std::shared_ptr<const Ranks>& ranks) {
    const int me = ranks->rank(), count = ranks->count();
    struct Copy {
      int rank;
      Index local;
    };
    std::vector<std::vector<Copy>> of_node(kGaps + 1);  // copies on all ranks, each in its order
    std::vector<Index> sizes(static_cast<std::size_t>(count), 0);
    std::vector<std::array<Index, 2>> ends;
    std::vector<double> weights;
    for (Index gap = 0; gap < kGaps; ++gap) {
      const int r = rank_of(gap, count);
      Index& size = sizes[static_cast<std::size_t>(r)];
      const auto add = [&](Index n) {
        of_node[n].push_back({r, size++});
        if (r == me) node.push_back(n);
      };
      if (gap == 0 || (count > 1 && gap % 4 == 0)) add(gap);
      add(gap + 1);
      if (r != me) continue;
      ends.push_back({size - 2, size - 1});
      weights.push_back(weight(gap));
    }
    std::map<int, Partition::Neighbour> neighbours;
    const auto with = [&](int rank) -> Partition::Neighbour& {
      return neighbours.try_emplace(rank, Partition::Neighbour{rank, {}, {}}).first->second;
    };
    for (const auto& copies : of_node)
      for (std::size_t k = 1; k < copies.size(); ++k) {
        if (copies[0].rank == me) with(copies[k].rank).owned.push_back(copies[0].local);
        if (copies[k].rank == me) with(copies[0].rank).copies.push_back(copies[k].local);
      }
    std::vector<Partition::Neighbour> list;
    for (auto& [rank, n] : neighbours) list.push_back(std::move(n));
    partition = std::make_shared<const Partition>(ranks, static_cast<Index>(node.size()), list);
    gaps = std::make_shared<const Gaps>(ends, weights);
  }

  Problem problem(bool hold_all_copies = true) const {
    ProblemBuilder builder = shared_problem_builder(partition);
    builder.add(gaps, 1.0);
    builder.add(std::make_shared<const Ordered>(gaps));
    for (std::size_t i = 0; i < node.size(); ++i) {
      const auto local = static_cast<Index>(i);
      if (node[i] == 0) builder.add(Held(local, 0));
      if (node[i] == kGaps) builder.add(Held(local, last()));
      // The node is on a border between ranks.
      if (node[i] == 8 && (hold_all_copies || partition->owns(local))) builder.add(Held(local, 9));
    }
    return builder.build();
  }

  Vec x0() const {
    Vec x(static_cast<Index>(node.size()));
    for (std::size_t i = 0; i < node.size(); ++i) {
      const Index n = node[i];
      x[static_cast<Index>(i)] = n == 0 ? 0 : n == kGaps ? last() : n == 8 ? 9 : placed(n);
    }
    return x;
  }
  // Returns a position between the held nodes, in order.
  static double placed(Index n) {
    if (n < 8) return 9 * start(n) / 8.5;
    return 9 + (last() - 9) * (start(n) - start(8)) / (start(kGaps) + 1 - start(8));
  }
};

struct Solved {
  SolveResult result;
  Vec line;  // by node
};

Solved solve(const std::shared_ptr<const Ranks>& ranks, NewtonOptions options) {
  const Part part(ranks);
  const Problem problem = part.problem();
  options.linear_solver = [] { return std::make_unique<DenseSolver>(); };
  Solved solved{NewtonStepper(problem, options).minimize(problem.reduce(part.x0()), {}), {}};
  const Vec x = problem.expand(solved.result.y);
  solved.line = Vec::Constant(kGaps + 1, -1e300);
  for (Index i = 0; i < x.size(); ++i) {
    double& place = solved.line[part.node[i]];
    if (place != -1e300) {
      EXPECT_EQ(place, x[i]) << "copies differ at node " << part.node[i];
    }
    place = x[i];
  }
  for (double& place : solved.line) place = ranks->max(place);
  return solved;
}

class PartitionedNewton : public testing::TestWithParam<int> {};

TEST_P(PartitionedNewton, TakesTheSameStepsAsOneProcess) {
  for (const double kept : {0.0, 1.0}) {
    NewtonOptions options;
    options.lagged.below = kept;
    const Solved whole = solve(one_process(), options);
    ASSERT_EQ(whole.result.status, Status::Converged) << whole.result.message;
    ASSERT_GT(whole.result.iterations.size(), 3u);
    test::run_ranks(GetParam(), [&](const auto& ranks) {
      const Solved parts = solve(ranks, options);
      EXPECT_EQ(parts.result.status, Status::Converged) << parts.result.message;
      ASSERT_EQ(parts.result.iterations.size(), whole.result.iterations.size());
      for (std::size_t k = 0; k < whole.result.iterations.size(); ++k) {
        const IterationRecord &a = parts.result.iterations[k], &b = whole.result.iterations[k];
        EXPECT_NEAR(a.energy, b.energy, 1e-12 * b.energy);
        EXPECT_NEAR(a.step_bound, b.step_bound, 1e-6 * b.step_bound);
        EXPECT_NEAR(a.gradient_norm, b.gradient_norm, 1e-6 * b.gradient_norm + 1e-9);
      }
      EXPECT_LT((parts.line - whole.line).norm(), 1e-9);
    });
  }
}

TEST_P(PartitionedNewton, ResultsAreTheSameBitsEveryTime) {
  test::run_ranks(GetParam(), [](const auto& ranks) {
    const Solved first = solve(ranks, {}), second = solve(ranks, {});
    EXPECT_EQ(first.line, second.line);
    EXPECT_EQ(first.result.energy, second.result.energy);
  });
}

TEST_P(PartitionedNewton, TheObserverOfRankZeroStopsAll) {
  test::run_ranks(GetParam(), [](const auto& ranks) {
    const Part part(ranks);
    const Problem problem = part.problem();
    NewtonOptions options;
    options.linear_solver = [] { return std::make_unique<DenseSolver>(); };
    StepObserver observer([](const TraceEntry& row, const Vec&) {
      return row.record.iteration == 2 ? Directive::Interrupt : Directive::Continue;
    });
    const SolveResult result =
        NewtonStepper(problem, options)
            .minimize(problem.reduce(part.x0()), {}, ranks->rank() == 0 ? &observer : nullptr);
    EXPECT_EQ(result.status, Status::Interrupted);
    EXPECT_EQ(result.iterations.size(), 2u);
  });
}

// Only the start of one rank is out of order.
TEST_P(PartitionedNewton, ARefusalOfOneRankIsOneOfAll) {
  test::run_ranks(GetParam(), [](const auto& ranks) {
    const Part part(ranks);
    const Problem problem = part.problem();
    NewtonOptions options;
    options.linear_solver = [] { return std::make_unique<DenseSolver>(); };
    Vec x = part.x0();
    for (Index i = 0; i < x.size(); ++i)
      if (part.node[i] == 5) x[i] = 100;  // inside a group, hence on one rank
    const SolveResult result = NewtonStepper(problem, options).minimize(problem.reduce(x), {});
    EXPECT_EQ(result.status, Status::Infeasible);
    EXPECT_NE(result.message.find("order"), std::string::npos);
  });
}

// With two ranks or more, the last one has no gaps.
INSTANTIATE_TEST_SUITE_P(Ranks, PartitionedNewton, testing::Values(1, 2, 3, 5));

TEST(PartitionedProblem, AnUnknownIsHeldWithAllItsCopies) {
  EXPECT_THROW(test::run_ranks(3, [](const auto& ranks) { Part(ranks).problem(false); }),
               InvalidArgument);
}

TEST(PartitionedProblem, ConstraintsHoldSingleUnknowns) {
  EXPECT_THROW(test::run_ranks(3,
                               [](const auto& ranks) {
                                 const Part part(ranks);
                                 ProblemBuilder builder = shared_problem_builder(part.partition);
                                 builder.add(part.gaps, 1.0);
                                 struct Tied final : Constraint {
                                   void append_rows(ConstraintRows& rows) const override {
                                     rows.begin_row("tied");
                                     rows.add(0, 1);
                                     rows.add(2, 1);
                                     rows.end_row(0);
                                   }
                                 };
                                 if (ranks->rank() == 0) builder.add(Tied());
                                 builder.build();
                               }),
               InvalidArgument);
}

// Solvers for one process refuse several ranks, on every rank.
TEST(PartitionedProblem, SolversOfOneProcessRefuse) {
  const auto on_ranks = [](const std::function<void(const Problem&, const Vec&)>& minimize) {
    test::run_ranks(2, [&](const auto& ranks) {
      const Part part(ranks);
      const Problem problem = part.problem();
      minimize(problem, problem.reduce(part.x0()));
    });
  };
  EXPECT_THROW(on_ranks([](const Problem& p, const Vec&) { NewtonStepper(p, {}); }),
               InvalidArgument);
  EXPECT_THROW(
      on_ranks([](const Problem& p, const Vec& y) { LbfgsMinimizer().minimize(p, y, {}); }),
      InvalidArgument);
  EXPECT_THROW(
      on_ranks([](const Problem& p, const Vec& y) { CeresMinimizer().minimize(p, y, {}); }),
      InvalidArgument);
}

// A stop check of one rank is refused on all ranks before any of them waits; other functions refuse
// it on its rank.
TEST(PartitionedProblem, StopChecksAreRefused) {
  const StopCheck stop([] { return Directive::Continue; });
  for (const int who : {0, 1})
    EXPECT_THROW(test::run_ranks(2,
                                 [&](const auto& ranks) {
                                   const Part part(ranks);
                                   NewtonOptions options;
                                   options.linear_solver = [] {
                                     return std::make_unique<DenseSolver>();
                                   };
                                   if (ranks->rank() == who) options.stop = stop;
                                   NewtonStepper(part.problem(), options);
                                 }),
                 InvalidArgument);
  test::run_ranks(2, [&](const auto& ranks) {
    const Problem problem = Part(ranks).problem();
    const Vec x = Part(ranks).x0(), y = problem.reduce(x);
    Evaluator evaluator(problem);
    Vec g, h;
    EXPECT_THROW(evaluator.value(y, stop), InvalidArgument);
    EXPECT_THROW(evaluator.gradient(y, g, stop), InvalidArgument);
    EXPECT_THROW(evaluator.linearize(y, Curvature::Projected, g, h, stop), InvalidArgument);
    EXPECT_THROW(term_energy(problem, problem.terms().front(), x, stop), InvalidArgument);
    EXPECT_THROW(LineSearch(evaluator, {}, y, y, 1, 1, stop), InvalidArgument);
  });
  Evaluator alone(Part(one_process()).problem());
  EXPECT_TRUE(std::isfinite(alone.value(alone.problem().reduce(Part(one_process()).x0()), stop)));
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
