// Tutte's start where means of neighbours coincide in doubles: exact signs are positive
// nevertheless, also after a translation of the map.
#include <algorithm>
#include <array>

#include "expected_error.h"
#include "majorant/mesh/exact_predicates.h"
#include "majorant/parametrization/initialization/area_margin.h"
#include "majorant/parametrization/initialization/internal/weighted_tutte.h"
#include "majorant/parametrization/initialization/start.h"
#include "majorant/parametrization/initialization/strip_unfolding.h"
#include "mesh/test_meshes.h"

namespace majorant {
namespace {

Index not_positive(const SurfaceMesh& mesh, const Vec& uv) {
  Index count = 0;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto point = [&](Index k) -> Vector2 { return uv.segment<2>(2 * mesh.faces()(f, k)); };
    count += orientation(point(0), point(1), point(2)) <= 0;
  }
  return count;
}

// Also after a translation that takes the first vertex to the origin.
void expect_positive(const SurfaceMesh& mesh) {
  Vec uv = tutte_map(mesh);
  EXPECT_EQ(not_positive(mesh, uv), 0);
  const Vector2 first = uv.head<2>();
  for (Index k = 0; k < uv.size(); k += 2) uv.segment<2>(k) -= first;
  EXPECT_EQ(not_positive(mesh, uv), 0) << "moved";
}

enum class Diagonals { Equal, Mixed };

// Returns rings with the given numbers of vertices, one above the other, closed by a last vertex.
PolygonMesh capped_rings(const std::vector<Index>& sizes, Diagonals diagonals) {
  std::vector<Vector3> positions;
  std::vector<std::vector<Index>> faces, rings;
  for (std::size_t j = 0; j < sizes.size(); ++j) {
    rings.emplace_back();
    for (Index i = 0; i < sizes[j]; ++i) {
      const double t = 2 * kPi * i / sizes[j], r = sizes[j] / 4.0;
      rings.back().push_back(static_cast<Index>(positions.size()));
      positions.push_back({r * std::cos(t), r * std::sin(t), static_cast<double>(j)});
    }
  }
  for (std::size_t j = 0; j + 1 < rings.size(); ++j) {
    const auto &a = rings[j], &b = rings[j + 1];
    for (std::size_t i = 0, k = 0; i < a.size() || k < b.size();) {
      const std::size_t left = (i + 1) * b.size(), right = (k + 1) * a.size();
      const bool second = diagonals == Diagonals::Mixed && (i * 7 + j * 3) % 5 < 2;
      if (k >= b.size() || (i < a.size() && (left < right || (left == right && second))))
        faces.push_back({a[i % a.size()], a[(i + 1) % a.size()], b[k % b.size()]}), ++i;
      else
        faces.push_back({a[i % a.size()], b[(k + 1) % b.size()], b[k % b.size()]}), ++k;
    }
  }
  const auto tip = static_cast<Index>(positions.size());
  positions.push_back({0, 0, static_cast<double>(sizes.size())});
  const auto& last = rings.back();
  for (std::size_t i = 0; i < last.size(); ++i)
    faces.push_back({last[i], last[(i + 1) % last.size()], tip});
  return polygon_mesh(std::move(positions), std::move(faces));
}

TEST(NarrowStarts, CappedTubes) {
  for (const Index sides : {3, 4, 5, 6, 8})
    for (const std::size_t rings : {12, 30, 60, 150})
      for (const Diagonals diagonals : {Diagonals::Equal, Diagonals::Mixed}) {
        SCOPED_TRACE(testing::Message() << sides << " sides, " << rings << " rings");
        expect_positive(*surface(capped_rings(std::vector<Index>(rings, sides), diagonals)));
      }
}

// A bulb at the end of a tube: its rings are wide, and leaning would move neighbours onto each
// other.
TEST(NarrowStarts, BulbOnATube) {
  std::vector<Index> sizes(50, 4);
  for (Index k = 1; k <= 25; ++k) sizes.push_back(4 + 6 * std::min<Index>(k, 25 - k));
  expect_positive(*surface(capped_rings(sizes, Diagonals::Equal)));
}

TEST(NarrowStarts, FanOfTenThousand) { expect_positive(*surface(cone(10000, true))); }

TEST(NarrowStarts, ThousandsOfBoundaryVertices) {
  std::vector<Vector3> positions;
  std::vector<std::vector<Index>> faces;
  for (int k = 0; k <= 3000; ++k)
    for (const double y : {0.0, 1.0}) positions.push_back({static_cast<double>(k), y, 0});
  for (Index k = 0; k < 3000; ++k) {
    faces.push_back({2 * k, 2 * k + 2, 2 * k + 3});
    faces.push_back({2 * k, 2 * k + 3, 2 * k + 1});
  }
  expect_positive(*surface(polygon_mesh(std::move(positions), std::move(faces))));
}

// An ear with two edges of 1e-8 of the loop: its corners are collinear on a circle by arc length.
TEST(NarrowStarts, TinyBoundaryEdges) {
  const double e = 4e-8;
  const PolygonMesh mesh =
      polygon_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-e, 0, 0}, {-e / 2, -e / 2, 0}},
                   {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}});
  expect_positive(*surface(mesh));
}

