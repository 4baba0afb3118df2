// Polygons with known connectivity: pairs of sides, fans, border loops, components.
#include "majorant/mesh/connectivity.h"

#include <gtest/gtest.h>

#include <array>
#include <utility>
#include <vector>

namespace majorant {
namespace {

template <std::size_t kCorners>
using Polygons = std::vector<std::array<Index, kCorners>>;

template <std::size_t kCorners>
struct PolygonBag {
  Polygons<kCorners> polygons;

  static constexpr Index kSides = static_cast<Index>(kCorners);
  Index half_edges() const { return kSides * static_cast<Index>(polygons.size()); }
  Index from(Index h) const { return polygons[to_size(h / kSides)][to_size(h % kSides)]; }
  std::pair<Index, Index> ends(Index h) const {
    return {from(h), from(HalfEdgesOf<kSides>::next(h))};
  }
  PairedSides pairs() const {
    return pair_sides(100, half_edges(), [&](Index h) { return ends(h); });
  }
  std::vector<Index> touching() const {
    return touching_vertices<kSides>(pairs().opposite, [&](Index h) { return from(h); });
  }
  std::vector<std::vector<Index>> loops_of_vertices() const {
    std::vector<std::vector<Index>> loops = border_loops<kSides>(pairs().opposite);
    for (std::vector<Index>& loop : loops)
      for (Index& h : loop) h = from(h);
    return loops;
  }
};

// Returns 3 by 3 quads over 4 by 4 vertices without the middle one.
PolygonBag<4> ring_of_quads() {
  PolygonBag<4> bag;
  for (const Index a : {0, 1, 2, 4, 6, 8, 9, 10}) bag.polygons.push_back({a, a + 1, a + 5, a + 4});
  return bag;
}

// Returns the sides of a cube.
PolygonBag<4> sides_of_a_cube() {
  return {{{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
}

TEST(Connectivity, HalfEdgesGoAroundTheirPolygon) {
  for (const Index h : {0, 1, 2, 3, 4, 5, 6, 7, 8, 9}) {
    EXPECT_EQ(HalfEdgesOf<5>::face(h), h / 5);
    EXPECT_EQ(HalfEdgesOf<5>::corner(h), h % 5);
    EXPECT_EQ(HalfEdgesOf<5>::next(h), 5 * (h / 5) + (h + 1) % 5);
    EXPECT_EQ(HalfEdgesOf<5>::previous(h), 5 * (h / 5) + (h + 4) % 5);
  }
}

TEST(Connectivity, SidesArePairedWhicheverWayTheyRun) {
  const PairedSides against = PolygonBag<4>{{{0, 1, 2, 3}, {1, 0, 4, 5}}}.pairs();
  EXPECT_EQ(against.opposite, (std::vector<Index>{4, -1, -1, -1, 0, -1, -1, -1}));
  EXPECT_TRUE(against.is_manifold());
  const PairedSides along = PolygonBag<4>{{{0, 1, 2, 3}, {0, 1, 5, 4}}}.pairs();
  EXPECT_EQ(along.opposite, against.opposite);
  EXPECT_EQ(along.same_way, (std::vector<Index>{0}));
  EXPECT_FALSE(along.is_manifold());
}

// Edges with more than two sides are listed by their ends, and these sides stay open.
TEST(Connectivity, CrowdedEdgesStayOpen) {
  const PairedSides sides =
      PolygonBag<3>{{{4, 5, 6}, {5, 4, 7}, {4, 5, 8}, {0, 1, 2}, {1, 0, 3}, {1, 0, 4}, {0, 1, 9}}}
          .pairs();
  ASSERT_EQ(sides.crowded.size(), 2u);
  const auto list = [&](std::size_t k) {
    return std::vector<Index>(sides.crowded[k].begin(), sides.crowded[k].end());
  };
  EXPECT_EQ(list(0), (std::vector<Index>{9, 12, 15, 18}));
  EXPECT_EQ(list(1), (std::vector<Index>{0, 3, 6}));
  for (const Index h : sides.crowded.indices()) EXPECT_EQ(sides.opposite[h], -1);
  EXPECT_TRUE(sides.same_way.empty());
}

// Two layers of faces over one edge are two edges; sides with a negative start are excluded.
TEST(Connectivity, LayersAreApart) {
  const PolygonBag<3> bag{{{0, 1, 2}, {0, 1, 2}, {1, 0, 3}, {1, 0, 3}, {0, 1, 4}}};
  const std::vector<Index> layer{0, 1, 0, 1, -1};
  const PairedSides sides = pair_sides(
      5, bag.half_edges(),
      [&](Index h) {
        const auto [from, to] = bag.ends(h);
        return std::pair(layer[to_size(h / 3)] < 0 ? -1 : from, to);
      },
      [&](Index h) { return layer[to_size(h / 3)]; });
  EXPECT_TRUE(sides.crowded.empty());
  EXPECT_EQ(sides.opposite[0], 6);
  EXPECT_EQ(sides.opposite[3], 9);
  EXPECT_EQ(sides.opposite[12], -1);
}

TEST(Connectivity, VerticesWhereFacesTouchAreAllNamed) {
  EXPECT_TRUE(ring_of_quads().touching().empty());
  EXPECT_TRUE(sides_of_a_cube().touching().empty());
  // A row of quads that touch at corners.
  EXPECT_EQ((PolygonBag<4>{{{0, 1, 2, 3}, {2, 4, 5, 6}, {5, 7, 8, 9}}}.touching()),
            (std::vector<Index>{2, 5}));
}

TEST(Connectivity, LoopsHaveTheFacesOnTheirLeft) {
  EXPECT_TRUE(sides_of_a_cube().loops_of_vertices().empty());
  EXPECT_EQ(
      ring_of_quads().loops_of_vertices(),
      (std::vector<std::vector<Index>>{{0, 1, 2, 3, 7, 11, 15, 14, 13, 12, 8, 4}, {6, 5, 9, 10}}));
  // Two quads that touch in a vertex: a loop each, from their smallest half-edges.
  EXPECT_EQ((PolygonBag<4>{{{2, 3, 0, 1}, {2, 4, 5, 6}}}.loops_of_vertices()),
            (std::vector<std::vector<Index>>{{2, 3, 0, 1}, {2, 4, 5, 6}}));
}

TEST(Connectivity, EveryComponentHasItsTopology) {
  PolygonBag<4> bag = sides_of_a_cube();
  for (std::array<Index, 4> quad : ring_of_quads().polygons) {
    for (Index& v : quad) v += 20;
    bag.polygons.insert(bag.polygons.begin() + 1, quad);  // interleaved
  }
  const std::vector<Topology> all =
      component_topologies<4>(100, bag.pairs().opposite, [&](Index h) { return bag.from(h); });
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].faces, 6);
  EXPECT_EQ(all[0].edges, 12);
  EXPECT_EQ(all[0].vertices, 8);
  EXPECT_EQ(all[0].boundary_loops, 0);
  EXPECT_EQ(all[0].euler_characteristic(), 2);
  EXPECT_EQ(all[1].faces, 8);
  EXPECT_EQ(all[1].boundary_loops, 2);
  EXPECT_EQ(all[1].euler_characteristic(), 0);
  EXPECT_EQ(all[1].components, 1);
  const std::vector<Index> component = components_of_faces<4>(bag.pairs().opposite);
  EXPECT_EQ(component[0], 0);
  EXPECT_EQ(component[1], 1);
  EXPECT_EQ(component.back(), 0);
  EXPECT_EQ(component_count(component), 2);
  EXPECT_EQ(component_count({}), 0);
}

// A fan has a vertex's corners connected across edges, for any orientation of its faces.
TEST(Connectivity, FansOfFacesThatDisagree) {
  const PolygonBag<3> bag{{{0, 1, 2}, {0, 3, 2}, {0, 3, 4}, {0, 5, 6}}};
  const std::vector<Index> opposite = bag.pairs().opposite;
  const std::vector<Index> fan = corner_fans<3>(
      opposite, [&](Index h) { return bag.from(h) != bag.from(opposite[to_size(h)]); });
  EXPECT_EQ(fan[0], fan[3]);  // at vertex 0
  EXPECT_EQ(fan[3], fan[6]);
  EXPECT_NE(fan[0], fan[9]);
  EXPECT_EQ(fan[2], fan[5]);  // at vertex 2
  EXPECT_EQ(fan[4], fan[7]);  // at vertex 3
  EXPECT_NE(fan[1], fan[4]);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
