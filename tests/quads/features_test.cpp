#include "majorant/quads/features.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "majorant/framework/error.h"
#include "majorant/quads/internal/border.h"
#include "majorant/quads/internal/resolved_surface.h"
#include "majorant/quads/quad_mesh.h"

namespace majorant {
namespace {

// A block of nx by ny by nz cubes, every square of its sides cut in two, with its points at
// place(i, j, k).
template <class Place>
SurfaceMesh block(int nx, int ny, int nz, const Place& place) {
  PolygonMesh mesh;
  std::map<std::array<int, 3>, Index> number;
  const std::array<int, 3> size{nx, ny, nz};
  const auto vertex = [&](const std::array<int, 3>& p) {
    const auto [found, is_new] = number.try_emplace(p, mesh.positions.size());
    if (is_new) mesh.positions.push_back(place(p[0], p[1], p[2]));
    return found->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const int side : {0, size[axis]})
      for (int i = 0; i < size[(axis + 1) % 3]; ++i)
        for (int j = 0; j < size[(axis + 2) % 3]; ++j) {
          std::array<Index, 4> corners{};
          for (int c = 0; c < 4; ++c) {
            std::array<int, 3> p{};
            p[axis] = side;
            p[(axis + 1) % 3] = i + (c == 1 || c == 2);
            p[(axis + 2) % 3] = j + (c >= 2);
            corners[side == 0 ? 3 - c : c] = vertex(p);
          }
          mesh.polygons.push_back({corners[0], corners[1], corners[2]});
          mesh.polygons.push_back({corners[0], corners[2], corners[3]});
        }
  return SurfaceMesh::from_polygons(mesh);
}

constexpr auto kCubes = [](int i, int j, int k) { return Vector3(i, j, k); };

// A ridge on the upper side that begins at one of its edges and runs out.
constexpr auto kRidge = [](int i, int j, int k) {
  const double x = i / 16.0, y = j / 10.0;
  const double lift = 2 * std::max(0.0, 0.7 - x) * std::max(0.0, 1 - std::abs(y - 0.5) / 0.25);
  return Vector3(i, j, k * (1 + lift));
};

TEST(Features, LinesOfABlock) {
  const SurfaceMesh mesh = block(4, 3, 2, kCubes);
  const std::vector<char> sharp = sharp_edges(mesh, kCornerTurn);
  const FeatureLines features = feature_lines(mesh, sharp);
  EXPECT_EQ(features.lines.size(), 12u);
  double length = 0;
  for (const FeatureLine& line : features.lines) {
    length += line.length;
    EXPECT_FALSE(line.is_closed);
    EXPECT_TRUE(features.is_corner[mesh.from_vertex(line.half_edges.front())]);
    EXPECT_TRUE(features.is_corner[mesh.to_vertex(line.half_edges.back())]);
    for (std::size_t i = 1; i < line.half_edges.size(); ++i)
      EXPECT_EQ(mesh.from_vertex(line.half_edges[i]), mesh.to_vertex(line.half_edges[i - 1]));
  }
  EXPECT_DOUBLE_EQ(length, 4 * (4 + 3 + 2));
  EXPECT_TRUE(feature_lines(mesh, sharp_edges(mesh, 91)).lines.empty());
  EXPECT_TRUE(feature_lines(mesh, {}).lines.empty());
}

TEST(Features, ShortLinesAreLeftOut) {
  const SurfaceMesh mesh = block(16, 10, 4, kRidge);
  const std::vector<char> sharp = sharp_edges(mesh, kCornerTurn);
  const std::size_t all = feature_lines(mesh, sharp).lines.size();
  EXPECT_EQ(feature_lines(mesh, without_short_lines(mesh, sharp, 0.1)).lines.size(), all);
  EXPECT_LT(feature_lines(mesh, without_short_lines(mesh, sharp, 2.5)).lines.size(), all);
  EXPECT_TRUE(feature_lines(mesh, without_short_lines(mesh, sharp, 100)).lines.empty());
}

TEST(Features, FacesHaveOneHeldEdge) {
  for (const SurfaceMesh& mesh : {block(1, 1, 1, kCubes), block(3, 2, 2, kCubes)}) {
    // All three edges of one triangle are features.
    std::vector<char> is_feature = sharp_edges(mesh, kCornerTurn);
    for (Index h = 0; h < 3; ++h) is_feature[h] = is_feature[mesh.opposite(h)] = 1;
    const ResolvedSurface resolved = resolve_feature_edges(mesh, is_feature);
    EXPECT_NEAR(resolved.mesh.area(), mesh.area(), 1e-12 * mesh.area());
    EXPECT_EQ(std::count(resolved.is_feature.begin(), resolved.is_feature.end(), 1),
              std::count(is_feature.begin(), is_feature.end(), 1));
    for (Index f = 0; f < resolved.mesh.face_count(); ++f)
      EXPECT_LE(resolved.is_feature[3 * f] + resolved.is_feature[3 * f + 1] +
                    resolved.is_feature[3 * f + 2],
                1);
  }
}

QuadMesh made_of(const SurfaceMesh& mesh, long count) {
  RunRecord record;
  QuadMeshOptions options;
  options.count = count;
  return quad_mesh(mesh, options, record);
}

TEST(Features, QuadsCoverThem) {
  std::map<std::string, SurfaceMesh> surfaces;
  surfaces.emplace("cube", block(4, 4, 4, kCubes));
  surfaces.emplace("flat", block(12, 9, 2, kCubes));
  surfaces.emplace("ridge", block(16, 10, 4, kRidge));
  for (const auto& [name, mesh] : surfaces) {
    SCOPED_TRACE(name);
    const QuadMesh made = made_of(mesh, 1500);
    EXPECT_TRUE(made.check.is_valid());
    EXPECT_TRUE(made.relaxed.empty());
    EXPECT_GE(made.feature_lines, 12);
    EXPECT_EQ(made.check.feature_lines, made.feature_lines);
    EXPECT_NEAR(static_cast<double>(made.check.count), 1500, kCountClose * 1500);
    // The sides of the ridge are bent.
    if (name != "ridge") {
      EXPECT_LT(made.check.hausdorff.to_surface, 1e-9);
    }
  }
}

// The quads of a cube are squares.
TEST(Features, CubeIsAGrid) {
  const QuadMesh made = made_of(block(4, 4, 4, kCubes), 600);
  EXPECT_EQ(made.check.count, 600);
  EXPECT_EQ(made.check.irregular, 8);
  EXPECT_GT(made.check.min_scaled_jacobian, 1 - 1e-6);
}

TEST(Features, UncoveredLinesAreNamed) {
  const SurfaceMesh mesh = block(4, 4, 4, kCubes);
  const std::vector<char> sharp = sharp_edges(mesh, kCornerTurn);
  QuadMesh made = made_of(mesh, 600);
  EXPECT_TRUE(check_quads(made.quads, &mesh, sharp).is_valid());
  // A vertex inside of an edge, moved along it, and off it.
  Index inside = -1;
  for (Index v = 0; v < static_cast<Index>(made.quads.positions.size()); ++v)
    if (const Vector3& p = made.quads.positions[v];
        p.y() == 0 && p.z() == 0 && std::abs(p.x() - 2) < 0.5)
      inside = v;
  ASSERT_GE(inside, 0);
  made.quads.positions[inside].x() += 0.05;
  EXPECT_TRUE(check_quads(made.quads, &mesh, sharp).is_valid());
  made.quads.positions[inside].y() = 0.01;
  const QuadCheck check = check_quads(made.quads, &mesh, sharp);
  EXPECT_EQ(check.uncovered.size(), 1u);
  EXPECT_FALSE(check.is_valid());
  EXPECT_TRUE(check_quads(made.quads, &mesh).is_valid());
}

TEST(Features, LinesTooShortForTheQuadsAreRelaxed) {
  const SurfaceMesh mesh = block(12, 9, 2, kCubes);
  const QuadMesh made = made_of(mesh, 6);
  EXPECT_TRUE(made.check.is_valid());
  EXPECT_FALSE(made.relaxed.empty());
  EXPECT_EQ(made.check.feature_lines + static_cast<Index>(made.relaxed.size()), made.feature_lines);
}

// A flat cylinder, its axis and four rings of so many points on either side.
SurfaceMesh coin(int around, double height) {
  constexpr int kRings = 4;
  PolygonMesh mesh;
  const auto center = [&](int side) { return static_cast<Index>(side * (1 + kRings * around)); };
  const auto at = [&](int side, int ring, int i) {
    return static_cast<Index>(center(side) + 1 + (ring - 1) * around + i % around);
  };
  const auto add = [&](int side, Index a, Index b, Index c) {
    mesh.polygons.push_back(side == 0 ? std::vector<Index>{a, c, b} : std::vector<Index>{a, b, c});
  };
  for (const int side : {0, 1}) {
    mesh.positions.emplace_back(0, 0, side * height);
    for (int ring = 1; ring <= kRings; ++ring)
      for (int i = 0; i < around; ++i) {
        const double angle = 2 * std::numbers::pi * i / around, radius = double(ring) / kRings;
        mesh.positions.emplace_back(radius * std::cos(angle), radius * std::sin(angle),
                                    side * height);
      }
    for (int i = 0; i < around; ++i) add(side, center(side), at(side, 1, i), at(side, 1, i + 1));
    for (int ring = 1; ring < kRings; ++ring)
      for (int i = 0; i < around; ++i) {
        add(side, at(side, ring, i), at(side, ring + 1, i), at(side, ring + 1, i + 1));
        add(side, at(side, ring, i), at(side, ring + 1, i + 1), at(side, ring, i + 1));
      }
  }
  for (int i = 0; i < around; ++i) {
    add(1, at(0, kRings, i), at(0, kRings, i + 1), at(1, kRings, i + 1));
    add(1, at(0, kRings, i), at(1, kRings, i + 1), at(1, kRings, i));
  }
  return SurfaceMesh::from_polygons(mesh);
}

// Few quads for a thin solid: with its edges, and across them.
TEST(Features, OfACoinOfFewQuads) {
  const SurfaceMesh mesh = coin(24, 0.07);
  QuadMeshOptions options;
  options.count = 40;
  RunRecord record;
  const QuadMesh made = quad_mesh(mesh, options, record);
  EXPECT_EQ(made.feature_lines, 2);
  EXPECT_TRUE(made.relaxed.empty());
  options.features = std::vector<char>();
  const QuadMesh across = quad_mesh(mesh, options, record);
  EXPECT_TRUE(across.check.is_valid());
  EXPECT_NEAR(static_cast<double>(across.check.count), 40, 2);
}

TEST(Features, ExcludeGivenCones) {
  const SurfaceMesh mesh = block(2, 2, 2, kCubes);
  RunRecord record;
  QuadMeshOptions options;
  options.map.cones.emplace();
  options.features = sharp_edges(mesh, kCornerTurn);
  EXPECT_THROW(quad_mesh(mesh, options, record), Error);
  options.features->pop_back();
  EXPECT_THROW(quad_mesh(mesh, options, record), InvalidArgument);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
