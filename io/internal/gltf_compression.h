// Geometry that a glTF file holds compressed: EXT_meshopt_compression, of buffer views, and
// KHR_draco_mesh_compression, of primitives. Each is decoded by the library of its authors, where
// majorant was built with it.
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

// Returns whether the buffer has no bytes of its own: buffer views that are decoded fill it.
bool is_meshopt_fallback(const nlohmann::json& buffer);

struct GltfDecoding {
  // Throws: "PATH: problem; damaged file".
  std::function<void(const std::string& problem)> damaged;
  // Is called with the bytes that are held before they are allocated; throws beyond a limit.
  std::function<void(std::size_t bytes)> reserve;
};

// Each decodes all that is compressed by its extension, and removes the extension from the JSON.
// Lists of the JSON have been checked to be lists of objects. Without the library it does nothing.
void decode_meshopt(nlohmann::json& json, std::vector<std::string>& buffers,
                    const GltfDecoding& decoding);
// The accessors of a decoded primitive show buffers of their own, behind the others.
void decode_draco(nlohmann::json& json, std::vector<std::string>& buffers,
                  const GltfDecoding& decoding);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
