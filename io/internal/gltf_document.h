// A glTF 2.0 file: its JSON and the binary data that it names, every access checked. Compressed
// geometry is decoded (gltf_compression.h); all else of the JSON is kept as it is. Source: "glTF
// 2.0 Specification" (Khronos), 3.6 binary data, 4 GLB.
//
//   const GltfDocument document("cup.glb", read_whole_file("cup.glb"), {});
//   const GltfElements places = document.elements(0, "POSITION");
//   places.value(7, 2);   // z of the eighth
//
// Not for scenes: read_gltf.cpp knows what nodes and meshes mean.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "majorant/framework/stop_check.h"

namespace majorant {

using Gltf = nlohmann::json;

// componentType of an accessor, and the bytes that one has.
enum class GltfComponent { Byte = 5120, UByte, Short, UShort, UInt = 5125, Float };
std::size_t size_of(GltfComponent component);

// The elements of an accessor, one behind the other, sparse ones in their places.
struct GltfElements {
  GltfComponent component = GltfComponent::Float;
  std::size_t width = 1;    // components of an element
  bool normalized = false;  // integers stand for numbers from 0 or -1 to 1
  std::size_t count = 0;
  std::string bytes;  // little endian

  std::size_t element_size() const { return width * size_of(component); }
  std::string_view element(std::size_t k) const {
    return std::string_view(bytes).substr(k * element_size(), element_size());
  }
  double value(std::size_t element, std::size_t k) const;
  std::uint32_t integer(std::size_t element, std::size_t k = 0) const;
};

class GltfDocument {
 public:
  // path: of the file, for messages, and the folder that files of buffers are in. content: all of
  // it, GLB or JSON. Throws Error(Unreadable) for what is no glTF, damaged or truncated,
  // Error(Unsupported) for other versions, compressed geometry and images, extensions that must be
  // understood and are not, and files outside of the folder; Stopped.
  GltfDocument(const std::string& path, const std::string& content, const StopCheck& stop);

  const std::string& path() const { return path_; }
  const Gltf& json() const { return json_; }

  // The array of that name in the document, empty where there is none; all entries are objects.
  const Gltf& list(const char* name) const;
  // A number of `object`: of an entry of the list `name`. Throws where it is none, or not there.
  std::size_t index(const Gltf& object, const char* key, const char* name) const;
  std::optional<std::size_t> optional_index(const Gltf& object, const char* key,
                                            const char* name) const;

  // what: for messages. Throws Error(Unreadable) for elements that the file does not hold.
  GltfElements elements(std::size_t accessor, std::string_view what) const;

  std::size_t count(std::size_t accessor, std::string_view what) const;

  // Counts bytes that are made of the file. Throws Error(Unreadable) where they are far more than
  // it has: accessors without bytes stand for zeros, and any can be named again and again.
  void take(std::size_t bytes) const;

  // The bytes of the file that an image is: embedded, or beside the document. Throws
  // Error(Unreadable) where there are none.
  std::string image(std::size_t k, const StopCheck& stop) const;

  // The bytes of a buffer, of its byteLength.
  std::string_view buffer(std::size_t k) const { return buffers_[k]; }

  // Error(Unreadable): "PATH: problem; damaged file".
  [[noreturn]] void damaged(const std::string& problem) const;

 private:
  void parse(const std::string& content);
  void require_supported() const;
  void require_sound_lists() const;
  void load_buffers(const StopCheck& stop);
  void decode_geometry();
  std::string bytes_of(const std::string& uri, const char* name, const StopCheck& stop) const;
  std::string_view view(std::size_t k, std::size_t& stride) const;
  struct Layout {
    GltfElements elements;   // without their bytes
    std::string_view first;  // the bytes from the first one on; empty: zeros
    std::size_t stride = 0;
  };
  Layout layout(std::size_t accessor, std::string_view what) const;
  void scatter_sparse(const Gltf& sparse, GltfElements& out) const;

  std::string path_;
  Gltf json_;
  std::string binary_;  // chunk of a GLB
  bool has_binary_ = false;
  std::vector<std::string> buffers_;
  std::size_t given_ = 0;          // bytes of the file and its buffers
  mutable std::size_t taken_ = 0;  // bytes of elements until now
};

// Returns the JSON in a glTF file, without the data in it (JsonWithoutData), of its first bytes, at
// most so many. Of a GLB no more is read than the first chunk; empty where that is no JSON. Throws
// as read_whole_file().
std::string gltf_json(const std::string& path, std::size_t most, const StopCheck& stop = {});

// Returns whether a URI holds data itself.
bool is_data_uri(std::string_view uri);
// The name in a URI, escapes resolved.
std::string name_of_uri(const std::string& uri);

// The file that a relative URI names, escapes resolved, relative to the document's folder. Throws
// Error(Unsupported), beginning with `path`, for others, and for names that lead out of the folder.
std::string file_of_uri(const std::string& path, const std::string& uri);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
