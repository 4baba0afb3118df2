#include "majorant/quads/internal/border.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "majorant/framework/error.h"
#include "majorant/parametrization/initialization/start.h"
#include "majorant/quads/internal/extraction.h"
#include "majorant/quads/internal/quantization.h"
#include "majorant/quads/internal/resolved_surface.h"
#include "majorant/quads/quad_mesh.h"

namespace majorant {
namespace {

// n by m squares, each cut in two, but for those with is_hole(i, j); corners at place(i, j).
template <class Place, class IsHole>
SurfaceMesh sheet(int n, int m, const Place& place, const IsHole& is_hole) {
  PolygonMesh mesh;
  std::map<std::pair<int, int>, Index> number;
  const auto vertex = [&](int i, int j) {
    const auto [found, is_new] = number.try_emplace({i, j}, mesh.positions.size());
    if (is_new) mesh.positions.push_back(place(i, j));
    return found->second;
  };
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < n; ++i) {
      if (is_hole(i, j)) continue;
      const Index a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1),
                  d = vertex(i, j + 1);
      if ((i + j) % 2 == 0) {
        mesh.polygons.push_back({a, b, d});
        mesh.polygons.push_back({b, c, d});
      } else {
        mesh.polygons.push_back({a, b, c});
        mesh.polygons.push_back({a, c, d});
      }
    }
  return SurfaceMesh::from_polygons(mesh);
}

constexpr auto kWhole = [](int, int) { return false; };
constexpr auto kFlat = [](int i, int j) { return Vector3(i, j, 0); };

SurfaceMesh cylinder(int around, int along) {
  PolygonMesh mesh;
  for (int j = 0; j <= along; ++j)
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * std::numbers::pi * i / around;
      mesh.positions.emplace_back(std::cos(angle), std::sin(angle), 0.3 * j);
    }
  for (int j = 0; j < along; ++j)
    for (int i = 0; i < around; ++i) {
      const Index a = j * around + i, b = j * around + (i + 1) % around, c = b + around,
                  d = a + around;
      mesh.polygons.push_back({a, b, c});
      mesh.polygons.push_back({a, c, d});
    }
  return SurfaceMesh::from_polygons(mesh);
}

SurfaceMesh round_disk(int rings) {
  PolygonMesh mesh;
  mesh.positions.emplace_back(0, 0, 0);
  for (int r = 1; r <= rings; ++r)
    for (int i = 0; i < 6 * r; ++i) {
      const double angle = std::numbers::pi * i / (3 * r);
      mesh.positions.emplace_back(r * std::cos(angle), r * std::sin(angle), 0);
    }
  const auto vertex = [](int r, int i) { return r == 0 ? 0 : 1 + 3 * r * (r - 1) + i % (6 * r); };
  for (int r = 1; r <= rings; ++r)
    for (int sector = 0; sector < 6; ++sector)
      for (int t = 0; t < r; ++t) {
        const int in = sector * (r - 1) + t, out = sector * r + t;
        mesh.polygons.push_back({vertex(r - 1, in), vertex(r, out), vertex(r, out + 1)});
        if (t + 1 < r)
          mesh.polygons.push_back({vertex(r - 1, in), vertex(r, out + 1), vertex(r - 1, in + 1)});
      }
  return SurfaceMesh::from_polygons(mesh);
}

std::map<std::string, SurfaceMesh> bordered_surfaces() {
  std::map<std::string, SurfaceMesh> all;
  all.emplace("square", sheet(10, 10, kFlat, kWhole));
  all.emplace("wave", sheet(
                          24, 8, [](int i, int j) { return Vector3(i, j, 2 * std::sin(0.3 * i)); },
                          kWhole));
  all.emplace("L", sheet(12, 12, kFlat, [](int i, int j) { return i >= 6 && j >= 6; }));
  all.emplace("hole", sheet(15, 15, kFlat,
                            [](int i, int j) { return 5 <= i && i < 10 && 5 <= j && j < 10; }));
  all.emplace("four holes", sheet(25, 25, kFlat, [](int i, int j) {
                return (i / 5) % 2 == 1 && (j / 5) % 2 == 1;
              }));
  all.emplace("cylinder", cylinder(24, 12));
  all.emplace("disk", round_disk(8));
  return all;
}

TEST(Border, FacesHaveOneEdgeOnItAndVerticesTheirNumbers) {
  PolygonMesh triangle;
  triangle.positions = {{0, 0, 0}, {3, 0, 0}, {0, 3, 0}};
  triangle.polygons = {{0, 1, 2}};
  for (const SurfaceMesh& mesh :
       {SurfaceMesh::from_polygons(triangle), sheet(1, 1, kFlat, kWhole),
        sheet(1, 5, kFlat, kWhole), sheet(4, 4, kFlat, kWhole), cylinder(5, 1)}) {
    const SurfaceMesh resolved = resolve_feature_edges(mesh).mesh;
    EXPECT_NEAR(resolved.area(), mesh.area(), 1e-12 * mesh.area());
    EXPECT_EQ(resolved.boundary_loops(), mesh.boundary_loops());
    for (Index v = 0; v < mesh.vertex_count(); ++v)
      EXPECT_EQ(resolved.input_position(v), mesh.input_position(v));
    const std::vector<char> is_border = held_flags(resolved), on_border = resolved.boundary_flags();
    for (Index f = 0; f < resolved.face_count(); ++f)
      EXPECT_LE(is_border[3 * f] + is_border[3 * f + 1] + is_border[3 * f + 2], 1);
    for (Index h = 0; h < resolved.half_edge_count(); ++h)
      EXPECT_TRUE(is_border[h] || !on_border[resolved.from_vertex(h)] ||
                  !on_border[resolved.to_vertex(h)]);
  }
}

