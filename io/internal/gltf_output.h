// A glTF file that is being written: JSON, and binary data behind those that it had.
//
//   GltfOutput out(Gltf{{"asset", {{"version", "2.0"}}}});
//   std::string bytes;
//   append_float(0.5, bytes);
//   out.add_accessor({{"componentType", 5126}, {"type", "SCALAR"}, {"count", 1}}, bytes, 4,
//                    GltfOutput::Target::Vertices);
//   const std::string file = out.glb();
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "majorant/io/internal/gltf_document.h"

namespace majorant {

// Where GLB and accessors want numbers: multiples of this.
inline constexpr std::size_t kGltfAlignment = 4;

template <class T>
void append_bytes(const T& value, std::string& bytes) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}
// Rounded to the nearest float. Throws Error(Invalid) beyond their range.
void append_float(double value, std::string& bytes);

class GltfOutput {
 public:
  explicit GltfOutput(Gltf json) : json_(std::move(json)) {}

  Gltf& json() { return json_; }

  // What the buffer views are for (bufferView.target).
  enum class Target { None = 0, Vertices = 34962, Indices = 34963 };

  // Bytes behind all others; the buffer view's number. stride: of elements, 0: none is said.
  std::size_t add_view(std::string_view bytes, std::size_t stride, Target target);
  // Adds elements of this size, one behind the other; those of vertices are padded where they have
  // to. entry: the accessor but for its buffer view.
  std::size_t add_accessor(Gltf entry, std::string_view bytes, std::size_t size, Target target);
  // min and max of what was rounded to floats.
  void set_bounds(std::size_t accessor, const std::vector<double>& low,
                  const std::vector<double>& high);

  // Takes the bytes of a document's buffer views, which keep their numbers. Before any is added.
  void take_buffers(const GltfDocument& document);
  // Removes accessors, textures, images and buffer views that the document refers to and this file
  // does not, unless there are extensions that may.
  void drop_unused(const GltfDocument& document);

  // The file: GLB, or JSON with its data in it. glb() throws Error(Invalid) beyond 4 GB.
  std::string glb() const;
  std::string text() const;

 private:
  Gltf with_buffer() const;
  void gather(const GltfDocument& document, const std::vector<std::string_view>& buffers);

  Gltf json_;
  std::string binary_;
};

// An accessor of indices of triangles into so many vertices, of components of the type that is
// asked for, or larger ones. The largest number of a type is no index.
std::size_t add_indices(GltfOutput& out, const std::vector<std::uint32_t>& indices,
                        std::size_t vertices, GltfComponent component);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
