#include "majorant/certify/internal/edge_match.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesh/list_edits.h"

namespace majorant {
namespace {

// Returns quads over 3 x 3 vertices of the unit square, numbered by row, curved so that no two
// quads are coplanar.
PolygonMesh quads(double bend) {
  PolygonMesh mesh;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i)
      mesh.positions.emplace_back(i, j, bend * (i * i + 3 * j * j + i * j));
  for (const Index a : {0, 1, 3, 4}) mesh.polygons.push_back({a, a + 1, a + 4, a + 3});
  return mesh;
}

PolygonMesh triangles(double bend) {
  PolygonMesh mesh = quads(bend);
  mesh.polygons.clear();
  for (const Index a : {0, 1, 3, 4}) {
    mesh.polygons.push_back({a, a + 1, a + 4});
    mesh.polygons.push_back({a, a + 4, a + 3});
  }
  return mesh;
}

SurfaceMatch match(const PolygonMesh& cells, const PolygonMesh& surface,
                   const std::vector<Index>& labels = {}) {
  return match_along_edges({SurfaceMesh::from_polygons(cells, {}, Components::Any), labels},
                           surface);
}

// A quad with a reflex corner and a convex texture: SurfaceMesh selects the diagonal that the
// texture allows, although it inverts a triangle in space.
TEST(EdgeMatch, DiagonalsOfTheTexture) {
  PolygonMesh surface;
  surface.positions = {{0, 0, 0}, {2, 0, 0.1}, {0.4, 0.4, 0}, {0, 2, 0.1}};
  surface.polygons = {{0, 1, 2, 3}};
  PolygonMesh cells = surface;
  cells.polygons = {{0, 1, 3}, {1, 2, 3}};
  EXPECT_NE(match(cells, surface).defect, "");
  surface.texcoords = {{0, 0}, {1, 0}, {0.2, 0.2}, {0, 1}};  // as in space
  surface.polygon_texcoords = {{0, 1, 2, 3}};
  EXPECT_NE(match(cells, surface).defect, "");
  surface.texcoords = {{0, 0}, {0.8, 0.5}, {2, 0}, {1, 2}};  // reflex at the second corner
  EXPECT_EQ(match(cells, surface).defect, "");
}

// Products of areas underflow.
TEST(EdgeMatch, TinySurfaces) {
  for (const double size : {1e-60, 1e-90, 1e-140}) {
    PolygonMesh surface = quads(0.1), cells = surface;
    for (PolygonMesh* mesh : {&surface, &cells})
      for (Vector3& p : mesh->positions) p *= size;
    cells.polygons.clear();
    for (const auto& q : surface.polygons) {
      cells.polygons.push_back({q[0], q[1], q[3]});
      cells.polygons.push_back({q[1], q[2], q[3]});
    }
    EXPECT_EQ(match(cells, surface).defect, "") << size;
    swap_lists(cells.polygons, 0, 1);
    EXPECT_EQ(match(cells, surface).defect, "") << size;
  }
}

// Faces declared to be without cells need no cells, and must not have any.
TEST(EdgeMatch, FacesThatAreNotMapped) {
  for (const PolygonMesh& surface : {triangles(0.1), quads(0.1)}) {
    PolygonMesh cells = triangles(0.1);
    const bool is_quads = surface.polygons.size() == 4;
    std::vector<char> unmapped(surface.polygons.size(), 0);
    unmapped[1] = 1;
    const auto match_part = [&](const PolygonMesh& part) {
      return match_along_edges(
          {.mesh = SurfaceMesh::from_polygons(part, {}, Components::Any), .unmapped = unmapped},
          surface);
    };
    EXPECT_NE(match_part(cells).defect, "");
    IndexLists left;
    for (std::size_t c = 0; c < cells.polygons.size(); ++c)
      if (is_quads ? c / 2 != 1 : c != 1) left.push_back(cells.polygons[c]);
    cells.polygons = left;
    EXPECT_NE(match(cells, surface).defect, "");
    EXPECT_EQ(match_part(cells).defect, "");
    IndexLists fewer;
    fewer.push_back(left[0]);
    cells.polygons = fewer;
    EXPECT_NE(match_part(cells).defect, "");
  }
}

TEST(EdgeMatch, TheSameFacesInAnyOrder) {
  const PolygonMesh surface = triangles(0.1);
  PolygonMesh cells = surface;
  swap_lists(cells.polygons, 0, 5);
  std::rotate(cells.polygons[2].begin(), cells.polygons[2].begin() + 1, cells.polygons[2].end());
  const SurfaceMatch same = match(cells, surface);
  EXPECT_EQ(same.defect, "");
  EXPECT_EQ(same.same, 8);
  EXPECT_EQ(same.changed, 0);
}

TEST(EdgeMatch, PolygonsInAnyTriangles) {
  PolygonMesh cells = triangles(0.1);
  EXPECT_EQ(match(cells, quads(0.1)).defect, "");
  set_list(cells.polygons, 0, {0, 1, 3});  // the other diagonal of the first quad
  set_list(cells.polygons, 1, {1, 4, 3});
  EXPECT_EQ(match(cells, quads(0.1)).defect, "");
  EXPECT_EQ(match(cells, quads(0.1)).same, 4);
  // On a curved surface of triangles the other diagonal is another surface; in a plane it is the
  // same.
  EXPECT_NE(match(cells, triangles(0.1)).defect, "");
  PolygonMesh flat = triangles(0);
  flat.polygons = cells.polygons;
  EXPECT_EQ(match(flat, triangles(0)).defect, "");
  EXPECT_EQ(match(flat, triangles(0)).changed, 2);
}

TEST(EdgeMatch, FacesCutIntoPieces) {
  const PolygonMesh surface = triangles(0.1);
  PolygonMesh cells = surface;
  // Edge (0, 4) of faces 0 and 1 gets a vertex at one third.
  cells.positions.push_back(cells.positions[0] / 3 * 2 + cells.positions[4] / 3);
  set_list(cells.polygons, 0, {0, 1, 9});
  set_list(cells.polygons, 1, {0, 9, 3});
  cells.polygons.push_back({1, 4, 9});
  cells.polygons.push_back({9, 4, 3});
  EXPECT_EQ(match(cells, surface).defect, "");
  EXPECT_EQ(match(cells, surface).changed, 2);
  PolygonMesh moved = cells;
  moved.positions[9].x() += 1e-6;
  EXPECT_NE(match(moved, surface).defect, "");
  moved = cells;  // folded over its own face: the vertex is beyond edge (1, 4)
  moved.positions[9] = moved.positions[4] + 0.5 * (moved.positions[4] - moved.positions[0]);
  EXPECT_NE(match(moved, surface).defect, "");
}

// Both sides of a slit have the same position; each is followed to its own end.
TEST(EdgeMatch, SlitsAreFollowedOnTheirOwnSide) {
  PolygonMesh surface;  // a fan around 0, open along the edges (0, 1) and (0, 5)
  surface.positions.emplace_back(0, 0, 0);
  for (const auto& [x, y] : {std::pair(1, 0), {0, 1}, {-1, 0}, {0, -1}, {1, 0}})
    surface.positions.emplace_back(x, y, 0);
  for (Index k = 1; k < 5; ++k) surface.polygons.push_back({0, k, k + 1});
  PolygonMesh cells = surface;
  for (const double t : {0.5, 0.25, 0.75}) cells.positions.emplace_back(t, 0, 0);
  set_list(cells.polygons, 0, {0, 6, 2});  // 6 is the midpoint of (0, 1)
  cells.polygons.push_back({6, 1, 2});
  set_list(cells.polygons, 3, {4, 7, 0});  // (0, 5) has vertices at one quarter and three quarters
  cells.polygons.push_back({4, 8, 7});
  cells.polygons.push_back({4, 5, 8});
  EXPECT_EQ(match(cells, surface).defect, "");
  EXPECT_EQ(match(cells, surface).changed, 2);
}

TEST(EdgeMatch, DefectsAreNamed) {
  const PolygonMesh surface = triangles(0.1);
  PolygonMesh cells = surface;
  cells.polygons.resize(7);
  EXPECT_NE(match(cells, surface).defect.find("face 7"), std::string::npos);
  cells = surface;
  for (const auto polygon : cells.polygons) std::swap(polygon[0], polygon[1]);
  EXPECT_NE(match(cells, surface).defect.find("turned over"), std::string::npos);
  cells = surface;
  cells.positions[4].z() += 1e-3;
  EXPECT_EQ(match(cells, surface).defect, "vertex 4 is not where the surface has it");
  cells = surface;
  cells.positions.emplace_back(3, 0, 0);
  cells.polygons.push_back({1, 2, 9});
  std::swap(cells.polygons.back()[0], cells.polygons.back()[1]);
  EXPECT_NE(match(cells, surface).defect, "");  // a face beyond the boundary
}

// Area vectors with the sum 0 define no plane in which to compare.
TEST(EdgeMatch, FoldedSheetsHaveNoPlane) {
  PolygonMesh surface;  // folded along edge (0, 1)
  surface.positions = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.25, 1.0, 0.0}, {0.75, 1.0, 0.0}};
  surface.polygons = {{0, 1, 2}, {1, 0, 3}};
  PolygonMesh cells = surface;
  cells.polygons = {{0, 3, 2}, {3, 1, 2}};
  EXPECT_NE(match(cells, surface).defect, "");
}

