// Cuts that join holes become shorter; on surfaces with thousands of holes by paths nearby.
#include "majorant/mesh/cut_shortening.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "majorant/mesh/cut_graph.h"
#include "mesh/surfaces_of_any_genus.h"

namespace majorant {
namespace {

// A square of n by n quads, where n = 3 k + 2, whose quads (3 i + 1, 3 j + 1) are holes. Cuts along
// the lower sides of each row of holes: two edges from hole to hole, one from the first hole to the
// left side. Lengths are in edges of the grid.
struct RowsOfHoles {
  explicit RowsOfHoles(int n)
      : side(n), mesh(SurfaceMesh::from_polygons(grid_without(n, holes()))) {
    for (Index h = 0; h < mesh.half_edge_count(); ++h)
      half_edge[{place(mesh.from_vertex(h)), place(mesh.to_vertex(h))}] = h;
    is_cut.assign(to_size(mesh.half_edge_count()), 0);
    cost = n * edge_lengths(mesh);
    for (int y = 1; y + 1 < n; y += 3)
      for (int x = 0; x + 3 < n; ++x)
        if (x % 3 != 1) set({x, y}, {x + 1, y}, 1);
  }

  std::set<int> holes() const {
    std::set<int> quads;
    for (int y = 1; y + 1 < side; y += 3)
      for (int x = 1; x + 1 < side; x += 3) quads.insert(y * side + x);
    return quads;
  }
  using Place = std::pair<int, int>;
  Place place(Index v) const {
    return {std::lround(side * mesh.positions()(v, 0)), std::lround(side * mesh.positions()(v, 1))};
  }
  void set(const Place& a, const Place& b, char value) {
    is_cut[half_edge.at({a, b})] = is_cut[half_edge.at({b, a})] = value;
  }
  bool is_set(const Place& a, const Place& b) const { return is_cut[half_edge.at({a, b})] != 0; }
  double length() const {
    double sum = 0;
    for (Index h = 0; h < mesh.half_edge_count(); ++h)
      if (is_cut[h]) sum += 0.5 * cost[h];
    return sum;
  }
  Index sides() const {
    Index count = 0;
    for (Index h = 0; h < mesh.half_edge_count(); ++h) count += is_cut[h] || mesh.opposite(h) < 0;
    return count;
  }
  // Shortens the cut, which leaves a disk as before.
  void shorten() {
    const std::vector<char> no_terminal(to_size(mesh.vertex_count()), 0);
    shorten_cut(mesh, no_terminal, cost, is_cut, {});
    EXPECT_NO_THROW(mesh.cut_along(is_cut, nullptr).require_disk());
  }

  int side;
  SurfaceMesh mesh;
  std::map<std::pair<Place, Place>, Index> half_edge;
  std::vector<char> is_cut;  // 3 #F
  Vec cost;                  // 3 #F
};

// Sides from which on a chain is compared with paths near it (cut_shortening.cpp).
constexpr Index kManySides = 30000;

TEST(ShortenCut, RemovesDetoursOnSmallAndLargeSurfaces) {
  for (const int n : {20, 200}) {
    RowsOfHoles rows(n);
    EXPECT_EQ(rows.sides() > kManySides, n == 200);
    rows.shorten();
    const double shortest = rows.length();
    // From the second hole of the second row upwards, to the right and down to the third one.
    for (int x = 5; x < 7; ++x) {
      rows.set({x, 4}, {x + 1, 4}, 0);
      rows.set({x, 6}, {x + 1, 6}, 1);
    }
    for (const int x : {5, 7}) rows.set({x, 5}, {x, 6}, 1);
    EXPECT_NEAR(rows.length(), shortest + 2, 1e-9) << n;
    rows.shorten();
    EXPECT_NEAR(rows.length(), shortest, 1e-9) << n;
  }
}

// A path from the last hole of a row to the right side costs least, and replaces a cut of that row.
// On large surfaces no cut of the row is as long as its distance from that path.
TEST(ShortenCut, SearchesDistantPathsOnSmallSurfaces) {
  for (const int n : {20, 200}) {
    RowsOfHoles rows(n);
    rows.shorten();
    const std::vector<char> before = rows.is_cut;
    const double length = rows.length();
    for (int x = n - 3; x < n; ++x)
      for (const auto& [a, b] : {std::pair(x, x + 1), {x + 1, x}})
        rows.cost[rows.half_edge.at({{a, 4}, {b, 4}})] = 0.1;
    rows.shorten();
    EXPECT_EQ(rows.is_set({n - 1, 4}, {n, 4}), n == 20) << n;
    if (n == 20) {
      EXPECT_NEAR(rows.length(), length - 2 + 0.3, 1e-9);
    } else {
      EXPECT_EQ(rows.is_cut, before);
    }
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
