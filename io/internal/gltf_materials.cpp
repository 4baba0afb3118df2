#include "majorant/io/internal/gltf_materials.h"

#include <fmt/format.h>

#include <algorithm>

namespace majorant {
namespace {

constexpr const char* kVariants = "KHR_materials_variants";

// Calls visit(info) with every reference to a texture in a material.
template <class Visit>
void visit_textures(Gltf& value, const Visit& visit) {
  if (!value.is_object()) return;
  for (auto& [key, member] : value.items()) {
    if (key == "extras" || !member.is_object()) continue;
    const bool is_texture =
        (key.ends_with("Texture") || key.ends_with("texture")) && member.contains("index");
    if (is_texture) visit(member);
    visit_textures(member, visit);
  }
}

// Returns the member that names the coordinates of a texture; KHR_texture_transform may replace it.
Gltf* transformed_set(Gltf& texture) {
  if (!texture.contains("extensions") || !texture["extensions"].is_object()) return nullptr;
  Gltf& extensions = texture["extensions"];
  if (!extensions.contains("KHR_texture_transform")) return nullptr;
  Gltf& transform = extensions["KHR_texture_transform"];
  return transform.is_object() && transform.contains("texCoord") ? &transform["texCoord"] : nullptr;
}

bool is_shown_by(const Gltf& texture, std::size_t set) {
  return texture.contains("texCoord") ? texture["texCoord"] == set : set == 0;
}

Gltf* mappings(Gltf& primitive) {
  if (!primitive.is_object() || !primitive.contains("extensions")) return nullptr;
  Gltf& extensions = primitive["extensions"];
  if (!extensions.is_object() || !extensions.contains(kVariants)) return nullptr;
  Gltf& variants = extensions[kVariants];
  return variants.is_object() && variants.contains("mappings") && variants["mappings"].is_array()
             ? &variants["mappings"]
             : nullptr;
}

std::set<std::size_t> materials_of(const Gltf& primitive) {
  std::set<std::size_t> used;
  const auto add = [&](const Gltf& object) {
    if (object.is_object() && object.contains("material") &&
        object["material"].is_number_unsigned())
      used.insert(object["material"].get<std::size_t>());
  };
  add(primitive);
  Gltf copy = primitive;
  if (const Gltf* variants = mappings(copy))
    for (const Gltf& mapping : *variants) add(mapping);
  return used;
}

}  // namespace

std::string texcoord_name(std::size_t set) { return fmt::format("TEXCOORD_{}", set); }

std::size_t next_set(const Gltf& attributes) {
  std::size_t set = 0;
  while (attributes.contains(texcoord_name(set))) ++set;
  return set;
}

MovedMaterials::MovedMaterials(Gltf& json, std::size_t old_set) : json_(json), old_set_(old_set) {
  if (json_.contains("materials"))
    for (Gltf& material : json_["materials"]) {
      bool uses = false;
      visit_textures(material, [&](Gltf& texture) {
        const Gltf* set = transformed_set(texture);
        uses = uses || is_shown_by(texture, old_set_) || (set && *set == old_set_);
      });
      uses_old_set_.push_back(uses);
    }
  if (json_.contains("materials")) before_ = json_["materials"];
}

bool MovedMaterials::uses_old_set(const Gltf& primitive) const {
  const std::set<std::size_t> used = materials_of(primitive);
  return std::any_of(used.begin(), used.end(),
                     [&](std::size_t k) { return k < uses_old_set_.size() && uses_old_set_[k]; });
}

void MovedMaterials::move(Gltf& primitive, std::size_t set) {
  if (primitive.contains("material")) move_reference(primitive["material"], set);
  if (Gltf* variants = mappings(primitive))
    for (Gltf& mapping : *variants)
      if (mapping.is_object() && mapping.contains("material"))
        move_reference(mapping["material"], set);
}

void MovedMaterials::move_reference(Gltf& reference, std::size_t set) {
  if (!reference.is_number_unsigned()) return;
  const auto k = reference.get<std::size_t>();
  if (k >= uses_old_set_.size() || !uses_old_set_[k]) return;
  const auto [entry, is_new] = moved_.try_emplace({k, set}, json_["materials"].size());
  if (is_new) {
    Gltf material = before_[k];
    visit_textures(material, [&](Gltf& texture) {
      if (is_shown_by(texture, old_set_)) texture["texCoord"] = set;
      if (Gltf* transformed = transformed_set(texture); transformed && *transformed == old_set_)
        *transformed = set;
    });
    if (is_changed_.insert(k).second) {
      entry->second = k;
      json_["materials"][k] = std::move(material);
    } else {
      json_["materials"].push_back(std::move(material));
    }
  }
  reference = entry->second;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