TEST(NarrowStarts, FarFromTheOrigin) {
  PolygonMesh mesh = grid(6, bumpy);
  for (Vector3& p : mesh.positions) p = 6e-3 * p + Vector3(2e4, -2e4, 2e4);
  expect_positive(*surface(mesh));
}

TEST(NarrowStarts, HolesStayOpen) {
  // A tube without its tip, which ends in a hole.
  PolygonMesh tube = capped_rings(std::vector<Index>(60, 4), Diagonals::Mixed);
  tube.polygons.resize(tube.polygons.size() - 4);
  const auto open = surface(tube);
  ASSERT_EQ(open->topology().boundary_loops, 2);
  expect_positive(*open);
}

// A strip bent into a zigzag is straight in the plane, and every edge keeps its length.
TEST(Unfolding, StripsKeepTheirLengths) {
  PolygonMesh zigzag;
  constexpr Index kQuads = 3000;
  for (Index k = 0; k <= kQuads; ++k)
    for (const double width : {0.0, 0.01})
      zigzag.positions.emplace_back(0.6 * static_cast<double>(k), width, k % 2 == 0 ? 0 : 0.8);
  for (Index v = 0; v < 2 * kQuads; v += 2) zigzag.polygons.push_back({v, v + 2, v + 3, v + 1});
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(zigzag);
  const Vec uv = unfolded(mesh);
  EXPECT_EQ(not_positive(mesh, uv), 0);
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    const Vector2 edge =
        uv.segment<2>(2 * mesh.to_vertex(h)) - uv.segment<2>(2 * mesh.from_vertex(h));
    EXPECT_NEAR(edge.norm(), mesh.edge_length(h), 1e-9);
  }
}

TEST(Room, CountsFacesThatAreTooFlat) {
  Cells faces(2, 3);
  faces << 0, 1, 2, 0, 2, 3;
  Vec uv(8);
  uv << 0, 0, 1, 0, 1, 1e-16, 0, 1;
  EXPECT_EQ(faces_without_area_margin(faces, uv), 1);
  uv[5] = 1e-13;
  EXPECT_EQ(faces_without_area_margin(faces, uv), 0);
  uv[5] = -1e-13;
  EXPECT_EQ(faces_without_area_margin(faces, uv), 1);
}

TEST(LeaningMap, LeavesRingsTheirRadius) {
  const auto mesh = surface(capped_rings(std::vector<Index>(60, 4), Diagonals::Equal));
  std::vector<char> held(to_size(mesh->vertex_count()), 0);
  Vec x = Vec::Zero(2 * mesh->vertex_count());
  const std::array<Vector2, 4> square{Vector2(1, 0), Vector2(0, 1), Vector2(-1, 0), Vector2(0, -1)};
  for (std::size_t k = 0; k < 4; ++k) {
    held[k] = 1;
    x.segment<2>(2 * static_cast<Index>(k)) = square[k];
  }
  x = weighted_tutte(mesh->faces(), held, x, 1, "none");
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_EQ(Vector2(x.segment<2>(2 * static_cast<Index>(k))), square[k]);
  const double last = x.segment<2>(2 * (mesh->vertex_count() - 2)).norm();
  EXPECT_GT(last, 0.2);
  EXPECT_LT(last, 0.8);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
