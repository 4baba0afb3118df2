// Creases by a file's groups, materials and normals.
#include "majorant/mesh/marked_creases.h"

#include <gtest/gtest.h>

#include "mesh/list_edits.h"
#include "mesh/test_meshes.h"

namespace majorant {
namespace {

// Returns the number of pairs of polygons with a crease between them.
int marked_edges(const PolygonMesh& polygons) {
  int count = 0;
  const RepairedSurface surface = repair(polygons);
  const std::vector<char> flags = marked_creases(polygons, surface);
  for (Index h = 0; h < surface.mesh->half_edge_count(); ++h) {
    const Index o = surface.mesh->opposite(h);
    EXPECT_EQ(flags[to_size(h)], o < 0 ? 0 : flags[to_size(o)]);
    count += flags[to_size(h)];
  }
  return count / 2;
}

// Returns a grid of 4 by 4 squares, two triangles each, in rows: 16 polygons in its first half.
PolygonMesh with_lines(std::vector<std::pair<Index, std::string>> lines) {
  PolygonMesh mesh = grid(4);
  mesh.directives = std::move(lines);
  return mesh;
}

TEST(MarkedCreases, NoneWithoutMarks) {
  EXPECT_EQ(marked_edges(grid(4)), 0);
  EXPECT_EQ(marked_edges(with_lines({{0, "g all"}, {16, "g other"}})), 0);
}

TEST(MarkedCreases, BetweenMaterials) {
  EXPECT_EQ(marked_edges(with_lines({{0, "usemtl a"}, {16, "usemtl b"}})), 4);
  EXPECT_EQ(marked_edges(with_lines({{16, "usemtl \t b "}})), 4);
  EXPECT_EQ(marked_edges(with_lines({{0, "usemtl a"}, {16, "usemtl b"}, {16, "usemtl a "}})), 0);
}

TEST(MarkedCreases, BetweenSmoothingGroups) {
  EXPECT_EQ(marked_edges(with_lines({{0, "s 1"}, {16, "s 2"}})), 4);
  EXPECT_EQ(marked_edges(with_lines({{0, "s off"}})), 0);  // all edges: flat shading
  // Only the last square is flat: its diagonal and its two sides inside the grid are marked.
  EXPECT_EQ(marked_edges(with_lines({{0, "s 1"}, {30, "s 0"}})), 3);
}

TEST(MarkedCreases, WhereNormalsAreSplit) {
  PolygonMesh mesh = grid(4);
  mesh.normals = {{0, 0, 1}, {0, 1, 1}, {0, 1e-4, 2}};
  const auto give_normals = [&](const std::function<Index(std::size_t)>& normal) {
    mesh.polygon_normals = {};
    for (std::size_t p = 0; p < mesh.polygons.size(); ++p)
      mesh.polygon_normals.push_back({normal(p), normal(p), normal(p)});
  };
  give_normals([](std::size_t p) { return p < 16 ? 0 : 1; });
  EXPECT_EQ(marked_edges(mesh), 4);
  give_normals([](std::size_t p) { return p < 16 ? 0 : 2; });
  EXPECT_EQ(marked_edges(mesh), 0);  // equal up to rounding
  give_normals([](std::size_t p) { return static_cast<Index>(p % 2); });
  EXPECT_EQ(marked_edges(mesh), 0);  // all edges: flat shading
  set_list(mesh.polygon_normals, 0, {});
  EXPECT_EQ(marked_edges(mesh), 0);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
