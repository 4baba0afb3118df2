#include "majorant/io/gltf_texture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <compare>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/internal/gltf_output.h"
#include "majorant/io/internal/gltf_scene.h"

namespace majorant {
namespace {

constexpr const char* kMetallic = "pbrMetallicRoughness";
constexpr const char* kBaseColor = "baseColorTexture";
constexpr const char* kTransform = "KHR_texture_transform";
constexpr const char* kVariantsExtension = "KHR_materials_variants";

using Primitive = std::pair<std::size_t, std::size_t>;  // mesh, primitive

// Returns a material's reference to its base colour texture; null if it has none.
const Gltf* base_color_of(const Gltf& material) {
  const auto metallic = material.find(kMetallic);
  if (metallic == material.end() || !metallic->is_object()) return nullptr;
  const auto texture = metallic->find(kBaseColor);
  return texture == metallic->end() || !texture->is_object() ? nullptr : &*texture;
}

std::optional<std::size_t> material_of(const GltfDocument& document, const Gltf& primitive) {
  const auto k = document.optional_index(primitive, "material", "primitives");
  if (k && *k >= document.list("materials").size())
    document.damaged(fmt::format("primitives: no material {}", *k));
  return k;
}

const Gltf& primitive_at(const GltfDocument& document, const Primitive& which) {
  return document.list("meshes")[which.first]["primitives"][which.second];
}

// The image of a base colour texture with its wrapS and wrapT.
struct ShownImage {
  std::size_t image = 0;
  std::array<BaseColors::Wrap, 2> wrap{};
  auto operator<=>(const ShownImage&) const = default;
};

BaseColors::Wrap wrap_of(const GltfDocument& document, const Gltf& sampler, const char* key) {
  constexpr std::size_t kClamp = 33071, kMirror = 33648, kRepeat = 10497;
  const std::size_t wrap = document.optional_index(sampler, key, "samplers").value_or(kRepeat);
  if (wrap != kClamp && wrap != kMirror && wrap != kRepeat)
    document.damaged(fmt::format("samplers: {} is {}, which is no way to wrap", key, wrap));
  return wrap == kClamp    ? BaseColors::Wrap::Clamp
         : wrap == kMirror ? BaseColors::Wrap::Mirror
                           : BaseColors::Wrap::Repeat;
}

// set: the texture coordinates that the mesh was read with.
ShownImage image_of(const GltfDocument& document, const Gltf& reference, std::size_t set) {
  const auto refuse = [&](const char* what) {
    throw Error(ErrorKind::Unsupported,
                fmt::format("{}: a base colour texture {}; such textures are not baked",
                            document.path(), what));
  };
  const std::string other = fmt::format("uses another set of coordinates than TEXCOORD_{}", set);
  if (document.optional_index(reference, "texCoord", "materials").value_or(0) != set)
    refuse(other.c_str());
  if (reference.contains("extensions") && reference["extensions"].is_object() &&
      reference["extensions"].contains(kTransform))
    refuse("is scaled or moved (KHR_texture_transform)");
  const std::size_t texture = document.index(reference, "index", "materials");
  const Gltf& textures = document.list("textures");
  if (texture >= textures.size()) document.damaged(fmt::format("no texture {}", texture));
  if (!textures[texture].contains("source")) refuse("is neither PNG nor JPEG");
  ShownImage shown{document.index(textures[texture], "source", "textures")};
  if (const auto sampler = document.optional_index(textures[texture], "sampler", "textures")) {
    const Gltf& samplers = document.list("samplers");
    if (*sampler >= samplers.size()) document.damaged(fmt::format("no sampler {}", *sampler));
    shown.wrap = {wrap_of(document, samplers[*sampler], "wrapS"),
                  wrap_of(document, samplers[*sampler], "wrapT")};
  }
  return shown;
}

// Calls visit(material) with every material number in variants (KHR_materials_variants).
template <class Visit>
void visit_variants(const Gltf& primitive, const Visit& visit) {
  const auto extensions = primitive.find("extensions");
  if (extensions == primitive.end() || !extensions->is_object()) return;
  const auto variants = extensions->find(kVariantsExtension);
  if (variants == extensions->end() || !variants->is_object()) return;
  const auto mappings = variants->find("mappings");
  if (mappings == variants->end() || !mappings->is_array()) return;
  for (const Gltf& mapping : *mappings)
    if (mapping.is_object() && mapping.contains("material") &&
        mapping["material"].is_number_unsigned())
      visit(mapping["material"].get<std::size_t>());
}

// Returns whether a material, or a part of one, shows a texture by this set of coordinates.
bool shows_by(const Gltf& value, std::size_t set) {
  if (!value.is_object()) return false;
  for (const auto& [key, member] : value.items()) {
    if (key == "extras" || !member.is_object()) continue;
    const bool is_texture = key == kTransform
                                ? member.contains("texCoord")
                                : (key.ends_with("Texture") || key.ends_with("texture"));
    if (is_texture && member.value("texCoord", Gltf(0U)) == set) return true;
    if (shows_by(member, set)) return true;
  }
  return false;
}

class Replacement {
 public:
  Replacement(const GltfScene& scene, const std::string& png)
      : scene_(scene), document_(scene.document), out_(document_.json()) {
    out_.take_buffers(document_);
    for (const GltfScene::Vertices& vertices : scene.vertices)
      for (const std::size_t p : vertices.primitives) triangles_.insert({vertices.mesh, p});
    find_shared();
    add_texture(png);
  }

