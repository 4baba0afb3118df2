#include "majorant/io/internal/gltf_update.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/internal/gltf_attribute_extension.h"
#include "majorant/io/internal/gltf_materials.h"
#include "majorant/io/internal/gltf_new_vertices.h"

namespace majorant {
namespace {

std::string media_type(const std::string& bytes) {
  if (bytes.starts_with("\x89PNG")) return "image/png";
  if (bytes.starts_with("\xFF\xD8\xFF")) return "image/jpeg";
  if (bytes.starts_with("RIFF") && bytes.substr(0, 12).ends_with("WEBP")) return "image/webp";
  return {};
}

// Names of images are relative to the file, so in another folder the images are embedded.
void embed_images(const GltfDocument& document, const std::string& path, GltfOutput& out) {
  namespace fs = std::filesystem;
  if (!out.json().contains("images")) return;
  std::error_code failed;
  const auto folder = [&](const std::string& file) {
    return fs::weakly_canonical(fs::absolute(file, failed).parent_path(), failed);
  };
  if (folder(path) == folder(document.path())) return;
  for (Gltf& image : out.json()["images"]) {
    if (!image.contains("uri")) continue;
    const auto uri = image["uri"].get<std::string>();
    if (uri.starts_with("data:")) continue;
    const std::string file = file_of_uri(document.path(), uri);
    if (!fs::is_regular_file(file, failed)) continue;
    const std::string bytes = read_whole_file(file);
    const std::string kind = media_type(bytes);
    if (kind.empty()) continue;
    image["bufferView"] = out.add_view(bytes, 0, GltfOutput::Target::None);
    image["mimeType"] = kind;
    image.erase("uri");
  }
}

class Update {
 public:
  Update(const GltfScene& scene, const PolygonMesh& input, const PolygonMesh& mesh,
         const std::vector<PolygonOrigin>& origins, const std::string& path, std::size_t uv_set)
      : scene_(scene),
        document_(scene.document),
        input_(input),
        mesh_(mesh),
        origins_(origins),
        path_(path),
        set_(uv_set),
        texcoord_(texcoord_name(uv_set)),
        out_(document_.json()) {
    for (const GltfScene::Vertices& vertices : scene.vertices)
      new_.emplace_back(vertices.numbers.size());
  }

  GltfOutput run() {
    out_.take_buffers(document_);
    collect_triangles();
    has_blends_ = std::any_of(new_.begin(), new_.end(),
                              [](const NewVertices& vertices) { return vertices.has_blends(); });
    MovedMaterials materials(out_.json(), set_);
    for (std::size_t k = 0; k < scene_.vertices.size(); ++k) update(k, materials);
    move_others(materials);
    embed_images(document_, path_, out_);
    mark_layout_set(out_.json(), set_, path_);
    out_.drop_unused(document_);
    return std::move(out_);
  }

 private:
  using Primitive = std::pair<std::size_t, std::size_t>;  // mesh, primitive

  Gltf& primitive(const Primitive& which) {
    return out_.json()["meshes"][which.first]["primitives"][which.second];
  }

  static Primitive primitive_of(const GltfScene& scene, const GltfScene::Face& face) {
    return {scene.vertices[to_size(face.vertices)].mesh, to_size(face.primitive)};
  }

  void collect_triangles() {
    for (const GltfScene::Face& face : scene_.faces)
      for (const std::uint32_t corner : face.corners)
        before_[primitive_of(scene_, face)].push_back(corner);
    for (std::size_t p = 0; p < mesh_.polygons.size(); ++p) {
      const PolygonOrigin& origin = origins_[p];
      const GltfScene::Face& face = scene_.faces[to_size(origin.polygon)];
      std::array<std::uint32_t, 3> corners{};
      for (std::size_t k = 0; k < 3; ++k) corners[k] = vertex_of(p, k, face);
      if (scene_.vertices[to_size(face.vertices)].is_mirrored) std::swap(corners[1], corners[2]);
      auto& list = after_[primitive_of(scene_, face)];
      list.insert(list.end(), corners.begin(), corners.end());
    }
  }

  // Returns uv of the file, whose v points downwards.
  Uv file_uv(Index texcoord) const {
    const Vector2& uv = mesh_.texcoords[texcoord];
    std::string bytes;
    append_float(uv.x(), bytes);
    append_float(1 - uv.y(), bytes);
    Uv out;
    std::copy(bytes.begin(), bytes.end(), reinterpret_cast<char*>(out.data()));
    return out;
  }

