// Chains of seam edges: their ends, and one common side for all edges of a chain.
#include "majorant/mesh/seams.h"

#include <gtest/gtest.h>

#include <numeric>

#include "majorant/constraints/cut_surface.h"
#include "majorant/framework/elimination.h"
#include "parametrization/initialization/seamless_cases.h"
#include "support.h"

namespace majorant {
namespace {

struct Cut {
  Cells faces;
  Seams seams;
};

// Returns the seams of the edges in another order, some of them reversed.
Cut shuffled(const CutSurface& surface, unsigned seed) {
  test::Random random(seed);
  std::vector<SeamEdge> edges = surface.seams->edges();
  for (std::size_t k = edges.size(); k > 1; --k)
    std::swap(edges[k - 1], edges[random.integer(0, int(k) - 1)]);
  for (SeamEdge& e : edges)
    if (random.integer(0, 1)) e = {e.opposite, e.side, (4 - e.turns) % 4};
  return {surface.mesh->faces(), Seams(surface.mesh->faces(), surface.seams->surface_vertex(),
                                       edges, surface.seams->quarter_turns())};
}

CutSurface cut(const SeamlessCase& c) {
  const Start s = c.start();
  return {s.map.shared_mesh(), s.map.shared_seams()};
}

// Returns the cut vertex of a half-edge at a vertex of the uncut surface.
Index copy_at(const Cut& c, Index half_edge, Index surface_vertex) {
  for (const int end : {0, 1}) {
    const Index v = c.faces(half_edge / 3, (half_edge + end) % 3);
    if (c.seams.surface_vertex()[v] == surface_vertex) return v;
  }
  return -1;
}

// Tests the header's definition of chains for all pairs of edges.
void expect_chains(const Cut& c) {
  const auto& edges = c.seams.edges();
  const Index vertices = static_cast<Index>(c.seams.quarter_turns().size());
  std::vector<std::vector<std::size_t>> around(to_size(vertices));
  for (std::size_t e = 0; e < edges.size(); ++e)
    for (const int end : {0, 1})
      around[c.seams.surface_vertex()[c.faces(edges[e].side / 3, (edges[e].side + end) % 3)]]
          .push_back(e);
  std::vector<std::size_t> set(edges.size());
  std::iota(set.begin(), set.end(), std::size_t(0));
  const auto merge = [&](std::size_t a, std::size_t b) {
    std::replace(set.begin(), set.end(), std::size_t(set[a]), std::size_t(set[b]));
  };
  for (Index v = 0; v < vertices; ++v) {
    if (around[v].size() != 2 || c.seams.quarter_turns()[v] == 0) continue;
    const SeamEdge &a = edges[around[v][0]], &b = edges[around[v][1]];
    const bool same_side = copy_at(c, a.side, v) == copy_at(c, b.side, v);
    const bool joined = same_side ? a.turns == b.turns : a.turns == (4 - b.turns) % 4;
    if (!joined) continue;
    merge(around[v][0], around[v][1]);
    EXPECT_EQ(a.chain, b.chain);
    EXPECT_TRUE(same_side);
    EXPECT_EQ(copy_at(c, a.opposite, v), copy_at(c, b.opposite, v));
  }
  std::set<std::size_t> sets(set.begin(), set.end());
  EXPECT_EQ(static_cast<std::size_t>(c.seams.chain_count()), sets.size());
  for (std::size_t e = 0; e < edges.size(); ++e)
    for (std::size_t f = 0; f < e; ++f)
      EXPECT_EQ(edges[e].chain == edges[f].chain, set[e] == set[f]) << e << ' ' << f;
}

TEST(Seams, ChainsAreAsDocumented) {
  std::vector<SeamlessCase> cases;
  for (const Charts charts : {Charts::OnePerSquare, Charts::One, Charts::OneWithoutSlits})
    for (const Squares& s : {unit_cube(), square_torus(3, 4), holed_plate(2),
                             polycube({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}})})
      cases.push_back(squares_case(s, 2, charts));
  cases.push_back(squares_case(holed_plate(0), 3, Charts::ConeTree));
  for (int turns = 1; turns <= 8; ++turns) cases.push_back(fan_case(turns, 3));
  for (const SeamlessCase& c : cases)
    for (const unsigned seed : {1u, 2u, 3u}) expect_chains(shuffled(cut(c), seed));
}

TEST(Seams, ChainsFromAConeAndFromTheBoundaryToTheBoundary) {
  for (const int turns : {1, 2, 3, 5, 6, 7, 8}) {
    const CutSurface fan = cut(fan_case(turns, 4));
    EXPECT_EQ(fan.seams->chain_count(), 1);
    ASSERT_EQ(fan.seams->cones().size(), 1u);
    EXPECT_EQ(fan.seams->cones()[0].vertex, 0);
    EXPECT_EQ(fan.seams->cones()[0].quarter_turns, turns);
  }
  const CutSurface annulus = cut(fan_case(5, 4, 1));
  EXPECT_EQ(annulus.seams->chain_count(), 1);
  EXPECT_TRUE(annulus.seams->cones().empty());
  EXPECT_EQ(annulus.seams->edges()[0].turns % 2, 1);
}

// ---- Cuts without coordinates: all turns 0 ----

CutSurface plain_cut(const SurfaceMesh& mesh, const std::function<bool(Vector3, Vector3)>& on) {
  std::vector<char> is_cut(to_size(mesh.half_edge_count()), 0);
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    is_cut[h] = mesh.opposite(h) >= 0 && on(mesh.positions().row(mesh.from_vertex(h)),
                                            mesh.positions().row(mesh.to_vertex(h)));
  std::vector<int> quarter_turns(to_size(mesh.vertex_count()), 4);
  for (const auto& loop : mesh.boundary_loops())
    for (const Index v : loop) quarter_turns[v] = 0;
  return cut_open(mesh, is_cut, std::vector<int>(is_cut.size(), 0), quarter_turns);
}

Index rank_lost(const CutSurface& c, int degree) {
  const auto space =
      std::make_shared<const BezierTriangleSpace>(c.mesh->faces(), c.mesh->vertex_count(), degree);
  ConstraintRows rows;
  SeamlessConstraint(space, c.seams).append_rows(rows);
  const Elimination z(2 * space->node_count(), rows);
  return z.full_size() - z.reduced_size();
}

bool on_line(const Vector3& a, const Vector3& b, double y, double from, double to) {
  const auto on = [&](const Vector3& p) {
    return std::abs(p.y() - y) < 1e-9 && p.x() > from - 1e-9 && p.x() < to + 1e-9;
  };
  return on(a) && on(b);
}

TEST(Seams, AClosedChainWithoutANode) {
  const auto mesh = surface(torus(8, 6, 0));
  const auto in_plane = [](const Vector3& p) { return std::abs(p.y()) < 1e-9 && p.x() > 0; };
  const CutSurface c = plain_cut(
      *mesh, [&](const Vector3& a, const Vector3& b) { return in_plane(a) && in_plane(b); });
  EXPECT_EQ(c.seams->edges().size(), 6u);
  EXPECT_EQ(c.seams->chain_count(), 1);
  EXPECT_EQ(c.mesh->topology().boundary_loops, 2);
  for (const unsigned seed : {1u, 2u}) expect_chains(shuffled(c, seed));
  for (const int n : {1, 2, 3}) EXPECT_EQ(rank_lost(c, n), 2 * (6 * n - 1));
}

TEST(Seams, SlitsInsideAreClosedAgain) {
  const auto mesh = surface(grid(8));
  for (const int edges : {1, 2, 5}) {
    const CutSurface c = plain_cut(*mesh, [&](const Vector3& a, const Vector3& b) {
      return on_line(a, b, 0.5, 0.125, 0.125 * (1 + edges));
    });
    ASSERT_EQ(static_cast<int>(c.seams->edges().size()), edges);
    EXPECT_EQ(c.seams->chain_count(), 1);
    expect_chains(shuffled(c, 1));
    const Index copies = edges - 1;
    EXPECT_EQ(c.mesh->vertex_count(), mesh->vertex_count() + copies);
    for (const int n : {1, 2, 3}) {
      const BezierTriangleSpace closed(mesh->faces(), mesh->vertex_count(), n);
      const BezierTriangleSpace open(c.mesh->faces(), c.mesh->vertex_count(), n);
      EXPECT_EQ(rank_lost(c, n), 2 * (open.node_count() - closed.node_count()));
    }
  }
}

TEST(Seams, CutsFromTheBoundary) {
  const auto mesh = surface(grid(8));
  for (const int edges : {1, 3}) {  // ends in the interior
    const CutSurface c = plain_cut(*mesh, [&](const Vector3& a, const Vector3& b) {
      return on_line(a, b, 0.5, 0, 0.125 * edges);
    });
    EXPECT_EQ(c.seams->chain_count(), 1);
    for (const int n : {1, 2, 3}) EXPECT_EQ(rank_lost(c, n), 2 * edges * n);
  }
  const CutSurface halves = plain_cut(
      *mesh, [&](const Vector3& a, const Vector3& b) { return on_line(a, b, 0.5, 0, 1); });
  EXPECT_EQ(halves.mesh->topology().components, 2);
  EXPECT_EQ(halves.seams->chain_count(), 1);
  for (const int n : {1, 2, 3}) EXPECT_EQ(rank_lost(halves, n), 2 * 8 * n);
  // Two crossing lines: four chains, one node.
  const CutSurface cross = plain_cut(*mesh, [&](const Vector3& a, const Vector3& b) {
    const Vector3 c(a.y(), a.x(), 0), d(b.y(), b.x(), 0);
    return on_line(a, b, 0.5, 0, 1) || on_line(c, d, 0.5, 0, 1);
  });
  EXPECT_EQ(cross.seams->chain_count(), 4);
  EXPECT_EQ(cross.mesh->topology().components, 4);
  expect_chains(shuffled(cross, 5));
  for (const int n : {1, 2, 3}) EXPECT_EQ(rank_lost(cross, n), 2 * 16 * n);
}

TEST(Seams, NothingCut) {
  const auto mesh = surface(grid(3));
  const CutSurface c = plain_cut(*mesh, [](const Vector3&, const Vector3&) { return false; });
  EXPECT_TRUE(c.seams->empty());
  EXPECT_EQ(c.seams->chain_count(), 0);
  EXPECT_TRUE(c.seams->cones().empty());
  EXPECT_EQ(c.mesh->vertex_count(), mesh->vertex_count());
}

TEST(Seams, RotationsAreExact) {
  const Vector2 p(0.1, 0.7);
  for (int k = -9; k < 10; ++k) {
    EXPECT_EQ(rotated(rotated(p, k), -k), p);
    EXPECT_EQ(rotated(p, k), rotated(rotated(p, k - 1), 1));
  }
  EXPECT_EQ(rotated(p, 1), Vector2(-0.7, 0.1));
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