// The wrong diagonal of a planar concave quad inverts a triangle.
TEST(EdgeMatch, TheWrongDiagonalOfAConcaveQuad) {
  PolygonMesh surface;
  surface.positions = {{0, 0, 0}, {4, -4, 0}, {1, 0, 0}, {4, 4, 0}};
  surface.polygons = {{0, 1, 2, 3}};
  PolygonMesh cells = surface;
  cells.polygons = {{0, 1, 2}, {0, 2, 3}};
  EXPECT_EQ(match(cells, surface).defect, "");
  cells.polygons = {{0, 1, 3}, {1, 2, 3}};
  EXPECT_NE(match(cells, surface).defect.find("turned over"), std::string::npos);
}

// Parts of non-planar polygons lie on the triangles that SurfaceMesh makes of them.
TEST(EdgeMatch, PiecesOfBentPolygons) {
  const PolygonMesh surface = quads(0.1);
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(surface);
  PolygonMesh cells;
  cells.positions = surface.positions;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const Index a = mesh.faces()(f, 0), b = mesh.faces()(f, 1), c = mesh.faces()(f, 2);
    const auto middle = static_cast<Index>(cells.positions.size());
    cells.positions.push_back((cells.positions[static_cast<std::size_t>(a)] +
                               cells.positions[static_cast<std::size_t>(b)] +
                               cells.positions[static_cast<std::size_t>(c)]) /
                              3);
    for (const auto& [p, q] : {std::pair(a, b), {b, c}, {c, a}})
      cells.polygons.push_back({p, q, middle});
  }
  EXPECT_EQ(match(cells, surface).defect, "");
}

