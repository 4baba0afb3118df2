// Decodes compressed geometry of glTF files: EXT_meshopt_compression of buffer views, and
// KHR_draco_mesh_compression of primitives. Each needs its library in the build.
//
//   nlohmann::json json;                // of a document, beside its buffers
//   std::vector<std::string> buffers;
//   decode_meshopt(json, buffers, {});
//   decode_draco(json, buffers, {});    // names plain buffers now, and neither extension
//
// [glTF] EXT_meshopt_compression, KHR_draco_mesh_compression (Khronos' registry).
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace majorant {

inline constexpr std::string_view kMeshopt = "EXT_meshopt_compression";
inline constexpr std::string_view kDraco = "KHR_draco_mesh_compression";

// Returns whether the buffer has no bytes of its own, because decoded buffer views fill it.
bool is_meshopt_fallback(const nlohmann::json& buffer);

struct GltfDecoding {
  // Throws: "PATH: problem; damaged file".
  std::function<void(const std::string& problem)> damaged;
  // Called with the number of bytes before they are allocated; throws beyond a limit.
  std::function<void(std::size_t bytes)> reserve;
};

// Each function decodes all data of its extension, and removes the extension from the JSON. The
// lists in the JSON must be lists of objects. Without the library it does nothing.
void decode_meshopt(nlohmann::json& json, std::vector<std::string>& buffers,
                    const GltfDecoding& decoding);
// Accessors of decoded primitives get buffers of their own, behind the others.
void decode_draco(nlohmann::json& json, std::vector<std::string>& buffers,
                  const GltfDecoding& decoding);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
