// Materials of a glTF file whose texture coordinates move from one set to another: copies are made
// where some primitives still show by the old set.
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "majorant/io/internal/gltf_document.h"

namespace majorant {

std::string texcoord_name(std::size_t set);
// The first set of texture coordinates that a primitive does not have.
std::size_t next_set(const Gltf& attributes);

// Materials that show textures by the old coordinates, of this set, and those that show them by
// another one. Variants of a primitive (KHR_materials_variants) move with it.
class MovedMaterials {
 public:
  // json: of the output, which outlives this.
  MovedMaterials(Gltf& json, std::size_t old_set);

  bool uses_old_set(const Gltf& primitive) const;
  // Gives the primitive materials that show by `set` what they have shown by the old one.
  void move(Gltf& primitive, std::size_t set);

 private:
  void move_reference(Gltf& reference, std::size_t set);

  Gltf& json_;
  std::size_t old_set_;
  Gltf before_;
  std::vector<char> uses_old_set_;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> moved_;  // material, set: the new one
  std::set<std::size_t> is_changed_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
