// Half-edge functions against their definitions: corners, edges found by both vertices, loops by
// steps along edges, components and fans by brute force.
#include <gtest/gtest.h>

#include <set>

#include "majorant/framework/error.h"
#include "majorant/mesh/surface_mesh.h"
#include "mesh/list_edits.h"
#include "mesh/test_meshes.h"

namespace majorant {
namespace {

Cells cells_of(const std::vector<std::array<Index, 3>>& faces) {
  Cells cells(static_cast<Index>(faces.size()), 3);
  for (std::size_t f = 0; f < faces.size(); ++f)
    cells.row(static_cast<Index>(f)) << faces[f][0], faces[f][1], faces[f][2];
  return cells;
}

Cells faces_of(const PolygonMesh& mesh) {
  std::vector<std::array<Index, 3>> faces;
  for (const auto& p : mesh.polygons) faces.push_back({p[0], p[1], p[2]});
  return cells_of(faces);
}

// Returns disks, an annulus, a torus with and without a hole, two components.
std::vector<Cells> surfaces() {
  PolygonMesh annulus = grid(5);
  erase_lists(annulus.polygons, 24, 2);
  PolygonMesh two = torus(5, 4, 0);
  append_lists(two.polygons, grid(2).polygons, 20);
  return {cells_of({{0, 1, 2}}),    faces_of(grid(3)),        faces_of(annulus),
          faces_of(torus(6, 5, 0)), faces_of(torus(6, 5, 2)), faces_of(two)};
}

TEST(HalfEdge, GoesAroundItsFace) {
  for (Index f = 0; f < 4; ++f)
    for (Index k = 0; k < 3; ++k) {
      const Index h = 3 * f + k;
      EXPECT_EQ(face_of(h), f);
      EXPECT_EQ(corner_of(h), k);
      EXPECT_EQ(next(h), 3 * f + (k + 1) % 3);
      EXPECT_EQ(previous(h), 3 * f + (k + 2) % 3);
    }
  const Cells faces = cells_of({{7, 8, 9}, {9, 8, 3}});
  const Index from[6] = {7, 8, 9, 9, 8, 3}, to[6] = {8, 9, 7, 8, 3, 9};
  for (Index h = 0; h < 6; ++h) {
    EXPECT_EQ(from_vertex(faces, h), from[h]);
    EXPECT_EQ(to_vertex(faces, h), to[h]);
  }
}

TEST(HalfEdge, OppositesRunAgainstEachOther) {
  for (const Cells& faces : surfaces()) {
    const std::vector<Index> opposite = opposite_half_edges(faces);
    const auto count = static_cast<Index>(3 * faces.rows());
    ASSERT_EQ(opposite.size(), to_size(count));
    for (Index h = 0; h < count; ++h) {
      Index expected = -1;
      for (Index o = 0; o < count; ++o)
        if (from_vertex(faces, h) == to_vertex(faces, o) &&
            to_vertex(faces, h) == from_vertex(faces, o))
          expected = o;
      EXPECT_EQ(opposite[h], expected);
    }
  }
}

TEST(HalfEdge, RefusesEdgesThatAreNotManifold) {
  const Cells three = cells_of({{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
  EXPECT_THROW(opposite_half_edges(three), InvalidArgument);
  const Cells same_way = cells_of({{0, 1, 2}, {0, 1, 3}});
  EXPECT_THROW(opposite_half_edges(same_way), InvalidArgument);
}

TEST(HalfEdge, BoundaryIsWalkedOnceFromTheSmallestVertices) {
  std::vector<std::size_t> loop_counts;
  for (const Cells& faces : surfaces()) {
    const std::vector<Index> opposite = opposite_half_edges(faces);
    const auto loops = boundary_half_edges(faces, opposite);
    loop_counts.push_back(loops.size());
    std::set<Index> met;
    Index last = -1;
    for (const auto& loop : loops) {
      EXPECT_GT(from_vertex(faces, loop.front()), last);
      last = from_vertex(faces, loop.front());
      for (std::size_t k = 0; k < loop.size(); ++k) {
        EXPECT_LT(opposite[loop[k]], 0);
        EXPECT_TRUE(met.insert(loop[k]).second);
        EXPECT_EQ(to_vertex(faces, loop[k]), from_vertex(faces, loop[(k + 1) % loop.size()]));
        EXPECT_GE(from_vertex(faces, loop[k]), last);
      }
    }
    EXPECT_EQ(met.size(),
              to_size(static_cast<Index>(std::count(opposite.begin(), opposite.end(), -1))));
  }
  EXPECT_EQ(loop_counts, (std::vector<std::size_t>{1, 1, 2, 0, 1, 1}));
}

TEST(HalfEdge, ComponentsAreNumberedByTheirFirstFaces) {
  // Three strips, interleaved in the list of faces; the first and the last touch in vertex 2 only.
  const Cells faces =
      cells_of({{0, 1, 2}, {1, 0, 5}, {10, 11, 12}, {5, 0, 7}, {2, 3, 4}, {12, 11, 13}, {4, 3, 6}});
  EXPECT_EQ(face_components(opposite_half_edges(faces)), (std::vector<Index>{0, 0, 1, 0, 2, 1, 2}));
  EXPECT_TRUE(face_components({}).empty());
}

TEST(HalfEdge, FindsVerticesWhereSheetsTouch) {
  const auto touching = [](const Cells& faces) {
    return find_touching_vertex(faces, opposite_half_edges(faces));
  };
  for (const Cells& faces : surfaces()) EXPECT_EQ(touching(faces), -1);
  EXPECT_EQ(touching(cells_of({{0, 1, 2}, {2, 3, 4}})), 2);
  EXPECT_EQ(touching(cells_of({{9, 1, 7}, {7, 3, 4}, {4, 5, 9}})), 4);  // a ring: the smallest of 3
  // A closed surface and a triangle; two closed surfaces.
  const std::vector<std::array<Index, 3>> tetrahedron{{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {0, 2, 3}};
  auto more = tetrahedron;
  more.push_back({3, 8, 9});
  EXPECT_EQ(touching(cells_of(more)), 3);
  more = tetrahedron;
  for (auto face : tetrahedron) {
    for (Index& v : face) v = v == 1 ? 1 : v + 10;
    more.push_back(face);
  }
  EXPECT_EQ(touching(cells_of(more)), 1);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
