// Meshes of volumes optimized: untangled where they are not valid, held where they should be, and
// proven afterwards.
#include "majorant/volumes/optimize_volume_mesh.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>

#include "majorant/framework/error.h"
#include "majorant/volumes/volume_files.h"
#include "support.h"

namespace majorant {
namespace {

namespace fs = std::filesystem;

class OptimizedMeshes : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("majorant_optimized_" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  VolumeMesh mesh_of(const std::string& content, const char* name = "a.mesh") const {
    const std::string path = (folder_ / name).string();
    std::ofstream(path, std::ios::binary) << content;
    return read_volume_mesh(path);
  }
  static VolumeResult optimized(const VolumeMesh& mesh, const VolumeOptions& options = {}) {
    RunRecord record;
    return optimize_volume_mesh(mesh, options, record);
  }

 private:
  fs::path folder_;
};

// A cube of count^3 unit cubes of six tetrahedra, in Medit's words; moved: where vertex (i, j, k)
// stands.
std::string cube(int count, const std::function<Vector3(const Vector3&)>& moved) {
  const auto vertex = [&](int i, int j, int k) {
    return 1 + i + (count + 1) * (j + (count + 1) * k);
  };
  std::string text = "MeshVersionFormatted 2\nDimension 3\nVertices " +
                     std::to_string((count + 1) * (count + 1) * (count + 1)) + "\n";
  for (int k = 0; k <= count; ++k)
    for (int j = 0; j <= count; ++j)
      for (int i = 0; i <= count; ++i) {
        const Vector3 at = moved(Vector3(i, j, k));
        for (const double x : at) text += fmt::format("{} ", x);
        text += "0\n";
      }
  text += "Tetrahedra " + std::to_string(6 * count * count * count) + "\n";
  constexpr int kOrders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {1, 0, 2}, {2, 1, 0}, {0, 2, 1}};
  for (int k = 0; k < count; ++k)
    for (int j = 0; j < count; ++j)
      for (int i = 0; i < count; ++i)
        for (int t = 0; t < 6; ++t) {
          int at[3] = {i, j, k}, corners[4] = {vertex(i, j, k)};
          for (int c = 1; c < 4; ++c) {
            ++at[kOrders[t][c - 1]];
            corners[c] = vertex(at[0], at[1], at[2]);
          }
          if (t >= 3) std::swap(corners[1], corners[2]);
          for (const int c : corners) text += std::to_string(c) + " ";
          text += "1\n";
        }
  return text + "End\n";
}

bool is_inside(const Vector3& at, int count) { return at.minCoeff() > 0 && at.maxCoeff() < count; }

TEST_F(OptimizedMeshes, TangledCubesAreUntangled) {
  test::Random random(1);
  const auto thrown = [&](const Vector3& at) -> Vector3 {
    if (!is_inside(at, 4)) return at;
    return at + Vector3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  };
  const VolumeMesh mesh = mesh_of(cube(4, thrown));
  const VolumeResult result = optimized(mesh);
  EXPECT_GT(result.before.invalid(), 20);
  EXPECT_EQ(result.status, Status::Converged) << result.message;
  EXPECT_TRUE(result.after.is_valid());
  EXPECT_GT(result.untangling_iterations, 0);
  EXPECT_LE(result.value, result.initial_value);
  EXPECT_GT(result.after.least_scaled_jacobian(), 0.3);
  EXPECT_EQ(result.moved_nodes, 27);
  // Nothing of the boundary has moved.
  for (Index v = 0; v < mesh.points.rows(); ++v)
    if (!is_inside(mesh.points.row(v).transpose(), 4)) {
      EXPECT_EQ(result.points.row(v), mesh.points.row(v)) << v;
    }
}

// Planes in themselves, edges along themselves, corners not at all; all of it where it is free.
TEST_F(OptimizedMeshes, BoundariesSlideOrAreFree) {
  const auto graded = [](const Vector3& at) -> Vector3 {
    return at.unaryExpr([](double x) { return 3 * std::pow(x / 3, 1.5); });
  };
  const VolumeMesh mesh = mesh_of(cube(3, graded));
  VolumeOptions options;
  options.target = VolumeTarget::Size;
  options.sizes = {1.0};
  options.boundary = VolumeBoundary::Slide;
  const VolumeResult slid = optimized(mesh, options);
  EXPECT_TRUE(slid.after.is_valid());
  EXPECT_EQ(slid.curved_sides, 0);
  int moved_on_boundary = 0;
  for (Index v = 0; v < mesh.points.rows(); ++v)
    for (int d = 0; d < 3; ++d) {
      const double before = mesh.points(v, d);
      if (before == 0 || before == 3)
        EXPECT_EQ(slid.points(v, d), before) << v;
      else if (!is_inside(mesh.points.row(v).transpose(), 3) && slid.points(v, d) != before)
        ++moved_on_boundary;
    }
  EXPECT_GT(moved_on_boundary, 50);
  options.boundary = VolumeBoundary::Fixed;
  const VolumeResult fixed = optimized(mesh, options);
  EXPECT_LT(slid.value, fixed.value);
  options.boundary = VolumeBoundary::Free;
  const VolumeResult free = optimized(mesh, options);
  EXPECT_TRUE(free.after.is_valid());
  EXPECT_LT(free.value, slid.value);
}

// Where planes that are normal to an axis meet others, too.
TEST_F(OptimizedMeshes, CoordinatesOfPlanesNormalToAnAxisStayBitByBit) {
  const VolumeMesh mesh = mesh_of(cube(4, [](const Vector3& at) -> Vector3 {
    return {0.7 * at.x() + 0.1, at.y() + 0.1, at.z() + 0.25 * at.x() + 0.1};
  }));
  VolumeOptions options;
  options.boundary = VolumeBoundary::Slide;
  const VolumeResult result = optimized(mesh, options);
  EXPECT_TRUE(result.after.is_valid());
  const Vector3 low = mesh.points.colwise().minCoeff(), high = mesh.points.colwise().maxCoeff();
  int moved = 0;
  for (Index v = 0; v < mesh.points.rows(); ++v)
    for (int d = 0; d < 3; ++d) {
      const double before = mesh.points(v, d);
      const bool is_plane = d < 2 && (before == low[d] || before == high[d]);
      if (is_plane)
        EXPECT_EQ(result.points(v, d), before) << v << " " << d;
      else if (result.points(v, d) != before)
        ++moved;
    }
  EXPECT_GT(moved, 100);
}

TEST_F(OptimizedMeshes, WhatIsForcedIsNamedBeforehand) {
  // A corner of the cube pulled through the cell that has four vertices of the boundary.
  const VolumeMesh mesh = mesh_of(cube(2, [](const Vector3& at) -> Vector3 {
    return at == Vector3(2, 0, 0) ? Vector3(1.4, 0.8, 0.2) : at;
  }));
  const VolumeResult result = optimized(mesh);
  EXPECT_EQ(result.status, Status::Infeasible);
  EXPECT_FALSE(result.impossible.empty());
  EXPECT_EQ(result.untangling_iterations, 0);
  EXPECT_EQ(result.points, mesh.points);
}

TEST_F(OptimizedMeshes, WhatCannotBeOptimizedIsRefused) {
  const std::string mirrored = cube(1, [](const Vector3& at) -> Vector3 {
    return {-at.x(), at.y(), at.z()};
  });
  EXPECT_THROW(optimized(mesh_of(mirrored)), Error);
  const std::string surface =
      "MeshVersionFormatted 2\nDimension 3\nVertices 4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n1 1 1 0\n"
      "Triangles 2\n1 2 3 0\n2 4 3 0\nEnd\n";
  EXPECT_THROW(optimized(mesh_of(surface)), Error);
  VolumeOptions options;
  options.target = VolumeTarget::Size;
  const VolumeMesh unit = mesh_of(cube(1, [](const Vector3& at) { return at; }));
  for (const std::vector<double>& sizes :
       {std::vector<double>{1, 2}, {0.0}, {-1.0}, {1e-110}, {1e110}, {std::nan("")}}) {
    options.sizes = sizes;
    EXPECT_THROW(optimized(unit, options), InvalidArgument) << sizes[0];
  }
}

// Two triangles of which one is turned around: their areas add to 0.
TEST_F(OptimizedMeshes, AreasThatCancelHaveASize) {
  const VolumeMesh mesh = mesh_of(
      "MeshVersionFormatted 2\nDimension 2\nVertices 4\n0 0 0\n1 0 0\n0 1 0\n0 0 0\n"
      "Triangles 2\n1 2 3 1\n2 4 3 1\nEnd\n");
  VolumeOptions options;
  options.boundary = VolumeBoundary::Free;
  const VolumeResult result = optimized(mesh, options);
  EXPECT_EQ(result.before.invalid(), 1);
  EXPECT_TRUE(result.is_valid()) << result.message;
  EXPECT_GT(result.after.least_scaled_jacobian(), 0.99);
}

// A fan around the corner of a square that can be untangled, and one whose center sees no point
// from which all of its boundary is seen: what is said is said of where untangling ended.
TEST_F(OptimizedMeshes, WhatIsNotUntangledIsJudgedWhereThatEnded) {
  std::string points = "0 0 0 0\n1 0 0 0\n1 1 0 0\n0 1 0 0\n1.5 0.5 0 0\n";
  std::string cells = "1 2 5 0\n2 3 5 0\n3 4 5 0\n4 1 5 0\n";
  const std::vector<Vector2> horseshoe{{0, 0}, {3, 0}, {3, 3}, {2, 3},
                                       {2, 1}, {1, 1}, {1, 3}, {0, 3}};
  for (const Vector2& at : horseshoe) points += fmt::format("{} {} 0 0\n", at.x() + 5, at.y());
  points += "6.5 0.5 0 0\n";
  for (int k = 0; k < 8; ++k) cells += fmt::format("{} {} 14 0\n", 6 + k, 6 + (k + 1) % 8);
  const VolumeMesh mesh = mesh_of("MeshVersionFormatted 2\nDimension 3\nVertices 14\n" + points +
                                  "Triangles 12\n" + cells + "End\n");
  const VolumeResult result = optimized(mesh);
  EXPECT_EQ(result.status, Status::Infeasible);
  EXPECT_FALSE(result.is_valid());
  EXPECT_TRUE(result.impossible.empty());
  EXPECT_EQ(result.before.cells[1].range.positive, ProofStatus::Violated);
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_EQ(result.after.cells[k].range.positive, ProofStatus::Proven) << k;
  EXPECT_GT(result.after.invalid(), 0);
  EXPECT_LT(result.points(4, 0), 1);
}

// A triangle of degree 3, x = f(u), y = v with f' = 0.002 + 3 (u - 1/3)^2: the proofs of usual
// depth miss it, the deepest hold.
TEST_F(OptimizedMeshes, WhatIsNarrowlyValidIsNotUntangled) {
  std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n10\n";
  constexpr int kNodes[10][2] = {{0, 0}, {3, 0}, {0, 3}, {1, 0}, {2, 0},
                                 {2, 1}, {1, 2}, {0, 2}, {0, 1}, {1, 1}};
  for (int k = 0; k < 10; ++k) {
    const double u = kNodes[k][0] / 3.0, v = kNodes[k][1] / 3.0;
    text += fmt::format("{} {} {} 0\n", k + 1, 0.002 * u + std::pow(u - 1.0 / 3, 3), v);
  }
  text += "$EndNodes\n$Elements\n1\n1 21 2 0 1 1 2 3 4 5 6 7 8 9 10\n$EndElements\n";
  const VolumeMesh mesh = mesh_of(text, "a.msh");
  VolumeOptions options;
  options.boundary = VolumeBoundary::Free;
  const VolumeResult result = optimized(mesh, options);
  EXPECT_TRUE(result.before.is_valid());
  EXPECT_EQ(result.untangling_iterations, 0);
  EXPECT_EQ(result.status, Status::Converged) << result.message;
  EXPECT_TRUE(result.is_valid());
  EXPECT_LT(result.value, result.initial_value);
}

TEST_F(OptimizedMeshes, LimitsLeaveWhatIsValid) {
  const VolumeMesh mesh = mesh_of(cube(3, [](const Vector3& at) -> Vector3 {
    return is_inside(at, 3) ? Vector3(at + Vector3(0.2, 0.1, -0.2)) : at;
  }));
  RunRecord none(std::numeric_limits<double>::infinity(), 0);
  const VolumeResult untouched = optimize_volume_mesh(mesh, {}, none);
  EXPECT_EQ(untouched.status, Status::MaxIterations);
  EXPECT_TRUE(untouched.after.is_valid());
  EXPECT_EQ(untouched.points, mesh.points);
  RunRecord one(std::numeric_limits<double>::infinity(), 1);
  const VolumeResult moved = optimize_volume_mesh(mesh, {}, one);
  EXPECT_EQ(moved.status, Status::MaxIterations);
  EXPECT_TRUE(moved.after.is_valid());
  EXPECT_EQ(one.trace().size(), 1u);
}

// The nodes of curved elements that no step has moved are not taken from control points.
TEST_F(OptimizedMeshes, WithoutAStepNodesOfCurvedElementsStay) {
  std::string text = "MeshVersionFormatted 2\nDimension 2\nVertices 9\n";
  for (const char* const at : {"0 0", "2.1 0.1", "0.1 2.2", "2 2.1", "1.01 0.13", "1.1 1.03",
                               "0.17 1.11", "2.09 1.07", "1.07 2.19"})
    text += fmt::format("{} 0\n", at);
  text += "TrianglesP2 2\n1 2 3 5 6 7 1\n2 4 3 8 9 6 1\nEnd\n";
  const VolumeMesh mesh = mesh_of(text);
  for (const VolumeBoundary boundary :
       {VolumeBoundary::Fixed, VolumeBoundary::Slide, VolumeBoundary::Free}) {
    RunRecord none(std::numeric_limits<double>::infinity(), 0);
    VolumeOptions options;
    options.boundary = boundary;
    const VolumeResult result = optimize_volume_mesh(mesh, options, none);
    EXPECT_TRUE(result.is_valid()) << result.message;
    EXPECT_EQ(result.moved_nodes, 0);
    EXPECT_EQ(result.points, mesh.points);
  }
}

TEST_F(OptimizedMeshes, EveryEnergyAndTarget) {
  const VolumeMesh mesh = mesh_of(cube(3, [](const Vector3& at) -> Vector3 {
    return is_inside(at, 3) ? Vector3(at + Vector3(0.2, 0.1, -0.2)) : at;
  }));
  for (const NamedEnergy& energy : volume_energies(3))
    for (const VolumeTarget target : {VolumeTarget::Ideal, VolumeTarget::Initial}) {
      VolumeOptions options;
      options.energy = {{energy.make, 1.0}};
      options.target = target;
      const VolumeResult result = optimized(mesh, options);
      EXPECT_TRUE(result.after.is_valid()) << energy.name;
      EXPECT_LE(result.value, result.initial_value) << energy.name;
      EXPECT_TRUE(result.status == Status::Converged || result.status == Status::Stalled)
          << energy.name << " " << result.message;
    }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
