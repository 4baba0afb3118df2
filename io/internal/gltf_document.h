// A glTF 2.0 file: its JSON and its binary data, with every access checked. Compressed geometry is
// decoded (gltf_compression.h); the rest of the JSON is kept. Source: "glTF 2.0 Specification"
// (Khronos), 3.6 binary data.
//
//   const GltfDocument document("cup.glb", read_whole_file("cup.glb"), {});
//   const GltfElements places = document.elements(0, "POSITION");
//   places.value(7, 2);   // z of the eighth vertex
//
// Not for scenes: read_gltf.cpp interprets nodes and meshes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/io/internal/gltf_content.h"

namespace majorant {

// componentType of an accessor; the enumerators are glTF's numbers.
enum class GltfComponent { Byte = 5120, UByte, Short, UShort, UInt = 5125, Float };
std::size_t size_of(GltfComponent component);

// The elements of an accessor, contiguous; sparse ones are filled in.
struct GltfElements {
  GltfComponent component = GltfComponent::Float;
  std::size_t width = 1;    // components of an element
  bool normalized = false;  // integers represent numbers from 0 or -1 to 1
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
  // path: for messages, and for the folder of buffer files. content: the whole file, GLB or JSON.
  // Throws Error(Unreadable) for files that are not glTF, damaged or truncated. Throws
  // Error(Unsupported) for other versions, unknown compression, extensions that are required but
  // unknown, and files outside of the folder; Stopped.
  GltfDocument(const std::string& path, const std::string& content, const StopCheck& stop);

  const std::string& path() const { return path_; }
  const Gltf& json() const { return json_; }

  // Returns the array of that name in the document, empty if it is missing. All entries are
  // objects.
  const Gltf& list(const char* name) const { return gltf_list(json_, name); }
  // Returns a number of `object`, an index into the list `name`. Throws if it is missing or out of
  // range.
  std::size_t index(const Gltf& object, const char* key, const char* name) const;
  std::optional<std::size_t> optional_index(const Gltf& object, const char* key,
                                            const char* name) const;

  // what: for messages. Throws Error(Unreadable) if the file lacks the elements.
  GltfElements elements(std::size_t accessor, std::string_view what) const;

  std::size_t count(std::size_t accessor, std::string_view what) const;

  // Counts bytes that are generated from the file. Throws Error(Unreadable) if they far exceed its
  // size: accessors without bytes are zeros, and any accessor can be named repeatedly.
  void take(std::size_t bytes) const;

  // Returns the bytes of an image, embedded or beside the document. Throws Error(Unreadable) if
  // there are none.
  std::string image(std::size_t k, const StopCheck& stop) const;

  // Returns the bytes of a buffer, as many as its byteLength.
  std::string_view buffer(std::size_t k) const { return buffers_[k]; }

  // Throws Error(Unreadable): "PATH: problem; damaged file".
  [[noreturn]] void damaged(const std::string& problem) const { damaged_gltf(path_, problem); }

 private:
  void load_buffers(std::optional<std::string> binary, const StopCheck& stop);
  void decode_geometry();
  std::string bytes_of(const std::string& uri, const char* name, const StopCheck& stop) const;
  std::string_view view(std::size_t k, std::size_t& stride) const;
  struct Layout {
    GltfElements elements;   // without their bytes
    std::string_view first;  // from the first byte on; empty: zeros
    std::size_t stride = 0;
  };
  Layout layout(std::size_t accessor, std::string_view what) const;
  void scatter_sparse(const Gltf& sparse, GltfElements& out) const;

  std::string path_;
  Gltf json_;
  std::vector<std::string> buffers_;
  std::size_t given_ = 0;          // bytes of the file and its buffers
  mutable std::size_t taken_ = 0;  // bytes of elements so far
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
