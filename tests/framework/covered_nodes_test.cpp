// Compares covered nodes with their definition, and measures orders by corners on elements of
// higher degree.
#include "majorant/framework/internal/covered_nodes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include "framework/random_matrix.h"
#include "majorant/framework/internal/block_ordering.h"
#include "majorant/framework/internal/symbolic_analysis.h"

namespace majorant {
namespace {

SparsePattern pattern_of_nodes(const Cells& cells, Index nodes) {
  const ElementDofs s{cells, 1};
  return reduced_pattern({&s}, Elimination(nodes, ConstraintRows{}));
}

// Returns triangles of degree n: a square of squares, cut along their diagonals.
SparsePattern triangles(Index squares, Index degree) {
  const Index side = squares * degree + 1;
  Cells cells(2 * squares * squares, (degree + 1) * (degree + 2) / 2);
  Index row = 0;
  for (Index square = 0; square < squares * squares; ++square)
    for (const bool upper : {false, true}) {
      const Index x = square % squares * degree, y = square / squares * degree;
      Index k = 0;
      for (Index b = 0; b <= degree; ++b)
        for (Index a = 0; a + b <= degree; ++a)
          cells(row, k++) =
              upper ? (y + degree - b) * side + x + degree - a : (y + b) * side + x + a;
      ++row;
    }
  return pattern_of_nodes(cells, side * side);
}

// Returns straight hexahedra of a cube.
SparsePattern hexahedra(Index cubes) {
  const Index side = cubes + 1;
  Cells cells(cubes * cubes * cubes, 8);
  for (Index c = 0; c < cells.rows(); ++c)
    for (Index k = 0; k < 8; ++k)
      cells(c, k) = ((c / (cubes * cubes) + k / 4) * side + c / cubes % cubes + k / 2 % 2) * side +
                    c % cubes + k % 2;
  return pattern_of_nodes(cells, side * side * side);
}

bool covers(const BlockNeighbours& near, Index p, Index x) {
  const auto closed = [&](Index node) {
    std::set<Index> out(near.of(node).begin(), near.of(node).end());
    out.insert(node);
    return out;
  };
  const std::set<Index> large = closed(p), small = closed(x);
  if (!large.contains(x) || !std::ranges::includes(large, small)) return false;
  return large.size() > small.size() || p < x;
}

void expect_ordered(const BlockNeighbours& near) {
  std::vector<Index> uncovered;
  for (Index x = 0; x < near.size(); ++x) {
    bool is_covered = false;
    for (Index p = 0; p < near.size(); ++p) is_covered |= p != x && covers(near, p, x);
    if (!is_covered) uncovered.push_back(x);
  }
  ASSERT_EQ(uncovered_nodes(near), uncovered);

  std::ranges::reverse(uncovered);
  const std::vector<Index> order = order_with_covered(near, uncovered);
  std::vector<Index> corners;
  std::vector<Index> place(order.size(), -1);
  for (std::size_t k = 0; k < order.size(); ++k) place[order[k]] = static_cast<Index>(k);
  EXPECT_EQ(std::ranges::count(place, -1), 0);
  for (const Index x : order)
    if (std::ranges::count(uncovered, x) > 0) corners.push_back(x);
  EXPECT_EQ(corners, uncovered) << "another order of the corners";
  for (Index x = 0; x < near.size(); ++x) {
    const auto first =
        std::ranges::find_if(uncovered, [&](Index p) { return p != x && covers(near, p, x); });
    if (std::ranges::count(uncovered, x) > 0 || first == uncovered.end()) continue;
    EXPECT_LT(place[x], place[*first]);
    if (first != uncovered.begin()) {
      EXPECT_GT(place[x], place[*(first - 1)]);
    }
  }
}

TEST(CoveredNodes, AreThoseOfTheDefinition) {
  test::Random random(3);
  for (const auto& [nodes, elements, corners] :
       {std::array{1, 1, 1}, {2, 1, 2}, {9, 4, 3}, {30, 12, 5}, {40, 60, 3}, {60, 20, 4}})
    for (int k = 0; k < 20; ++k) {
      SCOPED_TRACE(nodes);
      const ElementDofs s = test::random_elements(random, elements, corners, nodes, 1);
      expect_ordered(BlockNeighbours(BlockGraph(pattern_of_nodes(s.nodes, nodes))));
    }
  for (const Index degree : {1, 2, 3})
    expect_ordered(BlockNeighbours(BlockGraph(triangles(3, degree))));
}

TEST(CoveredNodes, AreAllNodesExceptTheCorners) {
  for (const Index degree : {2, 3, 4}) {
    const BlockNeighbours near{BlockGraph(triangles(10, degree))};
    EXPECT_TRUE(has_many_covered_nodes(near));
    // The four corners of the square are covered by other corners of their triangles.
    EXPECT_EQ(uncovered_nodes(near).size(), 117U);
  }
  EXPECT_FALSE(has_many_covered_nodes(BlockNeighbours(BlockGraph(triangles(30, 1)))));
  EXPECT_FALSE(has_many_covered_nodes(BlockNeighbours()));
}

double factor_entries(const BlockGraph& graph, std::vector<Index> order) {
  const BlockElimination e = analyze_elimination(graph, std::move(order));
  double sum = 0;
  for (std::size_t s = 0; s + 1 < e.supernode_starts.size(); ++s) {
    const double columns = e.supernode_starts[s + 1] - e.supernode_starts[s];
    const auto rows = static_cast<double>(e.structure_starts[s + 1] - e.structure_starts[s]);
    sum += columns * rows - columns * (columns - 1) / 2;
  }
  return sum;
}

// The bound for orders from the mesh is 1.1 times METIS's fill.
TEST(BlockOrdering, OrdersHigherDegreesByTheirCorners) {
  for (const Index degree : {2, 3}) {
    const SparsePattern pattern = triangles(50, degree);
    const BlockGraph graph(pattern);
    const double metis = factor_entries(graph, nested_dissection_order(graph));
    const FillReducingOrder found = fill_reducing_order(graph, Ordering::Automatic);
    EXPECT_EQ(found.method, Ordering::Amd);
    EXPECT_LE(factor_entries(graph, found.order), 1.1 * metis);
    const FillReducingOrder dissected = fill_reducing_order(graph, Ordering::Dissection);
    EXPECT_EQ(dissected.method, Ordering::Dissection);
    EXPECT_LE(factor_entries(graph, dissected.order), 1.1 * metis);
  }
}

TEST(BlockOrdering, DissectsLargeSurfaces) {
  const SparsePattern few = triangles(120, 1), curved = triangles(100, 2), many = triangles(400, 1);
  EXPECT_EQ(fill_reducing_order(BlockGraph(few), Ordering::Automatic).method, Ordering::Amd);
  EXPECT_EQ(fill_reducing_order(BlockGraph(curved), Ordering::Automatic).method,
            Ordering::Dissection);
  const BlockGraph graph(many);
  const FillReducingOrder found = fill_reducing_order(graph, Ordering::Automatic);
  EXPECT_EQ(found.method, Ordering::Dissection);
  const double entries = factor_entries(graph, found.order);
  EXPECT_LE(entries, 1.1 * factor_entries(graph, nested_dissection_order(graph)));
  EXPECT_LE(entries, 0.9 * factor_entries(graph, minimum_degree_order(graph).order));
}

TEST(BlockOrdering, TakesMetisForSolids) {
  const SparsePattern few = hexahedra(3), many = hexahedra(16);
  EXPECT_EQ(fill_reducing_order(BlockGraph(few), Ordering::Automatic).method, Ordering::Amd);
  EXPECT_EQ(fill_reducing_order(BlockGraph(many), Ordering::Automatic).method, Ordering::Metis);
  EXPECT_EQ(fill_reducing_order(BlockGraph(many), Ordering::Amd).method, Ordering::Amd);
  EXPECT_EQ(fill_reducing_order(BlockGraph(few), Ordering::Metis).method, Ordering::Metis);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
