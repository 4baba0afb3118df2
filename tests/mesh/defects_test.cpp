// Every defect is reported by name, count and place, and nothing else is.
#include "expected_error.h"
#include "majorant/mesh/repair.h"
#include "mesh/list_edits.h"
#include "mesh/surfaces_of_any_genus.h"

namespace majorant {
namespace {

std::map<std::string, Index> counts(const PolygonMesh& mesh) {
  std::map<std::string, Index> counts;
  for (const Defect& d : find_defects(mesh).defects) {
    EXPECT_TRUE(counts.emplace(name_of(d.kind), d.count).second);
    EXPECT_GT(d.count, 0);
    EXPECT_FALSE(describe(d).empty());
  }
  return counts;
}
using Counts = std::map<std::string, Index>;

PolygonMesh quads(int n) {  // of the unit square
  PolygonMesh mesh = grid(n);
  mesh.polygons.clear();
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const Index a = j * (n + 1) + i;
      mesh.polygons.push_back({a, a + 1, a + n + 2, a + n + 1});
    }
  return mesh;
}

TEST(Defects, GoodMeshesHaveNone) {
  for (const PolygonMesh& mesh : {grid(4), quads(5), torus(8, 6, 1), cube_sphere(3)})
    EXPECT_TRUE(counts(mesh).empty());
}

TEST(Defects, AreCountedAllOfThem) {
  PolygonMesh mesh = grid(6, bumpy);
  mesh.positions.push_back({0.5, 0.5, 3});  // 49: a fin on the edge (8, 16)
  mesh.positions.push_back({9, 9, 9});      // 50: no face
  mesh.positions.push_back({2, 0, 0});      // 51, 52: an ear at corner 6
  mesh.positions.push_back({2, -1, 0});
  mesh.polygons.push_back({8, 16, 49});
  mesh.polygons.push_back({6, 52, 51});
  mesh.polygons.push_back(mesh.polygons[40]);
  mesh.polygons.push_back({0, 1, 1});
  std::swap(mesh.polygons[20][0], mesh.polygons[20][1]);
  mesh.positions[31] = mesh.positions[32];  // two faces
  EXPECT_EQ(counts(mesh), (Counts{{"non_manifold_edge", 1},
                                  {"non_manifold_vertex", 1},
                                  {"duplicate_face", 1},
                                  {"repeated_vertex", 1},
                                  {"inconsistent_face", 1},
                                  {"zero_area", 3},
                                  {"coincident_vertices", 1},
                                  {"isolated_vertex", 1}}));
  for (const Defect& d : find_defects(mesh).defects) {
    const std::string text = describe(d);
    if (d.kind == DefectKind::NonManifoldEdge) {
      EXPECT_EQ(text, "1 edge has more than two faces (edge (9, 17))");
    }
    if (d.kind == DefectKind::NonManifoldVertex) expect_contains(text, {"(vertex 7)"});
    if (d.kind == DefectKind::InconsistentFace) expect_contains(text, {"(face 21)"});
    if (d.kind == DefectKind::DuplicateFace) expect_contains(text, {"(face 75)"});
    if (d.kind == DefectKind::IsolatedVertex) expect_contains(text, {"(vertex 51)"});
  }
}

TEST(Defects, NeedlesAreNotWithoutArea) {
  for (const auto& [height, name] :
       std::map<double, std::string>{{1e-9, "needle"}, {1e-14, "zero_area"}})
    EXPECT_EQ(counts(polygon_mesh({{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {1, -height, 0}},
                                  {{0, 1, 2}, {0, 3, 1}})),
              (Counts{{name, 1}}));
}

TEST(Defects, PolygonsThatCrossThemselves) {
  EXPECT_EQ(counts(polygon_mesh({{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {2, 1, 0}}, {{0, 1, 2, 3}})),
            (Counts{{"crossing_polygon", 1}}));
}

TEST(Defects, SoupsAndOffsets) {
  PolygonMesh soup = polygon_mesh({}, {});
  const PolygonMesh whole = grid(3);
  for (const auto& polygon : whole.polygons) {
    const auto first = static_cast<Index>(soup.positions.size());
    for (const Index v : polygon) soup.positions.push_back(whole.positions[v]);
    soup.polygons.push_back({first, first + 1, first + 2});
  }
  EXPECT_EQ(counts(soup), (Counts{{"soup", 1}}));
  PolygonMesh far = grid(3);
  for (Vector3& p : far.positions) p += Vector3(0, 1e9, 0);
  EXPECT_EQ(counts(far), (Counts{{"far_from_origin", 1}}));
}

// A coarse grid beside a fine one: fine vertices lie on coarse edges, in any direction of the
// edges.
TEST(Defects, FindsTJunctions) {
  for (const int fine : {2, 3, 16, 64}) {
    PolygonMesh mesh = quads(fine);
    const PolygonMesh coarse = quads(2);
    const auto first = static_cast<Index>(mesh.positions.size());
    for (const Vector3& p : coarse.positions) mesh.positions.push_back(p + Vector3(1, 0, 0));
    append_lists(mesh.polygons, coarse.polygons, first);
    for (Vector3& p : mesh.positions)
      p = Vector3(0.6 * p.x() - 0.64 * p.y(), 0.8 * p.x() + 0.48 * p.y(), 0.6 * p.y());
    const Index odd = fine % 2;  // then the midpoint of the coarse side lies on a fine edge, too
    const Index on_coarse = fine - 1 - (odd ? 0 : 1);
    EXPECT_EQ(counts(mesh)["t_junction"], on_coarse + odd) << fine;
  }
}

TEST(Defects, OneSidedComponentsAreCutNotTurned) {
  PolygonMesh strip = polygon_mesh({}, {});
  constexpr int kN = 12;
  for (int k = 0; k < kN; ++k)
    for (const double w : {-0.3, 0.3}) {
      const double t = 2 * kPi * k / kN, r = 1 + w * std::cos(t / 2);
      strip.positions.push_back({r * std::cos(t), r * std::sin(t), w * std::sin(t / 2)});
    }
  for (int k = 0; k < kN; ++k) {
    const bool last = k == kN - 1;
    strip.polygons.push_back({2 * k, last ? 1 : 2 * k + 2, last ? 0 : 2 * k + 3, 2 * k + 1});
  }
  EXPECT_EQ(counts(strip), (Counts{{"one_sided", 1}}));
  EXPECT_EQ(describe(find_defects(strip).defects[0]),
            "1 component has one side only (cut along edge (1, 2))");
}

TEST(Defects, SumsUpComponents) {
  PolygonMesh mesh = torus(8, 6, 0);
  const auto first = static_cast<Index>(mesh.positions.size());
  const PolygonMesh ring = grid_without(6, {7, 10});
  for (const Vector3& p : ring.positions) mesh.positions.push_back(p + Vector3(9, 0, 0));
  append_lists(mesh.polygons, ring.polygons, first);
  const std::vector<ComponentShape> shapes = find_defects(mesh).components;
  ASSERT_EQ(shapes.size(), 2u);
  EXPECT_EQ(shapes[0].genus(), 1);
  EXPECT_EQ(shapes[0].boundary_loops, 0);
  EXPECT_EQ(shapes[0].faces, 96);
  EXPECT_EQ(shapes[1].genus(), 0);
  EXPECT_EQ(shapes[1].first_face, 96);
  EXPECT_EQ(shapes[1].boundary_loops, 3);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
