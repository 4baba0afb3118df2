// Eliminations of graphs that gain edges: factors compared with dense linear algebra.
#include "majorant/framework/internal/symbolic_update.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "framework/random_matrix.h"
#include "majorant/framework/internal/multifrontal.h"

namespace majorant {
namespace {

using test::Random;

// Returns a chain: every block is a supernode that touches the next one.
BlockElimination chain(Index blocks) {
  BlockElimination e;
  for (Index b = 0; b < blocks; ++b) {
    e.order.push_back(b);
    e.supernode_starts.push_back(b);
    e.structure_starts.push_back(e.structure.size());
    e.structure.push_back(b);
    if (b + 1 < blocks) e.structure.push_back(b + 1);
  }
  e.supernode_starts.push_back(blocks);
  e.structure_starts.push_back(e.structure.size());
  return e;
}

SparsePattern pattern_of(Index blocks, const BlockEdges& edges) {
  SparsePattern p;
  for (Index c = 0; c < blocks; ++c) {
    std::vector<Index> below;
    for (const auto& [a, b] : edges)
      if (std::min(a, b) == c) below.push_back(std::max(a, b));
    p.append_column(below);
  }
  p.order_in_blocks(1);
  return p;
}

// Returns |H p - r| for a diagonally dominant matrix.
double residual_of(const SparsePattern& p, const BlockElimination& e, Random& random) {
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(p.size, p.size);
  Vec values = random.vector(p.nonzeros());
  for (Index c = 0; c < p.size; ++c)
    for (Index k = p.column_starts[c]; k < p.column_starts[c + 1]; ++k) {
      if (p.rows[k] == c) values[k] += p.size;
      dense(p.rows[k], c) = dense(c, p.rows[k]) = values[k];
    }
  const AssemblyTree tree(p, e);
  MultifrontalFactor factor(tree, front_kernels());
  if (!factor.factorize(values, 0)) return 1;
  const Vec r = random.vector(p.size);
  Vec x;
  factor.solve(r, x);
  return (dense * x - r).norm();
}

TEST(ExtendedElimination, WithoutEdgesItStaysAsItIs) {
  const BlockElimination e = chain(5), same = symbolic_update(e, {});
  EXPECT_EQ(same.order, e.order);
  EXPECT_EQ(same.supernode_starts, e.supernode_starts);
  EXPECT_EQ(same.structure_starts, e.structure_starts);
  EXPECT_EQ(same.structure, e.structure);
}

TEST(ExtendedElimination, AnEdgePassesThroughAllSupernodesUpToItsEnd) {
  const BlockElimination e = symbolic_update(chain(5), {{3, 0}});
  EXPECT_EQ(e.structure_starts, (std::vector<std::size_t>{0, 3, 6, 8, 10, 11}));
  EXPECT_EQ(e.structure, (std::vector<Index>{0, 1, 3, 1, 2, 3, 2, 3, 3, 4, 4}));
}

// 0 and 1 are children of 3; an edge from 0 to 2 makes 0 a child of 2, which comes after 1.
TEST(ExtendedElimination, SupernodesAreInPostorderAgain) {
  const BlockElimination e{{0, 1, 2, 3}, {0, 1, 2, 3, 4}, {0, 2, 4, 6, 7}, {0, 3, 1, 3, 2, 3, 3}};
  const BlockElimination more = symbolic_update(e, {{0, 2}});
  EXPECT_EQ(more.order, (std::vector<Index>{1, 0, 2, 3}));
  EXPECT_EQ(more.structure, (std::vector<Index>{0, 3, 1, 2, 3, 2, 3, 3}));
}

TEST(ExtendedElimination, FactorsOfGraphsThatGrowEdgeByEdge) {
  Random random(1);
  const Index blocks = 40;
  BlockElimination e = chain(blocks);
  BlockEdges all;
  for (Index b = 0; b + 1 < blocks; ++b) all.push_back({b, b + 1});
  for (int round = 0; round < 12; ++round) {
    BlockEdges edges;
    for (int k = 0; k < 4; ++k) {
      const Index a = random.integer(0, static_cast<int>(blocks) - 1);
      const Index b = random.integer(0, static_cast<int>(blocks) - 1);
      if (a != b) edges.push_back({a, b});
    }
    e = symbolic_update(e, edges);
    all.insert(all.end(), edges.begin(), edges.end());
    EXPECT_LE(residual_of(pattern_of(blocks, all), e, random), 1e-12) << round;
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
