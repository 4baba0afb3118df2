// The public volume meshes, optimized. Not in the preset asan: without compiler optimization, dual
// numbers in three dimensions take 200 times as long.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "majorant/framework/error.h"
#include "majorant/io/volume_files.h"
#include "majorant/volumes/optimize_volume_mesh.h"
#include "public_data.h"

namespace majorant {
namespace {

namespace fs = std::filesystem;

TEST(PublicVolumes, AreOptimized) {
  const fs::path folder = public_data("volumes");
  if (folder.empty()) GTEST_SKIP() << kNoPublicData;
  std::set<std::string> refused;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string extension = entry.path().extension();
    if (extension != ".msh" && extension != ".mesh") continue;
    SCOPED_TRACE(entry.path().string());
    const VolumeMesh mesh = read_volume_mesh(entry.path());
    RunRecord record;
    try {
      const VolumeResult result = optimize_volume_mesh(mesh, {}, record);
      EXPECT_TRUE(result.is_valid()) << result.message;
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::Unsupported) << e.what();
      refused.insert(entry.path().filename());
    }
  }
  EXPECT_EQ(refused, std::set<std::string>());
}

// Nodes far from good positions inside a fixed boundary. One linear system moves nearly all of them
// back, so that few steps follow; without it there are 58.
TEST(PublicVolumes, ComesFreeFromASmoothStart) {
  const fs::path folder = public_data("volumes");
  if (folder.empty()) GTEST_SKIP() << kNoPublicData;
  const VolumeMesh mesh = read_volume_mesh(folder / "generated/tangled_o2_n8_400.msh");
  RunRecord record;
  const VolumeResult result = optimize_volume_mesh(mesh, {}, record);
  EXPECT_TRUE(result.is_valid()) << result.message;
  EXPECT_EQ(result.status, Status::Converged) << result.message;
  EXPECT_LE(result.untangling_iterations, 15);
  EXPECT_GE(result.after.least_scaled_jacobian(), 0.347);
}

// An exponential energy may exceed 1e234 where elements have just become valid.
TEST(PublicVolumes, ExponentialsDoNotOverflow) {
  const fs::path folder = public_data("volumes");
  if (folder.empty()) GTEST_SKIP() << kNoPublicData;
  for (const char* name : {"mfem/jagged.mesh", "generated/tangled_o2_n4_25.msh"}) {
    SCOPED_TRACE(name);
    const VolumeMesh mesh = read_volume_mesh(folder / name);
    VolumeOptions options;
    options.energy = {{find_volume_energy("amips-exponential", mesh.dimension())->make, 1.0}};
    RunRecord record;
    const VolumeResult result = optimize_volume_mesh(mesh, options, record);
    EXPECT_TRUE(result.is_valid()) << result.message;
    EXPECT_NE(result.status, Status::Failed) << result.message;
    EXPECT_LT(result.value, result.initial_value);
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
