// Cut graphs make a disk of every surface, pass through the required vertices, and end only there.
#include "majorant/mesh/cut_graph.h"

#include <algorithm>
#include <random>

#include "expected_error.h"
#include "mesh/surfaces_of_any_genus.h"
#include "public_data.h"

namespace majorant {
namespace {

double cut_length(const SurfaceMesh& mesh, const std::vector<char>& is_cut) {
  double length = 0;
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    if (is_cut[h])
      length += 0.5 * (mesh.positions().row(mesh.to_vertex(h)) -
                       mesh.positions().row(mesh.from_vertex(h)))
                          .norm();
  return length;
}

// Returns the number of cut edges at every vertex.
std::vector<int> cut_valences(const SurfaceMesh& mesh, const std::vector<char>& is_cut) {
  std::vector<int> valence(to_size(mesh.vertex_count()), 0);
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    if (is_cut[h]) ++valence[mesh.from_vertex(h)];
  return valence;
}

std::vector<char> boundary_flags(const SurfaceMesh& mesh) {
  std::vector<char> flags(to_size(mesh.vertex_count()), 0);
  for (const auto& loop : mesh.boundary_loops())
    for (const Index v : loop) flags[v] = 1;
  return flags;
}

// Expects all properties stated by the header, except the length.
void expect_proper_cut(const SurfaceMesh& mesh, const std::vector<Index>& through,
                       const std::vector<char>& is_cut) {
  ASSERT_EQ(is_cut.size(), to_size(mesh.half_edge_count()));
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    const Index o = mesh.opposite(h);
    EXPECT_EQ(is_cut[h], o < 0 ? 0 : is_cut[o]);
  }
  std::vector<Index> surface_vertex;
  const SurfaceMesh cut = mesh.cut_along(is_cut, &surface_vertex);
  EXPECT_NO_THROW(cut.require_disk());
  const std::vector<int> valence = cut_valences(mesh, is_cut);
  const std::vector<char> on_boundary = boundary_flags(mesh);
  std::vector<char> allowed_end = on_boundary;
  for (const Index v : through) {
    allowed_end[v] = 1;
    EXPECT_TRUE(valence[v] > 0 || on_boundary[v]) << v;
  }
  const bool slit = mesh.boundary_loops().empty() && mesh.topology().euler_characteristic() == 2 &&
                    through.size() < 3;
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if (valence[v] == 1) {
      EXPECT_TRUE(slit || allowed_end[v]) << v;
    }
}

std::vector<Index> some_vertices(const SurfaceMesh& mesh, int count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Index> all(to_size(mesh.vertex_count()));
  for (Index v = 0; v < mesh.vertex_count(); ++v) all[v] = v;
  std::shuffle(all.begin(), all.end(), random);
  all.resize(std::min(all.size(), static_cast<std::size_t>(count)));
  return all;
}

TEST(CutGraph, MakesADiskOfEverySurface) {
  for (const auto& [name, input] : surfaces_of_any_genus()) {
    const SurfaceMesh mesh = SurfaceMesh::from_polygons(input);
    for (const int count : {0, 1, 2, 3, 8, 40, mesh.vertex_count()})
      for (const unsigned seed : {1u, 2u, 3u}) {
        SCOPED_TRACE(name + ", " + std::to_string(count) + " vertices, " + std::to_string(seed));
        const std::vector<Index> through = some_vertices(mesh, count, seed);
        expect_proper_cut(mesh, through, cut_graph(mesh, through));
      }
  }
}

TEST(CutGraph, LeavesDisksAlone) {
  for (const PolygonMesh& input : {grid(4, bumpy), one_triangle(), cone(6, true)}) {
    const std::vector<char> is_cut = cut_graph(SurfaceMesh::from_polygons(input), {});
    EXPECT_EQ(std::count(is_cut.begin(), is_cut.end(), 0), static_cast<long>(is_cut.size()));
  }
  // Vertices of the boundary need no cut.
  const std::vector<char> is_cut = cut_graph(SurfaceMesh::from_polygons(grid(4)), {0, 3, 24, 0});
  EXPECT_EQ(std::count(is_cut.begin(), is_cut.end(), 0), static_cast<long>(is_cut.size()));
}

TEST(CutGraph, TakesTheShortWay) {
  // One vertex of a square, at distance two edges from the boundary.
  const SurfaceMesh square = SurfaceMesh::from_polygons(grid(8));
  EXPECT_NEAR(cut_length(square, cut_graph(square, {2 * 9 + 4})), 2 / 8.0, 1e-12);
  // Two vertices close to each other and far from the boundary.
  EXPECT_NEAR(cut_length(square, cut_graph(square, {4 * 9 + 4, 4 * 9 + 5})), 4 / 8.0, 1e-12);
  // A row of vertices on a large box: the path along them.
  const SurfaceMesh cube = SurfaceMesh::from_polygons(voxel_surface(box(6, 6, 6)));
  std::vector<Index> row;
  for (Index v = 0; v < cube.vertex_count(); ++v) {
    const Vector3 p = cube.positions().row(v);
    if (p.x() == 3 && p.z() == 6) row.push_back(v);
  }
  ASSERT_EQ(row.size(), 7u);
  EXPECT_NEAR(cut_length(cube, cut_graph(cube, row)), 6, 1e-12);
  // An annulus is cut at its narrowest place, a torus around the tube and around the hole.
  const SurfaceMesh ring = SurfaceMesh::from_polygons(grid_without(8, {3 * 8 + 1}));
  EXPECT_NEAR(cut_length(ring, cut_graph(ring, {})), 1 / 8.0, 1e-12);
  const SurfaceMesh wheel = SurfaceMesh::from_polygons(torus(40, 20, 0));
  EXPECT_LT(cut_length(wheel, cut_graph(wheel, {})), 2 * kPi * (1 + 1) * 1.01);
}

TEST(CutGraph, RefusesVerticesThatDoNotExist) {
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(octahedron());
  for (const Index v : {-1, 6})
    expect_contains(error_message(ErrorKind::Usage,
                                  [&] {
                                    cut_graph(mesh, {0, v});
                                  }),
                    {"no vertex", std::to_string(v)});
}

TEST(CutGraph, DependsOnTheSurfaceOnly) {
  const PolygonMesh input = bar_with_holes(2, 3);
  const auto moved = transformed(input, [](const Vector3& p) -> Vector3 {
    return 8 * Vector3(p.z(), p.x(), p.y()) + Vector3(1, 2, 3);
  });
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(input);
  const std::vector<Index> through = some_vertices(mesh, 10, 4);
  EXPECT_EQ(cut_graph(mesh, through), cut_graph(SurfaceMesh::from_polygons(moved), through));
  std::vector<Index> reversed(through.rbegin(), through.rend());
  EXPECT_EQ(cut_graph(mesh, through), cut_graph(mesh, reversed));
}

TEST(CutGraph, PublicMeshes) {
  const std::filesystem::path folder = public_data("closed");
  if (folder.empty()) GTEST_SKIP() << kNoPublicData;
  for (const std::string& file : obj_files(folder)) {
    const SurfaceMesh mesh = SurfaceMesh::from_polygons(obj_file(file));
    for (const int count : {0, 30}) {
      SCOPED_TRACE(file + ", " + std::to_string(count));
      const std::vector<Index> through = some_vertices(mesh, count, 5);
      expect_proper_cut(mesh, through, cut_graph(mesh, through));
    }
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
