#include "majorant/io/internal/gltf_primitive.h"

#include <fmt/format.h>

#include <utility>

#include "majorant/io/internal/gltf_scene.h"

namespace majorant {
namespace {

std::vector<std::uint32_t> corners_of(const GltfDocument& document, const Gltf& primitive,
                                      std::size_t vertex_count, const std::string& where) {
  std::vector<std::uint32_t> corners;
  if (primitive.contains("indices")) {
    const GltfElements indices =
        document.elements(document.index(primitive, "indices", "primitives"), where + ": indices");
    const bool is_whole = indices.component == GltfComponent::UByte ||
                          indices.component == GltfComponent::UShort ||
                          indices.component == GltfComponent::UInt;
    if (indices.width != 1 || !is_whole) document.damaged(where + ": indices are no numbers");
    for (std::size_t k = 0; k < indices.count; ++k) corners.push_back(indices.integer(k));
  } else {
    corners.resize(vertex_count);
    for (std::size_t k = 0; k < corners.size(); ++k) corners[k] = static_cast<std::uint32_t>(k);
  }
  for (const std::uint32_t v : corners)
    if (v >= vertex_count)
      document.damaged(
          fmt::format("{}: index {} out of range, there are {}", where, v, vertex_count));
  return corners;
}

}  // namespace

// Returns whether a primitive is a surface.
bool has_triangles(const Gltf& primitive) {
  const auto mode = primitive.find("mode");
  const bool is_other = mode != primitive.end() && mode->is_number_unsigned() && *mode < kTriangles;
  return !is_other && primitive["attributes"].contains("POSITION");
}

std::vector<std::array<std::uint32_t, 3>> triangles_of(const GltfDocument& document,
                                                       const Gltf& primitive, std::size_t mode,
                                                       std::size_t vertex_count,
                                                       const std::string& where) {
  const std::vector<std::uint32_t> corners = corners_of(document, primitive, vertex_count, where);
  if (mode == kTriangles && corners.size() % 3 != 0)
    document.damaged(fmt::format("{}: {} corners are no triangles", where, corners.size()));
  constexpr std::size_t kBytesOfCorner = 32;  // at least, in the lists of polygons
  document.take(kBytesOfCorner * corners.size());
  std::vector<std::array<std::uint32_t, 3>> triangles;
  const std::size_t step = mode == kTriangles ? 3 : 1;
  for (std::size_t k = 0; k + 2 < corners.size(); k += step) {
    std::array<std::uint32_t, 3> triangle = {corners[k], corners[k + 1], corners[k + 2]};
    if (mode == kTriangleStrip && k % 2 == 1) std::swap(triangle[1], triangle[2]);
    if (mode == kTriangleFan) triangle[0] = corners[0];
    // Strips continue elsewhere through triangles without area.
    const bool is_stitch =
        triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0];
    if (mode == kTriangleStrip && is_stitch) continue;
    triangles.push_back(triangle);
  }
  return triangles;
}

GltfElements attribute(const GltfDocument& document, const Gltf& attributes,
                       const std::string& name, const std::string& where, std::size_t count,
                       std::size_t width) {
  GltfElements elements = document.elements(document.index(attributes, name.c_str(), "attributes"),
                                            where + ": " + name);
  if ((count > 0 && elements.count != count) || elements.width != width)
    document.damaged(fmt::format("{}: {} has {} elements of {} components", where, name,
                                 elements.count, elements.width));
  return elements;
}

// Returns all data that vertices must share to be the same.
std::vector<GltfElements> identity_of(const GltfDocument& document, const Gltf& primitive,
                                      const std::string& where, std::size_t count) {
  std::vector<GltfElements> lists;
  const Gltf& attributes = primitive["attributes"];
  if (const auto targets = primitive.find("targets"); targets != primitive.end()) {
    if (!targets->is_array()) document.damaged(where + ": targets are no list");
    for (const Gltf& target : *targets) {
      if (!target.is_object()) document.damaged(where + ": a target is no object");
      require_counts(document, target, where, count);
      if (target.contains("POSITION"))
        lists.push_back(attribute(document, target, "POSITION", where, count, 3));
    }
  }
  for (const char* name : {"JOINTS_0", "WEIGHTS_0", "JOINTS_1", "WEIGHTS_1"})
    if (attributes.contains(name))
      lists.push_back(attribute(document, attributes, name, where, count, 4));
  return lists;
}

void require_counts(const GltfDocument& document, const Gltf& attributes, const std::string& where,
                    std::size_t count) {
  for (const auto& [name, ignored] : attributes.items()) {
    const std::size_t accessor = document.index(attributes, name.c_str(), "attributes");
    if (const std::size_t other = document.count(accessor, name); other != count)
      document.damaged(
          fmt::format("{}: {} has {} elements, POSITION {}", where, name, other, count));
  }
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
