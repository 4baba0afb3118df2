// Vertices welded and faces given an area by repair().
#include <functional>
#include <map>
#include <random>

#include "expected_error.h"
#include "mesh/list_edits.h"
#include "mesh/repair_checks.h"
#include "mesh/surfaces_of_any_genus.h"

namespace majorant {
namespace {

PolygonMesh soup_of(const PolygonMesh& welded) {
  PolygonMesh soup = polygon_mesh({}, {});
  for (const auto& polygon : welded.polygons) {
    soup.polygons.push_back(polygon);
    for (Index& v : soup.polygons.back()) {
      soup.positions.push_back(welded.positions[v]);
      v = static_cast<Index>(soup.positions.size()) - 1;
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

// Returns the number of half-edges on seams.
std::ptrdiff_t seam_sides(const RepairedSurface& out) {
  return std::count(out.texture_seams.begin(), out.texture_seams.end(), 1);
}

// Returns the mesh with separate vertices for polygons of different numbers.
PolygonMesh split_by(const PolygonMesh& whole, const std::function<Index(std::size_t)>& part) {
  PolygonMesh split = polygon_mesh({}, {});
  std::map<std::pair<Index, Index>, Index> copies;
  for (std::size_t p = 0; p < whole.polygons.size(); ++p) {
    split.polygons.push_back(whole.polygons[p]);
    for (Index& v : split.polygons.back()) {
      const auto [copy, is_new] = copies.try_emplace({part(p), v}, copies.size());
      if (is_new) split.positions.push_back(whole.positions[v]);
      v = copy->second;
    }
  }
  return split;
}

constexpr RepairOptions kJoined = {.welding = Welding::EqualPlaces};

TEST(Repair, JoinsSplitVertices) {
  const PolygonMesh whole = torus(8, 6, 0);
  for (const Index parts : {2, 5}) {
    const PolygonMesh split =
        split_by(whole, [&](std::size_t p) { return static_cast<Index>(p) % parts; });
    EXPECT_NE(shape_of(repaired(split)), (Shape{1, 0, 0}));
    const RepairedSurface out = repaired(split, kJoined);
    EXPECT_EQ(shape_of(out), (Shape{1, 0, 0})) << parts;
    EXPECT_EQ(out.mesh->vertex_count(), 48);
    ASSERT_EQ(out.repairs.size(), 1u);
    EXPECT_EQ(out.repairs[0].kind, RepairKind::Welded);
    EXPECT_EQ(to_size(out.repairs[0].count), split.positions.size() - 48);
    ASSERT_TRUE(out.repairs[0].pieces);
    EXPECT_EQ((*out.repairs[0].pieces)[1], 1);
    EXPECT_GT((*out.repairs[0].pieces)[0], 1);
    EXPECT_EQ(shape_of(repaired(split, {.welding = Welding::Nothing})), shape_of(repaired(split)));
  }
  EXPECT_EQ(shape_of(repaired(soup_of(whole), kJoined)), (Shape{1, 0, 0}));
  EXPECT_EQ(shape_of(repaired(soup_of(whole), {.welding = Welding::Nothing})), (Shape{96, 96, 96}));
}

// A sheet and its reversed copy, each of several faces, divided or not, are two sheets.
TEST(Repair, JoinsNoSheetWithItsBack) {
  const PolygonMesh front = grid(3, bumpy);
  PolygonMesh back = front;
  reverse_lists(back.polygons);
  const PolygonMesh card = both(front, back);
  const std::size_t faces = front.polygons.size();
  for (const Index parts : {1, 2, 3}) {
    const auto part = [&](std::size_t p) {
      return static_cast<Index>(p % faces) % parts + (p < faces ? 0 : parts);
    };
    EXPECT_EQ(shape_of(repaired(split_by(card, part), kJoined)), (Shape{2, 2, 2})) << parts;
  }
  // Quads over the same corners, for either diagonal.
  const PolygonMesh quads = polygon_mesh({{0, 0, 0},
                                          {1, 0, 0},
                                          {1, 1, 0},
                                          {0, 1, 0},
                                          {0, 1, 0},
                                          {1, 1, 0},
                                          {1, 0, 0},
                                          {0, 0, 0},
                                          {3, 0, 0}},
                                         {{0, 1, 2, 3}, {5, 6, 7, 4}, {0, 8, 1}});
  EXPECT_EQ(repaired(quads, kJoined).mesh->topology().components, 2);
}

// Three walls that meet in an edge, each with its own vertices; one of them has two copies.
TEST(Repair, JoinsNoThirdFaceToAnEdge) {
  const PolygonMesh walls = polygon_mesh({{0, 0, 0},
                                          {0, 0, 1},
                                          {1, 0, 0},
                                          {0, 0, 0},
                                          {0, 0, 1},
                                          {0, 1, 0},
                                          {0, 0, 0},
                                          {0, 0, 1},
                                          {0, -1, 0},
                                          {9, 9, 9}},
                                         {{0, 1, 2}, {4, 3, 5}, {7, 6, 8}, {2, 1, 9}});
  EXPECT_EQ(repaired(walls, kJoined).mesh->topology().components, 3);
  PolygonMesh two = walls;
  erase_lists(two.polygons, 2, 1);
  two.positions[8] = two.positions[7] = two.positions[6] = {7, 7, 7};
  EXPECT_EQ(repaired(two, kJoined).mesh->topology().components, 1);
}

// A slit stays open unless welding is requested.
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
  EXPECT_EQ(seam_sides(out), 0);
  // Different texture coordinates across the slit make it a seam; equal ones do not, whatever their
  // indices.
  const auto side = [](const Vector3& p) { return p.x() < 0.5 ? 0 : 1; };
  const auto one = [](const Vector3&) { return 0; };
  EXPECT_EQ(seam_sides(repaired(textured(slit, side), {.weld = 0})), 8);
  EXPECT_EQ(seam_sides(repaired(textured(grid(4, bumpy), side), {.weld = 0})), 8);
  EXPECT_EQ(seam_sides(repaired(textured(slit, one), {.weld = 0})), 0);

  for (std::size_t v = to_size(whole.vertex_count()); v < slit.positions.size(); ++v)
    slit.positions[v] += Vector3(3e-4, -3e-4, 3e-4);
  EXPECT_EQ(shape_of(repaired(slit, {.weld = 0})), (Shape{2, 2, 2}));
  EXPECT_EQ(shape_of(repaired(slit, {.weld = 5e-4})), (Shape{2, 2, 2}));
  const RepairedSurface near = repair(slit, {.weld = 6e-4});
  expect_repaired(slit, near, 6e-4);
  EXPECT_EQ(shape_of(near), (Shape{1, 1, 1}));
}

TEST(Repair, DescribesOneOrSeveralPieces) {
  const auto text = [](Index before) {
    return describe({RepairKind::Welded, 1, {{0, -1}}, std::array<Index, 2>{before, 1}});
  };
  expect_contains(text(1), {": 1 piece before, 1 after"});
  expect_contains(text(2), {": 2 pieces before, 1 after"});
}

// A weld distance above the size of most faces would destroy faces; the proposed distance does not.
TEST(Repair, RefusesToWeldAcrossFaces) {
  const PolygonMesh mesh = grid(8, bumpy);
  for (const double distance : {0.2, 1.0, 1e6, 1e300}) {
    const std::string text =
        error_message(ErrorKind::Unsupported, [&] { repair(mesh, {.weld = distance}); });
    expect_contains(text, {"edges of 0.1", "such as 0.01"});
  }
  for (const double distance : {0.01, 0.1})
    EXPECT_EQ(shape_of(repair(mesh, {.weld = distance})), (Shape{1, 1, 1}));
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
  const auto& needle = rest[2].corners;  // the longest edge, and the former foot of the altitude
  EXPECT_EQ(needle[0], Vector2(0, 0));
  EXPECT_EQ(needle[1], Vector2(2, 0));
  EXPECT_EQ(needle[2], Vector2(0.5, 2 * kNeedleHeight));
  EXPECT_GT((rest[3].corners[1] - rest[3].corners[0]).norm(), 0);
  // Each component has an area sufficient for measures of maps.
  for (const SurfacePiece& piece : out.mesh->split()) EXPECT_GT(piece.mesh->area(), 0);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
