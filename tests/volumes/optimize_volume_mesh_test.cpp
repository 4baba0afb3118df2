// Meshes of volumes optimized: untangled where they are not valid, held where they should be, and
// proven afterwards; the public collection, and small ones made here.
#include "majorant/volumes/optimize_volume_mesh.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>

#include "majorant/framework/error.h"
#include "majorant/volumes/volume_files.h"
#include "public_data.h"
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
  VolumeMesh mesh_of(const std::string& content) const {
    const std::string path = (folder_ / "a.mesh").string();
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
        for (const double x : at) text += std::to_string(x) + " ";
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
  options.sizes = {1, 2};
  EXPECT_THROW(optimized(mesh_of(cube(1, [](const Vector3& at) { return at; })), options),
               InvalidArgument);
}

TEST_F(OptimizedMeshes, LimitsLeaveWhatIsValid) {
  const VolumeMesh mesh = mesh_of(cube(3, [](const Vector3& at) -> Vector3 {
    return is_inside(at, 3) ? Vector3(at + Vector3(0.2, 0.1, -0.2)) : at;
  }));
  RunRecord none(std::numeric_limits<double>::infinity(), 0);
  const VolumeResult untouched = optimize_volume_mesh(mesh, {}, none);
  EXPECT_EQ(untouched.status, Status::MaxIterations);
  EXPECT_TRUE(untouched.after.is_valid());
  EXPECT_TRUE((untouched.points - mesh.points).cwiseAbs().maxCoeff() < 1e-12);
  RunRecord one(std::numeric_limits<double>::infinity(), 1);
  const VolumeResult moved = optimize_volume_mesh(mesh, {}, one);
  EXPECT_EQ(moved.status, Status::MaxIterations);
  EXPECT_TRUE(moved.after.is_valid());
  EXPECT_EQ(one.trace().size(), 1u);
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

TEST_F(OptimizedMeshes, PublicMeshes) {
  const fs::path folder = public_data("volumes");
  if (folder.empty()) GTEST_SKIP() << kNoPublicData;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string extension = entry.path().extension();
    if (extension != ".msh" && extension != ".mesh") continue;
    SCOPED_TRACE(entry.path().string());
    const VolumeMesh mesh = read_volume_mesh(entry.path());
    try {
      const VolumeResult result = optimized(mesh);
      // Eighteen quads of degree 4, of which one stays folded.
      if (entry.path().filename() == "jagged.mesh") continue;
      EXPECT_TRUE(result.after.is_valid()) << result.message;
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::Unsupported) << e.what();
    }
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
