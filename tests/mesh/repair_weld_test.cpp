// Vertices that are joined, and faces that get an area, by repair().
#include <random>

#include "mesh/repair_checks.h"
#include "mesh/surfaces_of_any_genus.h"

namespace majorant {
namespace {

PolygonMesh soup_of(const PolygonMesh& welded) {
  PolygonMesh soup = polygon_mesh({}, {});
  for (const auto& polygon : welded.polygons) {
    soup.polygons.emplace_back();
    for (const Index v : polygon) {
      soup.polygons.back().push_back(static_cast<Index>(soup.positions.size()));
      soup.positions.push_back(welded.positions[v]);
    }
  }
  return soup;
}

TEST(Repair, WeldsSoups) {
  const PolygonMesh soup = soup_of(torus(8, 6, 0));
  const RepairedSurface out = repaired(soup);
  EXPECT_EQ(shape_of(out), (Shape{1, 0, 0}));
  EXPECT_EQ(count_of(out, RepairKind::Welded), 3 * 96 - 48);
  EXPECT_EQ(out.mesh->vertex_count(), 48);
}

// A slit stays a slit, unless it is to be welded.
TEST(Repair, WeldsIndexedMeshesOnRequest) {
  const SurfaceMesh whole = SurfaceMesh::from_polygons(grid(4, bumpy));
  std::vector<char> flags(to_size(whole.half_edge_count()), 0);
  for (Index h = 0; h < whole.half_edge_count(); ++h)
    flags[h] = whole.positions()(whole.from_vertex(h), 0) == 0.5 &&
               whole.positions()(whole.to_vertex(h), 0) == 0.5;
  const SurfaceMesh cut = whole.cut_along(flags, nullptr);
  PolygonMesh slit = polygon_mesh({}, {});
  for (Index v = 0; v < cut.vertex_count(); ++v)
    slit.positions.emplace_back(cut.positions().row(v));
  for (Index f = 0; f < cut.face_count(); ++f)
    slit.polygons.push_back({cut.faces()(f, 0), cut.faces()(f, 1), cut.faces()(f, 2)});
  EXPECT_EQ(shape_of(repaired(slit)), (Shape{2, 2, 2}));
  EXPECT_TRUE(repaired(slit).repairs.empty());
  const RepairedSurface out = repaired(slit, {.weld = 0});
  EXPECT_EQ(shape_of(out), (Shape{1, 1, 1}));
  EXPECT_EQ(count_of(out, RepairKind::Welded), 5);
  EXPECT_EQ(std::count(out.given_cuts.begin(), out.given_cuts.end(), 1), 0);
  // Texture coordinates that differ across the slit make it a cut that was given; others do not.
  const auto side = [](const Vector3& p) { return p.x() < 0.5 ? 0 : 1; };
  const auto one = [](const Vector3&) { return 0; };
  RepairedSurface islands = repaired(textured(slit, side), {.weld = 0});
  EXPECT_EQ(std::count(islands.given_cuts.begin(), islands.given_cuts.end(), 1), 8);
  islands =
      repaired(textured(grid(4, bumpy), side), {.weld = 0});  // not welded: a seam of the file
  EXPECT_EQ(std::count(islands.given_cuts.begin(), islands.given_cuts.end(), 1), 0);
  islands = repaired(textured(slit, one), {.weld = 0});
  EXPECT_EQ(std::count(islands.given_cuts.begin(), islands.given_cuts.end(), 1), 0);

  for (std::size_t v = to_size(whole.vertex_count()); v < slit.positions.size(); ++v)
    slit.positions[v] += Vector3(3e-4, -3e-4, 3e-4);
  EXPECT_EQ(shape_of(repaired(slit, {.weld = 0})), (Shape{2, 2, 2}));
  EXPECT_EQ(shape_of(repaired(slit, {.weld = 5e-4})), (Shape{2, 2, 2}));
  const RepairedSurface near = repair(slit, {.weld = 6e-4});
  expect_repaired(slit, near, 6e-4);
  EXPECT_EQ(shape_of(near), (Shape{1, 1, 1}));
}

TEST(Repair, WeldsNoEdgeAway) {
  PolygonMesh mesh = grid(4, bumpy);
  mesh.positions[12] = mesh.positions[13];
  const RepairedSurface out = repaired(mesh, {.weld = 0});
  EXPECT_EQ(shape_of(out), (Shape{1, 1, 1}));
  EXPECT_EQ(count_of(out, RepairKind::Welded), 0);
  EXPECT_EQ(count_of(out, RepairKind::RegularizedFace), 2);
}

TEST(Repair, RegularizesFacesWithoutArea) {
  PolygonMesh mesh = grid(4);
  mesh.positions[12] = mesh.positions[13];                          // two faces
  mesh.positions[1] = (mesh.positions[0] + mesh.positions[2]) / 2;  // stays a corner
  mesh = both(mesh, polygon_mesh({{5, 0, 0}, {7, 0, 0}, {5.5, 0, 0}}, {{0, 1, 2}}));
  mesh = both(mesh, polygon_mesh({{9, 9, 9}, {9, 9, 9}, {9, 9, 9}}, {{0, 1, 2}}));
  const RepairedSurface out = repaired(mesh);
  EXPECT_EQ(count_of(out, RepairKind::RegularizedFace), 4);
  const auto& rest = out.mesh->rest_triangles();
  ASSERT_EQ(rest.size(), 4u);
  for (const RestTriangle& t : rest) {
    const auto& c = t.corners;
    EXPECT_GT(cross(c[1] - c[0], c[2] - c[0]), 0);
  }
  const auto& needle = rest[2].corners;  // the longest edge, and the foot where it was
  EXPECT_EQ(needle[0], Vector2(0, 0));
  EXPECT_EQ(needle[1], Vector2(2, 0));
  EXPECT_EQ(needle[2], Vector2(0.5, 2 * kNeedleHeight));
  EXPECT_GT((rest[3].corners[1] - rest[3].corners[0]).norm(), 0);
  // Area that a map can be measured by, of every piece.
  for (const SurfacePiece& piece : out.mesh->split()) EXPECT_GT(piece.mesh->area(), 0);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