TEST(Border, LengthsGoAroundLoops) {
  const SurfaceMesh mesh = sheet(3, 2, kFlat, kWhole);
  const BorderLengths lengths(mesh);
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    if (mesh.opposite(h) >= 0) continue;
    EXPECT_EQ(lengths.loop_length(h), 10);
    const double begin = lengths.length_at({h, 0});
    for (const double on : {0.25, 3.5, -2.75, 10.25}) {
      const BorderPoint there = lengths.point_at(h, begin + on);
      const double around = lengths.length_at(there) - begin - on;
      EXPECT_NEAR(std::remainder(around, 10), 0, 1e-12);
    }
  }
}

BezierMap aligned_start(const SurfaceMesh& resolved) {
  SeamlessOptions options;
  options.field.aligned = held_flags(resolved);
  return make_seamless(resolved, options, RunRecord()).map;
}

TEST(Border, FollowedEdgesExcludeGivenCones) {
  const SurfaceMesh mesh = sheet(4, 4, kFlat, kWhole);
  SeamlessOptions options;
  options.field.aligned = held_flags(mesh);
  options.cones.emplace();
  EXPECT_THROW(make_seamless(mesh, options, RunRecord()), InvalidArgument);
  options.cones.reset();
  options.method = SeamlessMethod::Conformal;
  EXPECT_THROW(make_seamless(mesh, options, RunRecord()), Error);
}

TEST(Border, LatticeAndPatchesEndOnIt) {
  for (const auto& [name, mesh] : bordered_surfaces()) {
    SCOPED_TRACE(name);
    const SurfaceMesh resolved = resolve_feature_edges(mesh).mesh;
    SeamlessLattice lattice(resolved, aligned_start(resolved));
    int turns = 0;  // of the border and around cones: Gauss and Bonnet
    for (Index v = 0; v < resolved.vertex_count(); ++v)
      turns += (lattice.is_on_border(v) ? 2 : 4) - lattice.quarter_turns(v);
    EXPECT_EQ(turns, 4 * mesh.topology().euler_characteristic());
    const TMesh t_mesh = trace_t_mesh(lattice);
    std::vector<int> uses(2 * t_mesh.arcs.size(), 0);
    WideInteger area = 0;
    for (const TPatch& patch : t_mesh.patches) {
      for (const auto& side : patch.sides)
        for (const Index h : side) ++uses[h];
      area += 2 * WideInteger{patch.width} * patch.height;
    }
    EXPECT_TRUE(area == lattice.twice_area());
    for (Index h = 0; h < static_cast<Index>(uses.size()); ++h)
      EXPECT_EQ(uses[h], h % 2 == 1 && t_mesh.is_on_border(arc_of(h)) ? 0 : 1);
    // With an edge at least for every arc nothing is joined.
    const std::vector<double> required(t_mesh.arcs.size(), 2);
    const std::vector<Index> edges =
        Quantization(t_mesh, required, std::vector<Index>(required.size(), 1))
            .numbers(SearchEffort::Least);
    ExtractedQuads extracted(lattice, t_mesh, edges);
    EXPECT_TRUE(QuadConnectivity(t_mesh, edges).joining_arcs().empty());
    const QuadCheck check = check_quads(extracted.polygons(), &mesh);
    EXPECT_EQ(check.topology.euler_characteristic(), mesh.topology().euler_characteristic());
    EXPECT_EQ(check.topology.boundary_loops, mesh.topology().boundary_loops);
    for (const std::string& defect : check.defects)
      EXPECT_EQ(defect.find("border"), std::string::npos) << defect;
  }
}

TEST(Border, QuadsCoverIt) {
  for (const auto& [name, mesh] : bordered_surfaces())
    for (const long count : {100, 1000}) {
      SCOPED_TRACE(name);
      SCOPED_TRACE(count);
      RunRecord record;
      QuadMeshOptions options;
      options.count = count;
      const QuadMesh made = quad_mesh(mesh, options, record);
      EXPECT_TRUE(made.check.is_valid());
      if (count == 1000) {
        EXPECT_NEAR(static_cast<double>(made.check.count), 1000, kCountClose * 1000);
      }
    }
}

// A square needs no cones, and its quads are squares.
TEST(Border, SquareIsAGrid) {
  RunRecord record;
  QuadMeshOptions options;
  options.count = 100;
  const QuadMesh made = quad_mesh(sheet(10, 10, kFlat, kWhole), options, record);
  EXPECT_EQ(made.cones, 0);
  EXPECT_EQ(made.check.count, 100);
  EXPECT_EQ(made.check.irregular, 0);
  EXPECT_GT(made.check.min_scaled_jacobian, 1 - 1e-6);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
