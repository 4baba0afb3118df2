// What a primitive of a glTF document says, checked: its triangles, and attributes of its vertices.
// `where` names the primitive in messages; all throw Error(Unreadable) for what is damaged.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "majorant/io/internal/gltf_document.h"

namespace majorant {

// True where a primitive is a surface.
bool has_triangles(const Gltf& primitive);

// Corners of triangles, as numbers of vertices below vertex_count, of lists, strips and fans.
std::vector<std::array<std::uint32_t, 3>> triangles_of(const GltfDocument& document,
                                                       const Gltf& primitive, std::size_t mode,
                                                       std::size_t vertex_count,
                                                       const std::string& where);

// The attribute of this name, of `count` elements (0: any number) with `width` components.
GltfElements attribute(const GltfDocument& document, const Gltf& attributes,
                       const std::string& name, const std::string& where, std::size_t count,
                       std::size_t width);
// All that a vertex must share with another one to be the same.
std::vector<GltfElements> identity_of(const GltfDocument& document, const Gltf& primitive,
                                      const std::string& where, std::size_t count);
// Throws where an attribute, be it one that is not read, has another number of elements.
void require_counts(const GltfDocument& document, const Gltf& attributes, const std::string& where,
                    std::size_t count);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
