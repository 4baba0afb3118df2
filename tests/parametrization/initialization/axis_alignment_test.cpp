// Edges parallel to an axis: ranks, values shared along lines, seams and pins.
#include <gtest/gtest.h>

#include "expected_error.h"
#include "majorant/constraints/constraints.h"
#include "majorant/framework/elimination.h"
#include "majorant/framework/error.h"
#include "parametrization/initialization/seamless_cases.h"
#include "support.h"

namespace majorant {
namespace {

using Space = std::shared_ptr<const BezierTriangleSpace>;

Elimination eliminated(const Space& space, const std::vector<const Constraint*>& constraints) {
  ConstraintRows rows;
  for (const Constraint* c : constraints) c->append_rows(rows);
  return Elimination(2 * space->node_count(), rows);
}

// Returns the boundary half-edges of an n by n grid on its lower (v constant) and left side (u
// constant).
std::vector<AlignedEdge> two_sides(const SurfaceMesh& mesh) {
  std::vector<AlignedEdge> out;
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    const Vector3 a = mesh.positions().row(mesh.from_vertex(h));
    const Vector3 b = mesh.positions().row(mesh.to_vertex(h));
    if (a.x() == 0 && b.x() == 0) out.push_back({h, 0});
    if (a.y() == 0 && b.y() == 0) out.push_back({h, 1});
  }
  return out;
}

TEST(AxisAlignment, KeepsOneValueAlongALine) {
  const auto mesh = surface(grid(6));
  test::Random random(2);
  for (const int n : {1, 2, 3, 5}) {
    const auto space =
        std::make_shared<const BezierTriangleSpace>(mesh->faces(), mesh->vertex_count(), n);
    const std::vector<AlignedEdge> edges = two_sides(*mesh);
    ASSERT_EQ(edges.size(), 12u);
    const AxisAlignment alignment(space, edges);
    const Elimination z = eliminated(space, {&alignment});
    EXPECT_EQ(z.rank(), 2 * 6 * n);
    Vec x;
    z.expand(random.vector(z.reduced_size()), x);
    for (const AlignedEdge& e : edges)
      for (const Index node : edge_nodes(*space, e.half_edge))
        EXPECT_EQ(x[2 * node + e.coordinate], x[e.coordinate]);  // vertex 0 is the corner
    for (Index i = 0; i < z.full_size(); ++i)
      for (const auto& q : z.row(i)) EXPECT_EQ(q.coefficient, 1.0);
    // Repeated edges, and both coordinates of one edge.
    const AxisAlignment again(space, edges);
    EXPECT_EQ(eliminated(space, {&alignment, &again}).rank(), z.rank());
  }
}

TEST(AxisAlignment, ComposesWithPinsAndNamesContradictions) {
  const auto mesh = surface(grid(6));
  const auto space =
      std::make_shared<const BezierTriangleSpace>(mesh->faces(), mesh->vertex_count(), 2);
  const AxisAlignment alignment(space, two_sides(*mesh));
  const FixedPoints fitting({{0, {0.25, 0.5}}, {3, {2, 0.5}}});
  const Elimination z = eliminated(space, {&alignment, &fitting});
  EXPECT_EQ(z.rank(), 2 * 12 + 3);
  Vec x;
  z.expand(Vec::Ones(z.reduced_size()), x);
  EXPECT_EQ(x[2 * 5 + 1], 0.5);
  const FixedPoints wrong({{0, {0.25, 0.5}}, {3, {2, 0.6}}});
  expect_contains(error_message(ErrorKind::Unsupported,
                                [&] {
                                  eliminated(space, {&alignment, &wrong});
                                }),
                  {"contradict", "v of node 3"});
  expect_contains(error_message(ErrorKind::Unsupported,
                                [&] {
                                  eliminated(space, {&wrong, &alignment});
                                }),
                  {"contradict", "constant v along edge (2, 3)"});
}

// The opposite side of a seam is aligned too, in the other coordinate if the seam turns.
TEST(AxisAlignment, SeamsCarryItOver) {
  for (const int turns : {5, 6, 7}) {
    const Start start = fan_case(turns, 3, 1).start();
    const Space space = start.map.shared_space();
    const SeamlessConstraint seams(space, start.map.shared_seams());
    std::vector<AlignedEdge> sides;
    for (const SeamEdge& e : start.map.seams().edges()) sides.push_back({e.side, 1});
    const AxisAlignment alignment(space, sides);
    const Elimination z = eliminated(space, {&seams, &alignment});
    EXPECT_EQ(z.full_size() - z.reduced_size(), eliminated(space, {&seams}).full_size() -
                                                    eliminated(space, {&seams}).reduced_size() + 2);
    test::Random random(3);
    Vec x;
    z.expand(random.vector(z.reduced_size()), x);
    for (const SeamEdge& e : start.map.seams().edges()) {
      const std::vector<Index> nodes = edge_nodes(*space, e.opposite);
      const int other = e.turns % 2 ? 0 : 1;
      EXPECT_NEAR(x[2 * nodes[0] + other], x[2 * nodes[1] + other], 1e-14);
    }
    // Requesting the opposite sides too adds no constraint.
    for (const SeamEdge& e : start.map.seams().edges())
      sides.push_back({e.opposite, e.turns % 2 ? 0 : 1});
    const AxisAlignment both(space, sides);
    EXPECT_EQ(eliminated(space, {&seams, &both}).reduced_size(), z.reduced_size());
    EXPECT_EQ(eliminated(space, {&both, &seams}).reduced_size(), z.reduced_size());
  }
}

TEST(AxisAlignment, ProjectionIsTheClosestPoint) {
  const auto mesh = surface(grid(5));
  const auto space =
      std::make_shared<const BezierTriangleSpace>(mesh->faces(), mesh->vertex_count(), 2);
  const AxisAlignment alignment(space, two_sides(*mesh));
  const FixedPoints pin({{2, {0.5, 0.25}}});
  const Elimination z = eliminated(space, {&alignment, &pin});
  test::Random random(8);
  const Vec x = random.vector(z.full_size());
  Vec closest, normal;
  z.expand(z.project(x), closest);
  z.restrict_gradient(x - closest, normal);
  EXPECT_LE(normal.norm(), 1e-9 * (x - closest).norm());
  EXPECT_EQ(z.project(closest), z.reduce(closest, nullptr));
}

TEST(AxisAlignment, RefusesEdgesThatDoNotExist) {
  const auto mesh = surface(grid(2));
  const auto space =
      std::make_shared<const BezierTriangleSpace>(mesh->faces(), mesh->vertex_count(), 1);
  for (const AlignedEdge& e : {AlignedEdge{-1, 0}, AlignedEdge{24, 0}, AlignedEdge{0, 2}})
    EXPECT_THROW(AxisAlignment(space, {e}), InvalidArgument);
  const AxisAlignment none(space, {});
  EXPECT_EQ(eliminated(space, {&none}).rank(), 0);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
