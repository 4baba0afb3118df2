// The content of a glTF 2.0 file, JSON or GLB, before its buffers are read, and the URIs in it.
// Source: "glTF 2.0 Specification" (Khronos), 4 GLB.
//
//   const GltfContent content = parse_gltf("cup.glb", read_whole_file("cup.glb"));
//   for (const Gltf& image : gltf_list(content.json, "images"))
//     if (image.contains("uri")) image["uri"];
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "majorant/framework/stop_check.h"

namespace majorant {

using Gltf = nlohmann::json;

struct GltfContent {
  Gltf json;                          // an object
  std::optional<std::string> binary;  // the binary chunk of a GLB
};

// path: for messages, and for the folder of other files. Throws Error(Unreadable) for files that
// are not glTF, damaged or truncated. Throws Error(Unsupported) for other versions, unknown
// compression, extensions that are required but unknown, and images outside of the folder.
GltfContent parse_gltf(const std::string& path, const std::string& content);

// Returns the array of that name in a document, empty if it is missing. After parse_gltf() all
// entries are objects.
const Gltf& gltf_list(const Gltf& json, const char* name);

// Throws Error(Unreadable): "PATH: problem; damaged file".
[[noreturn]] void damaged_gltf(const std::string& path, const std::string& problem);

// Returns the JSON of a glTF file without embedded data (JsonWithoutData), from at most its first
// `most` bytes. Of a GLB only the first chunk is read; the result is empty if that is no JSON.
// Throws the errors of read_whole_file().
std::string gltf_json(const std::string& path, std::size_t most, const StopCheck& stop = {});

// Returns whether a URI holds data itself.
bool is_data_uri(std::string_view uri);
// Returns the name in a URI with escapes resolved.
std::string name_of_uri(const std::string& uri);

// Returns the file that a relative URI names, relative to the document's folder, with escapes
// resolved. Throws Error(Unsupported), beginning with `path`, for other URIs, and for names outside
// of the folder.
std::string file_of_uri(const std::string& path, const std::string& uri);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
