// Every defect is refused as Unsupported, in one line with file, place and reason.
#include <algorithm>

#include "expected_error.h"
#include "mesh/list_edits.h"
#include "mesh/obj_file.h"
#include "mesh/test_meshes.h"

namespace majorant {
namespace {

std::string refusal(const PolygonMesh& mesh) {
  return error_message(ErrorKind::Unsupported, [&] { SurfaceMesh::from_polygons(mesh); });
}

std::string disk_refusal(const PolygonMesh& mesh) {
  const SurfaceMesh surface = SurfaceMesh::from_polygons(mesh);
  return error_message(ErrorKind::Unsupported, [&] { surface.require_disk(); });
}

TEST(MeshValidation, AcceptsADisk) {
  for (const PolygonMesh& mesh : {grid(4), grid(3, bumpy), cone(5, true), cone(5, false)})
    EXPECT_NO_THROW(SurfaceMesh::from_polygons(mesh).require_disk());
  for (const char* name : {"cap", "creature", "ribbon", "tube", "wavy_disk"})
    EXPECT_NO_THROW(generated(name)->require_disk()) << name;
}

TEST(MeshValidation, AcceptsAllFacesReversed) {
  PolygonMesh mesh = grid(4, bumpy);
  reverse_lists(mesh.polygons);
  EXPECT_NO_THROW(SurfaceMesh::from_polygons(mesh).require_disk());
}

TEST(MeshValidation, RefusesCollinearCorners) {
  const PolygonMesh mesh =
      polygon_mesh({{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {1, 0, 0}}, {{0, 1, 2}, {0, 3, 1}});
  expect_contains(refusal(mesh),
                  {"inline.obj:102: face 2", "zero area", "1, 4, 2", "repair() measures it"});
}

TEST(MeshValidation, RefusesCoincidentCorners) {
  PolygonMesh mesh = grid(4);
  mesh.positions[12] = mesh.positions[13];
  expect_contains(refusal(mesh), {"inline.obj:1", "zero area", "13", "14"});
}

TEST(MeshValidation, AcceptsASliverThatIsNotDegenerate) {
  const auto sliver = [](double height) {
    return polygon_mesh({{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {1, -height, 0}}, {{0, 1, 2}, {0, 3, 1}});
  };
  EXPECT_NO_THROW(SurfaceMesh::from_polygons(sliver(1e-9)));
  expect_contains(refusal(sliver(1e-14)), {"face 2", "zero area"});
}

TEST(MeshValidation, DegeneracyDoesNotDependOnScale) {
  for (const double scale : {1e-9, 1e-6, 1e6, 1e9}) {
    PolygonMesh mesh = grid(3, bumpy);
    for (Vector3& p : mesh.positions) p *= scale;
    EXPECT_NO_THROW(SurfaceMesh::from_polygons(mesh)) << scale;
    mesh.positions[5] = 0.5 * (mesh.positions[0] + mesh.positions[4]);
    set_list(mesh.polygons, 0, {0, 5, 4});
    set_list(mesh.polygons, 1, {0, 1, 5});
    EXPECT_THROW(SurfaceMesh::from_polygons(mesh), Error) << scale;
  }
}

TEST(MeshValidation, RefusesAVertexTwiceInAFace) {
  PolygonMesh mesh = grid(4);
  mesh.polygons.push_back({0, 1, 1});
  mesh.polygon_lines.push_back(133);
  expect_contains(refusal(mesh), {"inline.obj:133: face 33", "a vertex occurs twice"});
}

TEST(MeshValidation, RefusesAFaceTwice) {
  for (const std::vector<Index>& again : {std::vector<Index>{0, 1, 6}, {6, 0, 1}, {6, 1, 0}}) {
    PolygonMesh mesh = grid(4);
    mesh.polygons.push_back(again);
    mesh.polygon_lines.push_back(133);
    expect_contains(refusal(mesh), {"inline.obj:133: face 33", "twice"});
  }
}

TEST(MeshValidation, RefusesAnEdgeWithThreeFaces) {
  PolygonMesh mesh = grid(4);
  mesh.positions.push_back({0.5, 0.5, 1});
  mesh.polygons.push_back({6, 12, 25});
  mesh.polygon_lines.push_back(133);
  expect_contains(refusal(mesh),
                  {"inline.obj:133: face 33", "edge (7, 13)", "more than two faces"});
}

TEST(MeshValidation, RefusesSheetsThatTouchInAVertex) {
  const PolygonMesh bow_tie = polygon_mesh(
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}, {{0, 1, 2}, {0, 3, 4}});
  expect_contains(refusal(bow_tie),
                  {"inline.obj", "vertex 1:", "non-manifold", "repair() duplicates"});

  // Two distant corners of one sheet become one vertex.
  PolygonMesh pinched = grid(4);
  for (Index& v : pinched.polygons.indices())
    if (v == 24) v = 0;
  expect_contains(refusal(pinched), {"inline.obj", "vertex 1:", "non-manifold"});
}

// Both fans are closed: no boundary half-edge is at the vertex.
TEST(MeshValidation, RefusesSheetsThatTouchInAnInteriorVertex) {
  PolygonMesh mesh = cone(6, true);
  const PolygonMesh other = cone(6, true);
  for (const Vector3& p : other.positions) mesh.positions.push_back(p + Vector3(0, 0, 3));
  for (const auto polygon : other.polygons) {
    mesh.polygons.push_back(polygon);
    for (Index& v : mesh.polygons.back()) v = v == 0 ? 0 : v + 7;
    mesh.polygon_lines.push_back(101 + static_cast<long>(mesh.polygon_lines.size()));
  }
  expect_contains(refusal(mesh), {"inline.obj", "vertex 1:", "non-manifold"});
}

// The vertex has its number in the file, also if other vertices are left out.
TEST(MeshValidation, NamesVerticesAsTheFileDoes) {
  const PolygonMesh mesh =
      polygon_mesh({{9, 9, 9}, {0, 0, 0}, {8, 8, 8}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}},
                   {{1, 3, 4}, {1, 5, 6}});
  expect_contains(refusal(mesh), {"vertex 2:"});
}

TEST(MeshValidation, RefusesAFlippedFace) {
  PolygonMesh mesh = grid(4);
  std::swap(mesh.polygons[10][0], mesh.polygons[10][1]);
  expect_contains(refusal(mesh), {"inline.obj:1", "face ", "inconsistent orientation", "turns"});
}

TEST(MeshValidation, RefusesAMoebiusStrip) {
  constexpr int n = 12;
  std::vector<Vector3> positions;
  for (int k = 0; k < n; ++k)
    for (const double w : {-0.3, 0.3}) {
      const double t = 2 * kPi * k / n, r = 1 + w * std::cos(t / 2);
      positions.push_back({r * std::cos(t), r * std::sin(t), w * std::sin(t / 2)});
    }
  std::vector<std::vector<Index>> faces;
  for (int k = 0; k < n; ++k) {
    const bool last = k == n - 1;
    const Index a = 2 * k, b = a + 1, c = last ? 1 : a + 2, d = last ? 0 : a + 3;
    faces.push_back({a, c, b});
    faces.push_back({b, c, d});
  }
  expect_contains(refusal(polygon_mesh(positions, faces)),
                  {"inline.obj:1", "face ", "not orientable", "edge ("});
}

TEST(MeshValidation, RefusesTwoComponents) {
  PolygonMesh mesh = grid(4);
  const PolygonMesh other = grid(2);
  for (const Vector3& p : other.positions) mesh.positions.push_back(p + Vector3(5, 0, 0));
  append_lists(mesh.polygons, other.polygons, 25);
  for (std::size_t k = mesh.polygon_lines.size(); k < mesh.polygons.size(); ++k)
    mesh.polygon_lines.push_back(101 + static_cast<long>(k));
  expect_contains(refusal(mesh), {"inline.obj:133: face 33", "2 components", "repair()"});
}

TEST(MeshValidation, RefusesSoup) {
  const PolygonMesh welded = grid(3);
  PolygonMesh soup = polygon_mesh({}, {});
  for (const auto& polygon : welded.polygons) {
    const auto first = static_cast<Index>(soup.positions.size());
    for (const Index v : polygon) soup.positions.push_back(welded.positions[v]);
    soup.polygons.push_back({first, first + 1, first + 2});
    soup.polygon_lines.push_back(101);
  }
  expect_contains(refusal(soup), {"inline.obj", "18 faces", "soup", "merge"});
}

TEST(MeshValidation, RefusesCoordinatesWithoutDigits) {
  PolygonMesh mesh = grid(4, bumpy);
  for (Vector3& p : mesh.positions) p += Vector3(1e12, -1e12, 1e12);
  expect_contains(refusal(mesh), {"inline.obj:1", "face ", "e+12", "moves the mesh"});
}

TEST(MeshValidation, AcceptsAModerateOffset) {
  PolygonMesh mesh = grid(4, bumpy);
  for (Vector3& p : mesh.positions) p += Vector3(1e4, 0, 0);
  EXPECT_NO_THROW(SurfaceMesh::from_polygons(mesh));
}

TEST(MeshValidation, AClosedSurfaceIsNoDisk) {
  const PolygonMesh tetrahedron = polygon_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                               {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
  expect_contains(disk_refusal(tetrahedron),
                  {"inline.obj", "closed", "genus 0", "unwrap() cuts it open"});
  expect_contains(disk_refusal(torus(8, 6, 0)), {"inline.obj", "closed", "genus 1", "cut"});
}

TEST(MeshValidation, AnAnnulusIsNoDisk) {
  PolygonMesh mesh = grid(4);
  erase_lists(mesh.polygons, 10, 2);  // quad (1, 1)
  mesh.polygon_lines.resize(30);
  // The hole's smallest vertex is 6, counted from 1: 7.
  expect_contains(disk_refusal(mesh),
                  {"inline.obj", "2 boundary loops", "vertex 7", "with its holes"});
}

TEST(MeshValidation, GenusOneWithOneLoopIsNoDisk) {
  expect_contains(disk_refusal(torus(8, 6, 1)), {"inline.obj", "genus 1", "one boundary loop"});
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
