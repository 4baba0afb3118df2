// Compares orders and analyses of the sparse factorization with CHOLMOD's.
#include "majorant/framework/internal/symbolic_analysis.h"

#include <cholmod.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "framework/random_matrix.h"
#include "majorant/framework/internal/block_ordering.h"
#include "majorant/framework/internal/covered_nodes.h"

namespace majorant {
namespace {

// A graph as CHOLMOD's matrix: one triangle of ones.
class CholmodAnalysis {
 public:
  explicit CholmodAnalysis(const BlockGraph& graph) : size_(graph.size()) {
    cholmod_start(&common_);
    common_.supernodal = CHOLMOD_SUPERNODAL;
    common_.nmethods = 1;
    common_.method[0].ordering = CHOLMOD_GIVEN;
    common_.postorder = 1;
    const std::size_t few[3]{4, 8, 16};
    std::copy(few, few + 3, common_.nrelax);
    starts_.push_back(0);
    for (Index b = 0; b < size_; ++b) {
      for (const Index c : graph.larger(b)) rows_.push_back(c);
      starts_.push_back(static_cast<Index>(rows_.size()));
    }
    matrix_.nrow = matrix_.ncol = static_cast<std::size_t>(size_);
    matrix_.nzmax = rows_.size();
    matrix_.p = starts_.data();
    matrix_.i = rows_.data();
    matrix_.stype = -1;
    matrix_.itype = CHOLMOD_INT;
    matrix_.xtype = CHOLMOD_PATTERN;
    matrix_.dtype = CHOLMOD_DOUBLE;
    matrix_.packed = 1;
  }
  ~CholmodAnalysis() { cholmod_finish(&common_); }
  CholmodAnalysis(const CholmodAnalysis&) = delete;
  CholmodAnalysis& operator=(const CholmodAnalysis&) = delete;

  std::vector<Index> minimum_degree() {
    std::vector<Index> order(static_cast<std::size_t>(size_));
    EXPECT_TRUE(cholmod_amd(&matrix_, nullptr, 0, order.data(), &common_));
    return order;
  }

  BlockElimination analyzed(std::vector<Index> order) {
    cholmod_factor* f = cholmod_analyze_p(&matrix_, order.data(), nullptr, 0, &common_);
    const auto list = [](const void* values, std::size_t count) {
      const auto* first = static_cast<const Index*>(values);
      return std::vector<Index>(first, first + count);
    };
    const std::vector<Index> starts = list(f->pi, f->nsuper + 1);
    BlockElimination out{
        list(f->Perm, f->n), list(f->super, f->nsuper + 1), {starts.begin(), starts.end()}, {}};
    out.structure = list(f->s, out.structure_starts.back());
    cholmod_free_factor(&f, &common_);
    return out;
  }

 private:
  Index size_;
  std::vector<Index> starts_, rows_;
  cholmod_sparse matrix_{};
  cholmod_common common_{};
};

void expect_equal(const BlockElimination& a, const BlockElimination& b) {
  EXPECT_EQ(a.order, b.order);
  EXPECT_EQ(a.supernode_starts, b.supernode_starts);
  EXPECT_EQ(a.structure_starts, b.structure_starts);
  EXPECT_EQ(a.structure, b.structure);
}

SparsePattern pattern_of(const ElementDofs& element_dofs, Index nodes, int block) {
  return reduced_pattern({&element_dofs}, Elimination(nodes * block, ConstraintRows{}));
}

// Returns the pattern of triangles of a square grid, similar to surfaces, two unknowns per node.
SparsePattern grid_pattern(Index side) {
  ElementDofs s;
  s.block = 2;
  s.nodes.resize(2 * (side - 1) * (side - 1), 3);
  Index row = 0;
  for (Index y = 0; y + 1 < side; ++y)
    for (Index x = 0; x + 1 < side; ++x) {
      const Index a = y * side + x;
      s.nodes.row(row++) << a, a + 1, a + side;
      s.nodes.row(row++) << a + 1, a + side + 1, a + side;
    }
  return pattern_of(s, side * side, 2);
}

void expect_cholmods(const SparsePattern& pattern) {
  const BlockGraph graph(pattern);
  CholmodAnalysis theirs(graph);
  const std::vector<Index> amd = minimum_degree_order(graph).order;
  if (graph.size() < 100 || !has_many_covered_nodes(BlockNeighbours(graph))) {
    EXPECT_EQ(amd, theirs.minimum_degree());
  }
  std::vector<Index> natural(amd.size());
  std::iota(natural.begin(), natural.end(), 0);
  for (const std::vector<Index>& order : {amd, nested_dissection_order(graph), natural})
    expect_equal(analyze_elimination(graph, order), theirs.analyzed(order));
}

TEST(SymbolicAnalysis, IsCholmodsOnRandomGraphs) {
  test::Random random(11);
  for (const auto& [nodes, block, elements] :
       {std::tuple(2, 1, 1), {7, 2, 4}, {40, 1, 15}, {100, 2, 70}, {300, 1, 900}, {900, 3, 700}}) {
    SCOPED_TRACE(nodes);
    for (int k = 0; k < 20; ++k)
      expect_cholmods(
          pattern_of(test::random_elements(random, elements, 3, nodes, block), nodes, block));
  }
}

TEST(SymbolicAnalysis, IsCholmodsOnSurfaces) {
  for (const Index side : {2, 3, 10, 60}) expect_cholmods(grid_pattern(side));
}

// Graphs: one node, no edges, a star with a dense centre, a path.
TEST(SymbolicAnalysis, SmallAndOddGraphs) {
  for (const Index nodes : {1, 2, 60}) {
    ElementDofs s;
    s.block = 1;
    s.nodes.resize(1, 1);
    s.nodes(0, 0) = 0;
    expect_cholmods(pattern_of(s, nodes, 1));
    if (nodes < 2) continue;
    for (const bool is_star : {true, false}) {
      s.nodes.resize(nodes - 1, 2);
      for (Index k = 1; k < nodes; ++k) s.nodes.row(k - 1) << (is_star ? 0 : k - 1), k;
      expect_cholmods(pattern_of(s, nodes, 1));
    }
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
