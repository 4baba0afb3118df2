#include "majorant/io/internal/gltf_content.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/io/byte_cursor.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/files_below.h"
#include "majorant/io/internal/gltf_compression.h"
#include "majorant/io/internal/json_strings.h"
#include "majorant/io/json_depth.h"
#include "majorant/io/read_mesh.h"

namespace majorant {
namespace {

constexpr std::uint32_t kVersion = 2;
constexpr std::size_t kHeader = 12, kChunkHeader = 8;
constexpr std::string_view kMagic = "glTF";
constexpr std::uint32_t kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;

// decoding: the library that decodes it, for messages; none: not supported.
struct Compression {
  std::string_view extension, name, decoding;
};
constexpr std::array<Compression, 4> kCompressions = {{
    {kDraco, "Draco compression", "Draco (libdraco-dev)"},
    {kMeshopt, "meshopt compression", "meshoptimizer (libmeshoptimizer-dev)"},
    {"KHR_meshopt_compression", "meshopt compression", ""},
    {"KHR_texture_basisu", "KTX2 textures", ""},
}};

bool is_decoded(std::string_view extension) {
  return (extension == kDraco && has_draco()) || (extension == kMeshopt && has_meshopt());
}

// Supported values of extensionsRequired: geometry does not depend on them, or is read accordingly.
constexpr std::array<std::string_view, 8> kUnderstood = {
    "KHR_mesh_quantization", "KHR_texture_transform", "KHR_lights_punctual",
    "KHR_animation_pointer", "KHR_xmp_json_ld",       "EXT_mesh_gpu_instancing",
    "EXT_texture_webp",      "EXT_texture_avif"};
constexpr std::string_view kMaterials = "KHR_materials_";

constexpr std::array<const char*, 11> kLists = {"accessors", "animations", "buffers", "bufferViews",
                                                "images",    "materials",  "meshes",  "nodes",
                                                "scenes",    "skins",      "textures"};

[[noreturn]] void refuse_gltf(const std::string& path, const std::string& what) {
  throw Error(ErrorKind::Unsupported, fmt::format("{}: {}", path, what));
}

std::uint32_t number_at(std::string_view content, std::size_t place) {
  return load_bytes<std::uint32_t>(content.data() + place, ByteOrder::Little);
}

// Returns the parts of a file, GLB or JSON.
GltfContent split_chunks(const std::string& path, const std::string& content) {
  GltfContent parts;
  std::string text;
  if (!content.starts_with(kMagic)) {
    text = content;
    require_text(path, text);
  } else {
    const auto truncated = [&] {
      throw Error(ErrorKind::Unreadable, path + ": the file is truncated");
    };
    if (content.size() < kHeader + kChunkHeader) truncated();
    if (const std::uint32_t version = number_at(content, 4); version != kVersion)
      refuse_gltf(path,
                  fmt::format("GLB of version {}, read is 2; export it as glTF 2.0", version));
    if (number_at(content, 8) > content.size()) truncated();
    for (std::size_t at = kHeader, chunk = 0; at + kChunkHeader <= content.size(); ++chunk) {
      const std::size_t size = number_at(content, at);
      const std::uint32_t kind = number_at(content, at + 4);
      at += kChunkHeader;
      if (size > content.size() - at) truncated();
      if (chunk == 0 && kind != kJsonChunk) damaged_gltf(path, "its first chunk is no JSON");
      if (chunk == 0) text = content.substr(at, size);
      if (chunk == 1 && kind == kBinaryChunk) parts.binary = content.substr(at, size);
      at += size;
    }
  }
  require_shallow_json(path, text);
  try {
    parts.json = Gltf::parse(text);
  } catch (const Gltf::exception&) {
    throw Error(ErrorKind::Unreadable, path + ": broken JSON; no glTF file, or truncated");
  }
  if (!parts.json.is_object()) damaged_gltf(path, "no JSON object");
  return parts;
}

// Throws for other versions of the format and for extensions that are not supported.
void require_supported(const std::string& path, const Gltf& json) {
  const auto asset = json.find("asset");
  if (asset == json.end() || !asset->is_object() || !asset->contains("version") ||
      !(*asset)["version"].is_string())
    damaged_gltf(path, "it has no asset.version; no glTF file");
  if (const auto version = (*asset)["version"].get<std::string>(); !version.starts_with("2."))
    refuse_gltf(path, fmt::format("glTF of version {}, read is 2; export it as glTF 2.0",
                                  in_quotes(version)));
  for (const char* key : {"extensionsUsed", "extensionsRequired"}) {
    const auto names = json.find(key);
    if (names == json.end()) continue;
    if (!names->is_array()) damaged_gltf(path, fmt::format("{} is no list", key));
    for (const Gltf& entry : *names) {
      if (!entry.is_string())
        damaged_gltf(path, fmt::format("{} has an entry that is no name", key));
      const auto name = entry.get<std::string>();
      for (const Compression& known : kCompressions)
        if (name == known.extension && !is_decoded(name))
          refuse_gltf(
              path,
              fmt::format(
                  "{} ({}) is not read{}; export the model without it", known.name, known.extension,
                  known.decoding.empty()
                      ? ""
                      : fmt::format(", since this majorant was built without {}", known.decoding)));
      const bool is_understood =
          is_decoded(name) || name.starts_with(kMaterials) ||
          std::find(kUnderstood.begin(), kUnderstood.end(), name) != kUnderstood.end();
      if (std::string_view(key) == "extensionsRequired" && !is_understood)
        refuse_gltf(path, fmt::format("it requires the extension {}, which is not read; export the "
                                      "model without it",
                                      in_quotes(name)));
    }
  }
}

// Throws unless all lists are lists of objects and images can be found.
void require_sound_lists(const std::string& path, const Gltf& json) {
  for (const char* name : kLists) {
    const auto list = json.find(name);
    if (list == json.end()) continue;
    if (!list->is_array()) damaged_gltf(path, fmt::format("{} is no list", name));
    for (const Gltf& entry : *list)
      if (!entry.is_object()) damaged_gltf(path, fmt::format("an entry of {} is no object", name));
  }
  for (const Gltf& image : gltf_list(json, "images")) {
    const std::string kind = image.contains("mimeType") && image["mimeType"].is_string()
                                 ? image["mimeType"].get<std::string>()
                                 : "";
    if (kind == "image/ktx2")
      refuse_gltf(path, "KTX2 textures are not read; export the model without them");
    if (!image.contains("uri")) continue;
    if (!image["uri"].is_string()) damaged_gltf(path, "images: uri is no text");
    if (const auto uri = image["uri"].get<std::string>(); !is_data_uri(uri)) file_of_uri(path, uri);
  }
}

}  // namespace

void damaged_gltf(const std::string& path, const std::string& problem) {
  throw Error(ErrorKind::Unreadable, fmt::format("{}: {}; damaged file", path, problem));
}

GltfContent parse_gltf(const std::string& path, const std::string& content) {
  GltfContent parts = split_chunks(path, content);
  require_supported(path, parts.json);
  require_sound_lists(path, parts.json);
  return parts;
}

const Gltf& gltf_list(const Gltf& json, const char* name) {
  static const Gltf kNone = Gltf::array();
  const auto found = json.find(name);
  return found == json.end() ? kNone : *found;
}

std::string gltf_json(const std::string& path, std::size_t most, const StopCheck& stop) {
  constexpr std::size_t kStart = kHeader + kChunkHeader;
  JsonWithoutData json;
  // The positions in the file of the block, and of the JSON.
  std::size_t at = 0, begin = 0, end = most;
  read_blocks(
      path,
      [&](std::string_view block) {
        if (at == 0 && block.starts_with(kMagic)) {
          begin = end = kStart;
          if (block.size() >= kStart && number_at(block, kHeader + 4) == kJsonChunk)
            end += std::min<std::size_t>(most, number_at(block, kHeader));
        }
        block = block.substr(0, std::max(at, end) - at);
        if (at + block.size() > begin) json.append(block.substr(std::max(at, begin) - at));
        at += block.size();
        return at < end;
      },
      stop);
  return json.take();
}

bool is_data_uri(std::string_view uri) { return uri.starts_with("data:"); }

std::string name_of_uri(const std::string& uri) {
  std::string text;
  for (std::size_t k = 0; k < uri.size(); ++k) {
    const std::string digits = uri.substr(k + 1, 2);
    const bool is_escape = uri[k] == '%' && digits.size() == 2 &&
                           digits.find_first_not_of("0123456789abcdefABCDEF") == std::string::npos;
    text += is_escape ? static_cast<char>(std::stoi(digits, nullptr, 16)) : uri[k];
    if (is_escape) k += 2;
  }
  return text;
}

std::string file_of_uri(const std::string& path, const std::string& uri) {
  const std::string name = name_of_uri(uri);
  if (name.find('\\') != std::string::npos || !is_below(path, name))
    refuse_gltf(path,
                fmt::format("it names the file {}, and files are read from its own folder and "
                            "those below alone; copy it there, or embed it",
                            in_quotes(name)));
  return (std::filesystem::path(path).parent_path() / name).string();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