  GltfOutput run() {
    for (const Primitive& which : triangles_) show(which);
    for (const GltfScene::Vertices& vertices : scene_.vertices) drop_old_set(vertices);
    out_.drop_unused(document_);
    return std::move(out_);
  }

 private:
  // Finds materials that variants, points or lines use, too. Those keep their textures.
  void find_shared() {
    const Gltf& meshes = document_.list("meshes");
    for (std::size_t m = 0; m < meshes.size(); ++m)
      for (std::size_t p = 0; p < meshes[m]["primitives"].size(); ++p) {
        const Gltf& primitive = meshes[m]["primitives"][p];
        visit_variants(primitive, [&](std::size_t k) { shared_.insert(k); });
        if (triangles_.contains({m, p})) continue;
        if (const auto k = material_of(document_, primitive)) shared_.insert(*k);
      }
  }

  // Adds the texture with the sampler of the first one that it replaces. Its coordinates lie in
  // the unit square.
  void add_texture(const std::string& png) {
    Gltf& file = out_.json();
    Gltf texture{{"source", file.contains("images") ? file["images"].size() : 0}};
    for (const Primitive& which : triangles_)
      if (const auto k = material_of(document_, primitive_at(document_, which)))
        if (const Gltf* const old = base_color_of(document_.list("materials")[*k])) {
          const Gltf& before =
              document_.list("textures").at(document_.index(*old, "index", "materials"));
          if (before.contains("sampler")) texture["sampler"] = before["sampler"];
          break;
        }
    file["images"].push_back({{"bufferView", out_.add_view(png, 0, GltfOutput::Target::None)},
                              {"mimeType", "image/png"}});
    texture_ = file.contains("textures") ? file["textures"].size() : 0;
    file["textures"].push_back(std::move(texture));
  }

  void show(const Primitive& which) {
    const auto k = material_of(document_, primitive_at(document_, which));
    if (!k) return;
    const Gltf& before = document_.list("materials")[*k];
    if (base_color_of(before) == nullptr) return;
    const auto [entry, is_new] = replaced_.try_emplace(*k, *k);
    Gltf& materials = out_.json()["materials"];
    if (is_new) {
      Gltf material = before;
      material[kMetallic][kBaseColor] = {{"index", texture_}};
      if (shared_.contains(*k)) {
        entry->second = materials.size();
        materials.push_back(std::move(material));
      } else {
        materials[*k] = std::move(material);
      }
    }
    out_.json()["meshes"][which.first]["primitives"][which.second]["material"] = entry->second;
  }

