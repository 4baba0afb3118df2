// Triangles that need no repair give the result of repair(); others give no result.
#include "majorant/mesh/sound_surface.h"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

#include "majorant/mesh/repair.h"

namespace majorant {
namespace {

using Triangles = std::vector<std::vector<Index>>;

PolygonMesh mesh_of(std::vector<Vector3> positions, Triangles triangles) {
  PolygonMesh mesh;
  mesh.positions = std::move(positions);
  mesh.polygons = std::move(triangles);
  return mesh;
}

// Every vertex is used.
SurfaceParts parts_of(const PolygonMesh& mesh) {
  SurfaceParts parts;
  parts.positions.resize(static_cast<Index>(mesh.positions.size()), 3);
  for (Index v = 0; v < parts.positions.rows(); ++v) parts.positions.row(v) = mesh.positions[v];
  parts.faces.resize(static_cast<Index>(mesh.polygons.size()), 3);
  for (Index f = 0; f < parts.faces.rows(); ++f)
    for (Index k = 0; k < 3; ++k) parts.faces(f, k) = mesh.polygons[f][k];
  parts.input_vertex.resize(mesh.positions.size());
  parts.input_face.resize(mesh.polygons.size());
  std::iota(parts.input_vertex.begin(), parts.input_vertex.end(), 0);
  std::iota(parts.input_face.begin(), parts.input_face.end(), 0);
  return parts;
}

RepairedSurface by_repair(const PolygonMesh& mesh) {
  return repair(mesh, {.orientation = Orientation::AsGiven, .numerics = Numerics::AsGiven});
}

const std::vector<Vector3> kSquare = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
const std::vector<Vector3> kTetrahedron = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

TEST(SoundSurface, EqualsTheRepairedSurface) {
  std::vector<Vector3> two = kSquare;
  for (const Vector3& p : kSquare) two.push_back(p + Vector3(0, 0, 7));
  for (const PolygonMesh& mesh :
       {mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}),
        mesh_of(kSquare, {{0, 1, 2}, {0, 2, 3}}),
        mesh_of(kTetrahedron, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}),
        mesh_of(two, {{5, 6, 4}, {0, 1, 2}, {0, 2, 3}, {4, 6, 7}})}) {
    const auto sound = sound_surface(parts_of(mesh));
    ASSERT_TRUE(sound);
    const RepairedSurface expected = by_repair(mesh);
    ASSERT_TRUE(expected.repairs.empty());
    EXPECT_EQ(sound->faces(), expected.mesh->faces());
    EXPECT_EQ(sound->positions(), expected.mesh->positions());
    EXPECT_EQ(sound->opposites(), expected.mesh->opposites());
    EXPECT_EQ(sound->boundary_loops(), expected.mesh->boundary_loops());
    EXPECT_EQ(sound->topology().components, expected.mesh->topology().components);
    EXPECT_EQ(sound->area(), expected.mesh->area());
    for (Index v = 0; v < sound->vertex_count(); ++v)
      EXPECT_EQ(sound->input_vertex(v), expected.mesh->input_vertex(v));
  }
}

TEST(SoundSurface, LeavesTheOthersToRepair) {
  const std::vector<Vector3> three = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<Vector3> five = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  std::vector<Vector3> soup = three;
  for (const Vector3& p : three) soup.push_back(p + Vector3(5, 0, 0));
  for (const PolygonMesh& mesh :
       {mesh_of(three, {{0, 1, 2}, {0, 2, 1}}),               // a face and its reverse
        mesh_of(three, {{0, 1, 2}, {0, 1, 2}}),               // the same face
        mesh_of(kSquare, {{0, 1, 2}, {0, 3, 2}}),             // opposite orientations
        mesh_of(five, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}),     // three at an edge
        mesh_of(five, {{0, 1, 2}, {0, 3, 4}}),                // sheets that touch
        mesh_of(kSquare, {{0, 1, 2}, {0, 2, 3}, {3, 2, 2}}),  // a repeated vertex
        mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {2, 0, 0}}, {{0, 1, 2}, {1, 0, 3}}),  // area 0
        mesh_of(soup, {{0, 1, 2}, {3, 4, 5}})})
    EXPECT_FALSE(sound_surface(parts_of(mesh))) << mesh.polygons.size();
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
