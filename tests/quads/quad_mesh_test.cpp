// The plan of a quad mesh before any work: counts, lengths, memory; what is done where there are no
// quads of about the number asked for.
#include "majorant/quads/quad_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numbers>

#include "counted_stop.h"
#include "expected_error.h"
#include "mesh/test_meshes.h"

namespace majorant {
namespace {

// So many bytes are available, until the end of a test.
class MemoryPlan : public ::testing::Test {
 protected:
  static void leave(std::size_t bytes) {
    ASSERT_EQ(::setenv("MAJORANT_MEMORY_BYTES", std::to_string(bytes).c_str(), 1), 0);
  }
  void TearDown() override { ::unsetenv("MAJORANT_MEMORY_BYTES"); }

  const SurfaceMesh mesh_ = SurfaceMesh::from_polygons(grid(4, bumpy));
};

TEST_F(MemoryPlan, RefusesWithBothFigures) {
  leave(3'000'000'000);
  QuadMeshOptions options;
  options.count = 10'000'000;
  const auto refusal = [&] {
    RunRecord record;
    return error_message(ErrorKind::Unsupported, [&] { quad_mesh(mesh_, options, record); });
  };
  expect_contains(refusal(), {"10000000 quads need about 10.0 GB", "3.0 GB are available",
                              "ask for 3000000 at most"});
  options.count.reset();
  options.edge_length = std::sqrt(mesh_.area() / 1e7);
  expect_contains(refusal(), {"10000000 quads need about 10.0 GB"});
}

TEST_F(MemoryPlan, PlansThatFitAreNotRefused) {
  leave(3'000'000'000);
  QuadMeshOptions options;
  options.count = 2'990'000;
  EXPECT_NO_THROW(require_memory_for_quads(mesh_, options));
  leave(kBytesOfQuad * 4);
  options.count = 4;
  EXPECT_NO_THROW(require_memory_for_quads(mesh_, options));
  options.count = 5;
  EXPECT_THROW(require_memory_for_quads(mesh_, options), Error);
}

// Over a polygon around the origin, both of its ends fans.
SurfaceMesh prism(const std::vector<Vector2>& outline, double height) {
  PolygonMesh mesh;
  const auto n = static_cast<Index>(outline.size());
  for (const double z : {0.0, height})
    for (const Vector2& p : outline) mesh.positions.emplace_back(p.x(), p.y(), z);
  mesh.positions.emplace_back(0, 0, 0);
  mesh.positions.emplace_back(0, 0, height);
  for (Index i = 0; i < n; ++i) {
    const Index j = (i + 1) % n;
    mesh.polygons.push_back({i, j, n + j});
    mesh.polygons.push_back({i, n + j, n + i});
    mesh.polygons.push_back({2 * n, j, i});
    mesh.polygons.push_back({2 * n + 1, n + i, n + j});
  }
  return SurfaceMesh::from_polygons(mesh);
}

struct ToothPoint {
  double at, radius;  // part of the tooth's angle
};

SurfaceMesh disk_with_teeth(int teeth, const std::vector<ToothPoint>& tooth, double height) {
  std::vector<Vector2> outline;
  for (int k = 0; k < teeth; ++k)
    for (const ToothPoint& p : tooth) {
      const double angle = 2 * std::numbers::pi * (k + p.at) / teeth;
      outline.emplace_back(p.radius * std::cos(angle), p.radius * std::sin(angle));
    }
  return prism(outline, height);
}

const std::vector<ToothPoint> kSawTooth = {{0, 1}, {0.9, 1.2}};
const std::vector<ToothPoint> kGearTooth = {{0, 1}, {0.25, 1.2}, {0.5, 1.2}, {0.75, 1}};

QuadMesh solid_in_quads(const SurfaceMesh& mesh, long count) {
  RunRecord record;
  QuadMeshOptions options;
  options.count = count;
  return quad_mesh(mesh, options, record);
}

// So few quads that lie across the teeth are turned over, and many times as many are needed along
// them: these are made.
TEST(QuadMesh, TeethAreFollowedWhereFewQuadsAcrossThemAreTurned) {
  const QuadMesh made = solid_in_quads(disk_with_teeth(44, kSawTooth, 0.3), 160);
  EXPECT_TRUE(made.check.is_valid());
  EXPECT_EQ(made.feature_lines, 6 * 44);
  EXPECT_TRUE(made.relaxed.empty());
  EXPECT_GT(made.check.count, 1000);
  EXPECT_TRUE(made.least_count);
}

// A gear so thin that quads along its edges are far too many, and few quads across them are turned
// over: the first of ever more that are not.
TEST(QuadMesh, AThinGearGetsAsManyQuadsAsItNeeds) {
  const QuadMesh made = solid_in_quads(disk_with_teeth(24, kGearTooth, 0.01), 60);
  EXPECT_TRUE(made.check.is_valid());
  EXPECT_EQ(static_cast<Index>(made.relaxed.size()), made.feature_lines);
  EXPECT_GT(made.check.count, 120);
}

// Quads whose number is far off what was asked for have the angles of the rectangles, or of a map
// of degree 1.
TEST(QuadMesh, HigherDegreesAreForCountsThatAreClose) {
  const SurfaceMesh mesh = disk_with_teeth(24, kGearTooth, 0.4);
  const auto polls = [&](int last_degree) {
    const CountedStop never;
    RunRecord record(never.check());
    QuadMeshOptions options;
    options.count = 800;
    options.last_degree = last_degree;
    options.threads = 1;
    EXPECT_EQ(quad_mesh(mesh, options, record).degree, 1);
    return never.polls();
  };
  EXPECT_EQ(polls(3), polls(1));
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
