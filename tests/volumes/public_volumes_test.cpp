// The public meshes of volumes, optimized. Not in the preset asan: unoptimized dual numbers of
// three dimensions take 200 times as long there.
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

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