  // Removes the last set of coordinates if only replaced base colours used it.
  void drop_old_set(const GltfScene::Vertices& vertices) {
    const auto primitive = [&](std::size_t p) -> Gltf& {
      return out_.json()["meshes"][vertices.mesh]["primitives"][p];
    };
    const Gltf& attributes = primitive(vertices.primitives.front())["attributes"];
    std::size_t last = 0;
    while (attributes.contains(fmt::format("TEXCOORD_{}", last + 1))) ++last;
    bool was_shown = false, is_shown = false;
    const Gltf& materials = out_.json()["materials"];
    for (const std::size_t p : vertices.primitives) {
      if (const auto k = material_of(document_, primitive_at(document_, {vertices.mesh, p}))) {
        const Gltf* const old = base_color_of(document_.list("materials")[*k]);
        was_shown = was_shown || (old != nullptr && old->value("texCoord", Gltf(0U)) == last);
        is_shown =
            is_shown || shows_by(materials[primitive(p)["material"].get<std::size_t>()], last);
      }
      visit_variants(primitive(p), [&](std::size_t k) {
        is_shown = is_shown || k >= materials.size() || shows_by(materials[k], last);
      });
    }
    if (last == 0 || !was_shown || is_shown) return;
    const std::string name = fmt::format("TEXCOORD_{}", last);
    for (const std::size_t p : vertices.primitives) {
      primitive(p)["attributes"].erase(name);
      if (primitive(p).contains("targets"))
        for (Gltf& target : primitive(p)["targets"]) target.erase(name);
    }
  }

  const GltfScene& scene_;
  const GltfDocument& document_;
  GltfOutput out_;
  std::set<Primitive> triangles_;
  std::set<std::size_t> shared_;                 // materials with other uses
  std::map<std::size_t, std::size_t> replaced_;  // old material -> material with the new texture
  std::size_t texture_ = 0;
};

}  // namespace

BaseColors base_colors(const PolygonMesh& mesh, const StopCheck& stop) {
  const GltfScene& scene = *mesh.gltf;
  const GltfDocument& document = scene.document;
  BaseColors colors;
  std::map<ShownImage, int> number_of_image;
  std::map<Primitive, int> number_of_primitive;
  const auto number = [&](const Primitive& which) {
    const auto k = material_of(document, primitive_at(document, which));
    const Gltf* const reference = k ? base_color_of(document.list("materials")[*k]) : nullptr;
    if (reference == nullptr) return -1;
    const ShownImage shown = image_of(document, *reference, scene.texcoord_set);
    const auto [entry, is_new] =
        number_of_image.try_emplace(shown, static_cast<int>(colors.images.size()));
    if (is_new)
      colors.images.push_back({document.image(shown.image, stop),
                               fmt::format("{}, image {}", document.path(), shown.image),
                               shown.wrap});
    return entry->second;
  };
  for (const GltfScene::Face& face : scene.faces) {
    const Primitive which{scene.vertices[to_size(face.vertices)].mesh, to_size(face.primitive)};
    const auto known = number_of_primitive.find(which);
    const int image = known != number_of_primitive.end()
                          ? known->second
                          : number_of_primitive.emplace(which, number(which)).first->second;
    colors.image_of_polygon.push_back(image);
  }
  return colors;
}

RowMatrix corner_colors(const PolygonMesh& mesh) {
  const GltfScene& scene = *mesh.gltf;
  const GltfDocument& document = scene.document;
  constexpr const char* kColor = "COLOR_0";
  std::vector<std::optional<GltfElements>> colors;  // by Vertices
  for (const GltfScene::Vertices& vertices : scene.vertices) {
    const Gltf& attributes =
        primitive_at(document, {vertices.mesh, vertices.primitives.front()})["attributes"];
    colors.emplace_back();
    if (attributes.contains(kColor))
      colors.back() = document.elements(document.index(attributes, kColor, "attributes"), kColor);
    if (colors.back() && colors.back()->width < 3)
      document.damaged(fmt::format("{} has {} components", kColor, colors.back()->width));
  }
  if (std::none_of(colors.begin(), colors.end(), [](const auto& one) { return one.has_value(); }))
    return {};
  RowMatrix rows = RowMatrix::Ones(3 * static_cast<Index>(scene.faces.size()), 3);
  for (std::size_t f = 0; f < scene.faces.size(); ++f) {
    const GltfScene::Face& face = scene.faces[f];
    const auto& own = colors[to_size(face.vertices)];
    if (!own) continue;
    std::array<std::uint32_t, 3> corners = face.corners;
    if (scene.vertices[to_size(face.vertices)].is_mirrored) std::swap(corners[1], corners[2]);
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t c = 0; c < 3; ++c)
        rows(static_cast<Index>(3 * f + k), static_cast<Index>(c)) = own->value(corners[k], c);
  }
  return rows;
}

void write_base_color(const std::string& path, const PolygonMesh& mesh, const std::string& png,
                      const FileVerification& verify) {
  const GltfOutput output = Replacement(*mesh.gltf, png).run();
  write_file_atomically(path, format_of(path) == ".glb" ? output.glb() : output.text(), verify);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
