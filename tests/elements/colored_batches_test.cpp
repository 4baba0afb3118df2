// Batches, colours, and results that do not depend on the number of threads.
#include "majorant/framework/internal/colored_batches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "framework/quadratic_term.h"
#include "majorant/framework/parallel.h"
#include "majorant/framework/problem.h"
#include "majorant/framework/problem_parts.h"
#include "support.h"

namespace majorant {
namespace {

using test::QuadraticTerm;
using test::Random;
using test::Rows;

void expect_valid(const ColoredBatches& plan, const ElementDofs& element_dofs,
                  const std::vector<RuleId>& rules) {
  std::vector<int> seen(static_cast<std::size_t>(element_dofs.element_count()), 0);
  for (Index c = 0; c < plan.batch_count(); ++c) {
    const ElementBatch batch = plan.batch(c);
    EXPECT_GE(batch.elements.size(), 1u);
    EXPECT_LE(batch.elements.size(), static_cast<std::size_t>(ElementBatch::kMaxSize));
    for (const Index e : batch.elements) {
      ++seen[static_cast<std::size_t>(e)];
      EXPECT_EQ(batch.rule, rules.empty() ? 0 : rules[static_cast<std::size_t>(e)]);
    }
  }
  EXPECT_TRUE(std::all_of(seen.begin(), seen.end(), [](int n) { return n == 1; }));

  std::vector<int> coloured(static_cast<std::size_t>(plan.batch_count()), 0);
  for (const auto& colour : plan.colours()) {
    std::set<Index> nodes;
    for (const Index c : colour) {
      ++coloured[static_cast<std::size_t>(c)];
      std::set<Index> own;
      for (const Index e : plan.batch(c).elements)
        for (Index k = 0; k < element_dofs.nodes.cols(); ++k) own.insert(element_dofs.nodes(e, k));
      for (const Index n : own) EXPECT_TRUE(nodes.insert(n).second) << "node " << n;
    }
  }
  EXPECT_TRUE(std::all_of(coloured.begin(), coloured.end(), [](int n) { return n == 1; }));
}

TEST(ColoredBatches, Meshes) {
  const test::Mesh mesh = test::grid(30, 30);
  const ElementDofs element_dofs{mesh.faces, 2};
  const ColoredBatches plan(element_dofs, {});
  expect_valid(plan, element_dofs, {});
  EXPECT_LE(plan.batch_count(), 1800 / ElementBatch::kMaxSize + 1);
  EXPECT_LE(plan.colours().size(), 8u);
}

TEST(ColoredBatches, MixedRules) {
  Random random(1);
  const test::Mesh mesh = test::grid(20, 20);
  const ElementDofs element_dofs{mesh.faces, 2};
  std::vector<RuleId> rules;
  for (Index e = 0; e < mesh.faces.rows(); ++e) rules.push_back(random.integer(0, 4));
  expect_valid(ColoredBatches(element_dofs, rules), element_dofs, rules);
}

TEST(ColoredBatches, UnconnectedAndScatteredElements) {
  Random random(2);
  for (const Index nodes : {50, 100000}) {
    const ElementDofs element_dofs = test::random_elements(random, 1000, 3, nodes, 1);
    expect_valid(ColoredBatches(element_dofs, {}), element_dofs, {});
  }
}

// One node has more batches than the colour mask has bits.
TEST(ColoredBatches, OneNodeInEveryElement) {
  ElementDofs element_dofs = test::band_elements(70 * ElementBatch::kMaxSize, 2, 1);
  element_dofs.nodes.col(0).setZero();
  const ColoredBatches plan(element_dofs, {});
  expect_valid(plan, element_dofs, {});
  EXPECT_EQ(plan.colours().size(), 70u);
}

// An unknown that distant elements share through the elimination: it has few batches.
TEST(ColoredBatches, SharedUnknownsTakeFewColours) {
  const test::Mesh mesh = test::grid(100, 100);
  const ElementDofs element_dofs{mesh.faces, 2};
  ConstraintRows rows;
  const Index shared = rows.add_auxiliary();
  for (Index v = 50; v < mesh.positions.rows(); v += 101) {  // a line of vertices
    rows.begin_row("line");
    rows.add(2 * v, 1);
    rows.add(shared, -2);
    rows.end_row(0);
  }
  const Elimination z(2 * static_cast<Index>(mesh.positions.rows()), rows);
  const ColoredBatches plan(element_dofs, {}, z);
  expect_valid(plan, element_dofs, {});
  EXPECT_LE(plan.colours().size(), 10u);
}

TEST(ColoredBatches, Empty) {
  const ColoredBatches plan(ElementDofs{Cells(0, 3), 2}, {});
  EXPECT_EQ(plan.batch_count(), 0);
  EXPECT_TRUE(plan.colours().empty());
}

struct System {
  double f, value;
  Vec g, h;
  bool operator==(const System&) const = default;
};

System evaluate(const Problem& problem, const Vec& y, int count) {
  const ThreadCount threads(count);
  EXPECT_EQ(ThreadCount::current(), count);
  Evaluator evaluator(problem);
  System s;
  s.f = evaluator.linearize(y, Curvature::Exact, s.g, s.h);
  s.value = evaluator.value(y);
  return s;
}

TEST(Threads, DoNotChangeABit) {
  Random random(3);
  const test::Mesh mesh = test::grid(40, 40);
  const auto term = std::make_shared<const QuadraticTerm>(ElementDofs{mesh.faces, 2}, random);
  const Index size = 2 * static_cast<Index>(mesh.positions.rows());
  const Problem problem = ProblemBuilder(size).add(term, 1.1).build();
  const Vec y = random.vector(problem.size());
  const System one = evaluate(problem, y, 1);
  for (const int count : {2, 3, 2}) EXPECT_TRUE(evaluate(problem, y, count) == one);
}

// Constraints identify unknowns of distant nodes (seams, a chain's translation).
Problem seam_problem(Random& random, const test::Mesh& mesh) {
  const auto term = std::make_shared<const QuadraticTerm>(ElementDofs{mesh.faces, 2}, random);
  const Index count = static_cast<Index>(mesh.positions.rows());
  Rows rows;
  for (Index k = 0; k < 80; ++k)
    for (Index c = 0; c < 2; ++c) {
      const Index a = 2 * k + c, b = 2 * (count - 1 - k) + c, t = 2 * (count / 2) + c;
      rows.row({{a, 1}, {b, -1}, {t, -1}}, 0);
    }
  return ProblemBuilder(2 * count).add(term, 1.0).add(rows).build();
}

TEST(Threads, BatchesOfOneColourShareNoReducedUnknown) {
  Random random(4);
  const test::Mesh mesh = test::grid(40, 40);
  const Problem problem = seam_problem(random, mesh);
  const Elimination& z = ProblemParts::elimination(problem);
  const ElementDofs& s = problem.term(problem.terms().front()).element_dofs();
  int shared = 0;
  for (const auto& colour : ProblemParts::plan(problem, problem.terms().front()).colours()) {
    std::set<Index> unknowns;
    for (const Index c : colour) {
      std::set<Index> own;
      for (const Index e : ProblemParts::plan(problem, problem.terms().front()).batch(c).elements)
        for (Index k = 0; k < s.nodes.cols(); ++k)
          for (int b = 0; b < s.block; ++b)
            for (const auto& q : z.row(s.block * s.nodes(e, k) + b)) own.insert(q.reduced);
      for (const Index u : own) shared += !unknowns.insert(u).second;
    }
  }
  EXPECT_EQ(shared, 0) << "batches assembled at the same time write the same unknowns: a data race";
}

TEST(Threads, DoNotChangeABitWithSeams) {
  Random random(5);
  const test::Mesh mesh = test::grid(40, 40);
  const Problem problem = seam_problem(random, mesh);
  const Vec y = random.vector(problem.size());
  const System one = evaluate(problem, y, 1);
  int different = 0;
  for (int k = 0; k < 20; ++k) different += !(evaluate(problem, y, 2) == one);
  EXPECT_EQ(different, 0);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
