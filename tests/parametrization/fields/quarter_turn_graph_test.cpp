// Moves of quarter turns, and the cleanup of cones by such moves.
#include "majorant/parametrization/fields/internal/quarter_turn_graph.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "majorant/parametrization/fields/internal/cone_cleanup.h"
#include "mesh/surfaces_of_any_genus.h"

namespace majorant {
namespace {

const std::vector<char> kNoFace;

// Returns a random field.
FieldConnection rough_field(const SurfaceMesh& mesh, const FieldGeometry& geometry) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Vec angle(mesh.face_count());
  for (double& value : angle) value = uniform(random);
  return nearest_matching(mesh, geometry, angle);
}

int distance_from_regular(const SurfaceMesh& mesh, const FieldGeometry& geometry,
                          const FieldConnection& field) {
  int sum = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if (!geometry.is_boundary[v]) sum += std::abs(field.quarter_turns[v] - 4);
  return sum;
}

TEST(QuarterTurnGraph, MovesPassOneTurnAndTheirChangeIsThatOfTheCones) {
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(cube_sphere(4));
  const FieldGeometry geometry(mesh);
  FieldConnection field = rough_field(mesh, geometry);
  QuarterTurnGraph graph(mesh, geometry, kNoFace, {}, 1, field);
  for (const Index h : {0, 7, 50, 121}) {
    const std::vector<int> before = field.quarter_turns;
    const int cones = distance_from_regular(mesh, geometry, field);
    const int change = graph.change(graph.start(h), graph.end(h));
    graph.move(h);
    EXPECT_EQ(graph.turns(graph.start(h)), before[mesh.from_vertex(h)] - 1);
    EXPECT_EQ(graph.turns(graph.end(h)), before[mesh.to_vertex(h)] + 1);
    EXPECT_EQ(distance_from_regular(mesh, geometry, field) - cones, change);
    EXPECT_EQ(count_quarter_turns(mesh, geometry, field.rotation), field.quarter_turns);
  }
}

TEST(QuarterTurnGraph, SendsOverAsFewEdgesAsAllowed) {
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(cube_sphere(6));
  const FieldGeometry geometry(mesh);
  FieldConnection field = rough_field(mesh, geometry);
  QuarterTurnGraph graph(mesh, geometry, kNoFace, {}, 1, field);
  const Index from = 0, goal = mesh.vertex_count() - 1;
  const std::vector<int> before = field.quarter_turns;
  EXPECT_FALSE(graph.send(
      from, 1, [&](Index w) { return w == goal; }, 1));
  EXPECT_EQ(field.quarter_turns, before);
  EXPECT_TRUE(graph.send(from, 1, [&](Index w) { return w == goal; }));
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    EXPECT_EQ(field.quarter_turns[v] - before[v], (v == goal) - (v == from));
  EXPECT_TRUE(graph.send(from, -1, [&](Index w) { return w == goal; }));
  EXPECT_EQ(field.quarter_turns, before);
}

TEST(QuarterTurnGraph, FixedFacesKeepTheirMatching) {
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(grid(3));
  const FieldGeometry geometry(mesh);
  FieldConnection field = rough_field(mesh, geometry);
  std::vector<char> is_fixed(to_size(mesh.face_count()), 0);
  is_fixed[0] = is_fixed[1] = 1;
  const QuarterTurnGraph graph(mesh, geometry, is_fixed, {}, 1, field);
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    const Index o = mesh.opposite(h);
    EXPECT_EQ(graph.is_movable(h), o >= 0 && !(is_fixed[face_of(h)] && is_fixed[face_of(o)]));
  }
}

TEST(ConeCleanup, LeavesNoNodeOutOfItsBoundsAndNoPairBesideEachOther) {
  for (const PolygonMesh& input : {cube_sphere(4), torus(12, 8, 0), grid(6, bumpy)}) {
    const SurfaceMesh mesh = SurfaceMesh::from_polygons(input);
    const FieldGeometry geometry(mesh);
    FieldConnection field = rough_field(mesh, geometry);
    const int before = distance_from_regular(mesh, geometry, field);
    const int sum = std::accumulate(field.quarter_turns.begin(), field.quarter_turns.end(), 0);
    optimize_cones(mesh, geometry, kNoFace, {}, 2, field);
    EXPECT_LT(distance_from_regular(mesh, geometry, field), before);
    if (mesh.boundary_loops().empty()) {
      EXPECT_EQ(std::accumulate(field.quarter_turns.begin(), field.quarter_turns.end(), 0), sum);
    }
    EXPECT_EQ(count_quarter_turns(mesh, geometry, field.rotation), field.quarter_turns);
    const QuarterTurnGraph graph(mesh, geometry, kNoFace, {}, 2, field);
    for (const Index v : graph.nodes()) {
      EXPECT_EQ(graph.excess(v), 0);
      for (const Index h : graph.leaving(v)) EXPECT_GE(graph.change(v, graph.end(h)), 0);
    }
  }
}

// With at least four quarter turns at every vertex, a torus has no cones.
TEST(ConeCleanup, BringsNodesToTheirLeastTurns) {
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(torus(12, 8, 0));
  const FieldGeometry geometry(mesh);
  FieldConnection field = rough_field(mesh, geometry);
  // One cone of one quarter turn, and a distant one of seven.
  QuarterTurnGraph graph(mesh, geometry, kNoFace, {}, 1, field);
  for (int k = 0; k < 3; ++k) ASSERT_TRUE(graph.send(0, 1, [](Index w) { return w == 50; }));
  optimize_cones(mesh, geometry, kNoFace, {}, 4, field);
  for (const int turns : field.quarter_turns) EXPECT_EQ(turns, 4);
  EXPECT_EQ(count_quarter_turns(mesh, geometry, field.rotation), field.quarter_turns);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
