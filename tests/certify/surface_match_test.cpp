// The common interface of matching: first along edges, then by faces, and properties of both.
#include "majorant/certify/internal/surface_match.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace majorant {
namespace {

// Returns two non-coplanar triangles, the second of which may be reversed.
PolygonMesh two_triangles(bool is_turned) {
  PolygonMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 1}, {0, 1, 0}};
  mesh.polygons = {{0, 1, 2}, {0, 2, 3}};
  if (is_turned) mesh.polygons = {{0, 1, 2}, {0, 3, 2}};
  return mesh;
}

SurfaceMesh mesh_of(const PolygonMesh& cells) { return SurfaceMesh::from_polygons(cells); }

TEST(SurfaceMatch, AcceptsWhatEitherMethodAccepts) {
  const SurfaceMesh cells = mesh_of(two_triangles(false));
  const SurfaceMatch along_edges = match_surface({cells}, two_triangles(false));
  EXPECT_EQ(along_edges.defect, "");
  EXPECT_EQ(along_edges.same, 2);
  const SurfaceMatch by_faces = match_surface({cells}, two_triangles(true));
  EXPECT_EQ(by_faces.defect, "");
  EXPECT_EQ(by_faces.same, 2);
}

TEST(SurfaceMatch, NamesTheDefectOfTheMoreSpecificMethod) {
  PolygonMesh less = two_triangles(false);
  less.polygons = {{0, 1, 2}};
  const SurfaceMesh cells = mesh_of(less);
  EXPECT_EQ(match_surface({cells}, two_triangles(false)).defect,
            "face 1: no cell lies at its edge (0, 2), or it is turned over");
  EXPECT_EQ(match_surface({cells}, two_triangles(true)).defect,
            "face 1 is mapped by cells that are not its own, or turned over");
}

TEST(SurfaceMatch, VerticesAreNamedByNumberAndPlace) {
  PolygonMesh moved = two_triangles(false);
  moved.positions[3].z() += 1e-6;
  moved.positions.push_back({1, -1, 0});
  moved.polygons.push_back({0, 4, 1});
  const PolygonMesh surface = two_triangles(false);
  const std::vector<char> all(4, 1);
  const std::vector<Index> labels(3, 0);
  const SurfaceMesh cells = mesh_of(moved);
  const auto names = [&](const ShownCells& of, double close) {
    return name_vertices(of, surface, all, close);
  };
  EXPECT_EQ(names({cells}, 1e-7).defect, "vertex 3 is not where the surface has it");
  EXPECT_EQ(names({cells, labels}, 1e-5).defect, "the surface has no vertex 4");
  EXPECT_EQ(names({cells}, 1e-5).defect, "");
  EXPECT_EQ(names({cells}, 1e-5).of_cells, (std::vector<Index>{0, 1, 2, 3, NamedVertices::kNew}));
  const std::vector<char> without_3{1, 1, 1, 0};
  EXPECT_EQ(name_vertices({cells}, surface, without_3, 1e-7).of_cells[3], NamedVertices::kNew);
}

// Ten digits of the size, some spacings of the coordinates, and the precision of the file.
TEST(SurfaceMatch, DistancesGrowWithTheSurface) {
  PolygonMesh surface = two_triangles(false);
  const SurfaceMesh cells = mesh_of(surface);
  const double near_origin = match_distance({cells}, surface);
  EXPECT_NEAR(near_origin, 1e-9, 1e-13);
  EXPECT_NEAR(match_distance({.mesh = cells, .rounding = 0.5}, surface), 0.5, 1e-8);
  for (Vector3& p : surface.positions) p.x() += 1e8;
  EXPECT_GT(match_distance({cells}, surface), 10 * near_origin);
}

TEST(SurfaceMatch, AreaVectorsAreTheSumOfAFan) {
  const std::array<Vector3, 4> square{Vector3(0, 0, 5), Vector3(2, 0, 5), Vector3(2, 3, 5),
                                      Vector3(0, 3, 5)};
  EXPECT_EQ(area_vector(square), Vector3(0, 0, 6));
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
