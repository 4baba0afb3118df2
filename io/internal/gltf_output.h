// A glTF file that is being written: its JSON and its binary data.
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

// The alignment of numbers in GLB files and accessors, in bytes.
inline constexpr std::size_t kGltfAlignment = 4;

template <class T>
void append_bytes(const T& value, std::string& bytes) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}
// Appends the nearest float. Throws Error(Invalid) beyond the range of floats.
void append_float(double value, std::string& bytes);

class GltfOutput {
 public:
  explicit GltfOutput(Gltf json) : json_(std::move(json)) {}

  Gltf& json() { return json_; }

  // The use of a buffer view (bufferView.target).
  enum class Target { None = 0, Vertices = 34962, Indices = 34963 };

  // Appends bytes and returns the number of their buffer view. stride: of elements; 0: none is
  // written.
  std::size_t add_view(std::string_view bytes, std::size_t stride, Target target);
  // Appends contiguous elements of this size; those of vertices are padded if necessary. entry: the
  // accessor without its buffer view.
  std::size_t add_accessor(Gltf entry, std::string_view bytes, std::size_t size, Target target);
  // Sets min and max, rounded to floats.
  void set_bounds(std::size_t accessor, const std::vector<double>& low,
                  const std::vector<double>& high);

  // Takes the bytes of a document's buffer views, which keep their numbers. Call it before others
  // are added.
  void take_buffers(const GltfDocument& document);
  // Removes accessors, textures, images and buffer views that the document refers to and this file
  // does not, unless unknown extensions may refer to them.
  void drop_unused(const GltfDocument& document);

  // These return the file as GLB, or as JSON with embedded data. glb() throws Error(Invalid) beyond
  // 4 GB.
  std::string glb() const;
  std::string text() const;

 private:
  Gltf with_buffer() const;
  void gather(const GltfDocument& document, const std::vector<std::string_view>& buffers);

  Gltf json_;
  std::string binary_;
};

// Adds an accessor of indices of triangles into `count` vertices, with the requested component type
// or a larger one. The largest number of a type is not an index.
std::size_t add_indices(GltfOutput& out, const std::vector<std::uint32_t>& indices,
                        std::size_t vertices, GltfComponent component);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
