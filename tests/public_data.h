// The public collection of meshes, which a clone of the repository does not contain:
//
//   const std::filesystem::path folder = public_data("disks");
//   if (folder.empty()) GTEST_SKIP() << kNoPublicData;
//
// Every test that needs it has a partner that tests the same property on generated meshes.
#pragma once

#include <cstdlib>
#include <filesystem>

namespace majorant {

inline constexpr const char* kNoPublicData = "no ../shared/data/public";

// Returns a folder of $MAJORANT_SHARED_DATA; empty if it does not exist.
inline std::filesystem::path public_data(const char* folder) {
  const char* root = std::getenv("MAJORANT_SHARED_DATA");
  if (root == nullptr) return {};
  std::filesystem::path path = std::filesystem::path(root) / folder;
  return std::filesystem::is_directory(path) ? path : std::filesystem::path();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