// Chains of many vertices on one edge, and a surface far from the origin.
TEST(EdgeMatch, LongChainsAndFarAway) {
  for (const auto& [far, count] : {std::pair(0.0, 20000), {1e6, 7}}) {
    PolygonMesh surface;
    surface.positions = {{far, far, 0}, {far + 1, far, 0}, {far, far + 1, 0}};
    surface.polygons = {{0, 1, 2}};
    PolygonMesh cells = surface;
    cells.polygons.clear();
    for (Index k = 1; k < count; ++k)
      cells.positions.emplace_back(far + static_cast<double>(k) / count, far, 0);
    for (Index k = 0; k < count; ++k)
      cells.polygons.push_back({k == 0 ? 0 : k + 2, k + 1 == count ? 1 : k + 3, 2});
    EXPECT_EQ(match(cells, surface).defect, "");
  }
}

TEST(EdgeMatch, LabelsMustFit) {
  const PolygonMesh surface = triangles(0.1);
  std::vector<Index> labels = {0, 1, 2, 3, 4, 5, 6, 7};
  EXPECT_EQ(match(surface, surface, labels).defect, "");
  std::swap(labels[1], labels[6]);
  EXPECT_NE(match(surface, surface, labels).defect.find("is said to belong"), std::string::npos);
}

TEST(EdgeMatch, SeveralComponents) {
  PolygonMesh surface = triangles(0.1);
  const auto shift = static_cast<Index>(surface.positions.size());
  for (int v = 0; v < shift; ++v)
    surface.positions.push_back(surface.positions[static_cast<std::size_t>(v)] + Vector3(9, 0, 0));
  append_lists(surface.polygons, surface.polygons, shift);
  EXPECT_EQ(match(surface, surface).defect, "");
  PolygonMesh half = surface;
  half.polygons.resize(8);
  EXPECT_NE(match(half, surface).defect, "");
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