  std::uint32_t vertex_of(std::size_t polygon, std::size_t k, const GltfScene::Face& face) {
    const PlaceOnPolygon& place = origins_[polygon].corners[k];
    const Uv uv = file_uv(mesh_.polygon_texcoords[polygon][k]);
    NewVertices& vertices = new_[to_size(face.vertices)];
    std::array<std::uint32_t, 3> corners = face.corners;
    if (scene_.vertices[to_size(face.vertices)].is_mirrored) std::swap(corners[1], corners[2]);
    for (std::size_t i = 0; i < 3; ++i)
      if (place.weights[static_cast<Index>(i)] == 1)
        return vertices.number(corners[place.corners[i]], uv);
    return vertices.number(blend_at(polygon, k, corners), uv);
  }

  // A new vertex has the weights of the first polygon that uses it.
  Blend blend_at(std::size_t polygon, std::size_t k, const std::array<std::uint32_t, 3>& corners) {
    const PlaceOnPolygon& place = origins_[polygon].corners[k];
    const auto& numbers = input_.polygons[to_size(origins_[polygon].polygon)];
    std::array<std::size_t, 3> order = {0, 1, 2};
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return numbers[place.corners[a]] < numbers[place.corners[b]];
    });
    Blend blend;
    blend.vertex = mesh_.polygons[polygon][k];
    std::map<Index, double> weights;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t corner = place.corners[order[i]];
      blend.from[i] = corners[corner];
      blend.weights[static_cast<Index>(i)] = place.weights[static_cast<Index>(order[i])];
      if (blend.weights[static_cast<Index>(i)] != 0)
        weights[numbers[corner]] = blend.weights[static_cast<Index>(i)];
    }
    const auto& known = weights_.try_emplace(mesh_.polygons[polygon][k], weights).first->second;
    for (std::size_t i = 0; i < 3; ++i)
      if (const auto found = known.find(numbers[place.corners[order[i]]]);
          found != known.end() && blend.weights[static_cast<Index>(i)] != 0)
        blend.weights[static_cast<Index>(i)] = found->second;
    return blend;
  }

  void update(std::size_t k, MovedMaterials& materials) {
    const GltfScene::Vertices& vertices = scene_.vertices[k];
    const Gltf& meshes = document_.list("meshes");
    const Gltf& first = meshes[vertices.mesh]["primitives"][vertices.primitives.front()];
    const Gltf& attributes = first["attributes"];
    bool is_kept = false;  // the old set
    for (const std::size_t p : vertices.primitives)
      is_kept = is_kept || materials.uses_old_set(meshes[vertices.mesh]["primitives"][p]);
    is_kept = is_kept && attributes.contains(texcoord_);
    const std::size_t set = std::max(next_set(attributes), set_ + 1);
    const std::string moved = is_kept ? texcoord_name(set) : std::string();
    AttributeExtension extension(document_, new_[k], out_);
    const Gltf new_attributes = [&] {
      Gltf all = renamed(attributes, moved, extension);
      all[texcoord_] = add_uv(new_[k]);
      for (std::size_t lower = 0; lower < set_; ++lower)  // sets must have no gaps
        if (!all.contains(texcoord_name(lower))) all[texcoord_name(lower)] = all[texcoord_];
      if (has_blends_) all[kInputVertex] = add_numbers(k);
      return all;
    }();
    Gltf targets;
    if (first.contains("targets"))
      for (const Gltf& target : first["targets"])
        targets.push_back(renamed(target, moved, extension));
    for (const std::size_t p : vertices.primitives) {
      const Primitive which{vertices.mesh, p};
      Gltf& now = primitive(which);
      now["attributes"] = new_attributes;
      if (!targets.is_null()) now["targets"] = targets;
      if (is_kept) materials.move(now, set);
      update_indices(which, new_[k], now);
    }
  }

  // Returns attributes, or a morph target, under their new names.
  Gltf renamed(const Gltf& attributes, const std::string& moved, AttributeExtension& extension) {
    Gltf out = Gltf::object();
    for (const auto& [name, number] : attributes.items()) {
      const bool is_replaced =
          (name == texcoord_ && moved.empty()) || (name == kInputVertex && has_blends_);
      if (is_replaced) continue;
      const auto accessor = document_.index(attributes, name.c_str(), "attributes");
      out[name == texcoord_ ? moved : name] = extension.extended(attributes, name, accessor);
    }
    return out;
  }

  std::size_t add_uv(const NewVertices& vertices) {
    std::string bytes;
    for (const Uv& uv : vertices.uv())
      for (const float x : uv) append_bytes(x, bytes);
    return out_.add_accessor({{"componentType", static_cast<int>(GltfComponent::Float)},
                              {"type", "VEC2"},
                              {"count", vertices.count()}},
                             bytes, 2 * sizeof(float), GltfOutput::Target::Vertices);
  }

  // Stores the vertex numbers of the mesh if there are new vertices, which a reader would number
  // differently.
  std::size_t add_numbers(std::size_t k) {
    std::string bytes;
    const std::vector<Index>& numbers = scene_.vertices[k].numbers;
    for (const Index v : numbers) append_bytes(static_cast<std::uint32_t>(v), bytes);
    for (const Blend& blend : new_[k].added())
      append_bytes(
          static_cast<std::uint32_t>(blend.vertex < 0 ? numbers[blend.from[0]] : blend.vertex),
          bytes);
    return out_.add_accessor({{"componentType", static_cast<int>(GltfComponent::UShort)},
                              {"type", "VEC2"},
                              {"count", new_[k].count()}},
                             bytes, sizeof(std::uint32_t), GltfOutput::Target::Vertices);
  }

  // Indices that have not changed are kept.
  void update_indices(const Primitive& which, const NewVertices& vertices, Gltf& now) {
    const std::vector<std::uint32_t>& corners = after_[which];
    const bool has_indices = now.contains("indices");
    if (corners == before_[which] && (has_indices || vertices.added().empty())) return;
    GltfComponent component = GltfComponent::UShort;
    if (has_indices) {
      const std::size_t old = document_.index(now, "indices", "primitives");
      component = document_.elements(old, "indices").component;
    }
    now["indices"] = add_indices(out_, corners, vertices.count(), component);
    now.erase("mode");
  }

  // Gives points and lines the other set, too, if their material uses it.
  void move_others(MovedMaterials& materials) {
    std::set<Primitive> done;
    for (const GltfScene::Vertices& vertices : scene_.vertices)
      for (const std::size_t p : vertices.primitives) done.insert({vertices.mesh, p});
    const Gltf& meshes = document_.list("meshes");
    for (std::size_t m = 0; m < meshes.size(); ++m)
      for (std::size_t p = 0; p < meshes[m]["primitives"].size(); ++p) {
        if (done.contains({m, p})) continue;
        const Gltf& before = meshes[m]["primitives"][p];
        if (!before["attributes"].contains(texcoord_) || !materials.uses_old_set(before)) continue;
        const std::size_t set = next_set(before["attributes"]);
        Gltf& now = primitive({m, p});
        now["attributes"][texcoord_name(set)] = now["attributes"][texcoord_];
        materials.move(now, set);
      }
  }

  const GltfScene& scene_;
  const GltfDocument& document_;
  const PolygonMesh& input_;
  const PolygonMesh& mesh_;
  const std::vector<PolygonOrigin>& origins_;
  const std::string& path_;
  std::size_t set_;       // set of the new coordinates
  std::string texcoord_;  // its name
  GltfOutput out_;
  bool has_blends_ = false;                                         // any new vertices
  std::vector<NewVertices> new_;                                    // by Vertices of the scene
  std::map<Primitive, std::vector<std::uint32_t>> before_, after_;  // corners of triangles
  std::map<Index, std::map<Index, double>> weights_;  // by new vertex of the mesh: weights of its
                                                      // corners
};

}  // namespace

GltfOutput updated_gltf(const GltfScene& scene, const PolygonMesh& input, const PolygonMesh& mesh,
                        const std::vector<PolygonOrigin>& origins, const std::string& path,
                        std::size_t uv_set) {
  return Update(scene, input, mesh, origins, path, uv_set).run();
}

void mark_layout_set(Gltf& json, std::size_t uv_set, const std::string& path) {
  Gltf& asset = json["asset"];
  const bool has_place = !asset.contains("extras") || asset["extras"].is_object();
  if (uv_set > 0 && !has_place)
    throw Error(
        ErrorKind::Unsupported,
        fmt::format("{}: asset.extras of the input is no object, and says there which set is "
                    "the layout; make the layout the first set",
                    path));
  if (uv_set > 0)
    asset["extras"][kLayoutSet] = uv_set;
  else if (has_place && asset.contains("extras"))
    asset["extras"].erase(kLayoutSet);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
