// The public collection of meshes, which a clone by itself has not:
//
//   const std::filesystem::path folder = public_data("disks");
//   if (folder.empty()) GTEST_SKIP() << kNoPublicData;
//
// Beside every test that needs it stands one of the same property on generated meshes.
#pragma once

#include <cstdlib>
#include <filesystem>

namespace majorant {

inline constexpr const char* kNoPublicData = "no ../shared/data/public";

// A folder of $MAJORANT_SHARED_DATA; empty where there is none.
inline std::filesystem::path public_data(const char* folder) {
  const char* root = std::getenv("MAJORANT_SHARED_DATA");
  if (root == nullptr) return {};
  std::filesystem::path path = std::filesystem::path(root) / folder;
  return std::filesystem::is_directory(path) ? path : std::filesystem::path();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
