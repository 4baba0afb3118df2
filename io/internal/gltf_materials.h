// Moves texture coordinates of glTF materials from one set to another. Materials are copied if
// other primitives still use the old set.
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "majorant/io/internal/gltf_document.h"

namespace majorant {

std::string texcoord_name(std::size_t set);
// Returns the first set of texture coordinates that a primitive lacks.
std::size_t next_set(const Gltf& attributes);

// Materials that show textures by the old set, and their copies for another set. Variants of a
// primitive (KHR_materials_variants) are moved with it.
class MovedMaterials {
 public:
  // json: of the output; must outlive this.
  MovedMaterials(Gltf& json, std::size_t old_set);

  bool uses_old_set(const Gltf& primitive) const;
  // Gives the primitive materials that use `set` instead of the old set.
  void move(Gltf& primitive, std::size_t set);

 private:
  void move_reference(Gltf& reference, std::size_t set);

  Gltf& json_;
  std::size_t old_set_;
  Gltf before_;
  std::vector<char> uses_old_set_;
  // (material, set) -> new material
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> moved_;
  std::set<std::size_t> is_changed_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
