// The checked contents of a glTF primitive: its triangles, and attributes of its vertices. `where`
// names the primitive in messages. All functions throw Error(Unreadable) for damaged data.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "majorant/io/internal/gltf_document.h"

namespace majorant {

// Returns whether a primitive is a surface.
bool has_triangles(const Gltf& primitive);

// Returns the corners of triangles in lists, strips and fans, as numbers of vertices below
// vertex_count.
std::vector<std::array<std::uint32_t, 3>> triangles_of(const GltfDocument& document,
                                                       const Gltf& primitive, std::size_t mode,
                                                       std::size_t vertex_count,
                                                       const std::string& where);

// Returns the attribute of this name, with `count` elements (0: any number) of `width` components.
GltfElements attribute(const GltfDocument& document, const Gltf& attributes,
                       const std::string& name, const std::string& where, std::size_t count,
                       std::size_t width);
// Returns all data that vertices must share to be the same.
std::vector<GltfElements> identity_of(const GltfDocument& document, const Gltf& primitive,
                                      const std::string& where, std::size_t count);
// Throws if an attribute has another number of elements, even one that is not read.
void require_counts(const GltfDocument& document, const Gltf& attributes, const std::string& where,
                    std::size_t count);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
