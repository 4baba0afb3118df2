// glTF 2.0 and GLB. Each mesh is read once, in the place of the first node that shows it; instances
// share its texture coordinates, and so its layout. glTF cannot share a vertex whose corners differ
// in normals or texture coordinates. So vertices of a mesh at exactly one place, in all morph
// targets and for all joints, are joined, and numbered by first appearance.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <unordered_map>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/io/internal/dropped_parts.h"
#include "majorant/io/internal/gltf_nodes.h"
#include "majorant/io/internal/gltf_primitive.h"
#include "majorant/io/internal/gltf_scene.h"
#include "majorant/io/internal/mesh_readers.h"

namespace majorant {
namespace {

// Numbers of vertices within a mesh, by all data that distinguish them.
class VertexNumbers {
 public:
  // Returns the number of this key; `next` if it is new.
  Index number(const std::string& key, Index next) {
    return numbers_.try_emplace(key, next).first->second;
  }

 private:
  std::unordered_map<std::string, Index> numbers_;
};

void append_number(double x, std::string& key) {
  x += 0.0;  // turns -0 into 0
  char bytes[sizeof(x)];
  std::memcpy(bytes, &x, sizeof(x));
  key.append(bytes, sizeof(x));
}

// Returns a line of an OBJ with a name from the file.
std::string one_word_line(const char* keyword, const std::string& name) {
  std::string line = fmt::format("{} {}", keyword, name);
  std::replace_if(
      line.begin(), line.end(), [](unsigned char c) { return c < 32 || c == 127 || c == '\\'; },
      '_');
  return line;
}

std::string place(std::size_t mesh, std::size_t primitive) {
  return fmt::format("mesh {}, primitive {}", mesh, primitive);
}

// Returns the set that a file of ours marks as the layout; 0 for other files.
std::size_t layout_set(const GltfDocument& document) {
  const Gltf& asset = document.json()["asset"];
  const auto extras = asset.find("extras");
  if (extras == asset.end() || !extras->is_object()) return 0;
  const auto set = extras->find(kLayoutSet);
  if (set == extras->end() || !set->is_number_unsigned() || *set >= kMaxSets) return 0;
  return set->get<std::size_t>();
}

// Returns the number of vertices of another file, if all primitives name its vertices; else 0.
std::size_t numbered_vertices(const GltfDocument& document) {
  std::size_t count = 0;
  for (const Gltf& mesh : document.list("meshes")) {
    if (!mesh.contains("primitives") || !mesh["primitives"].is_array()) continue;
    for (const Gltf& primitive : mesh["primitives"]) {
      if (!primitive.is_object() || !primitive.contains("attributes") ||
          !primitive["attributes"].is_object() || !has_triangles(primitive))
        continue;
      const Gltf& attributes = primitive["attributes"];
      if (!attributes.contains(kInputVertex)) return 0;
      count += document.count(document.index(attributes, "POSITION", "attributes"), "POSITION");
    }
  }
  return count;
}

class GltfReader {
 public:
  GltfReader(const std::string& path, const std::string& content, const StopCheck& stop,
             Strictness strictness)
      : scene_(std::make_shared<GltfScene>(GltfScene{{path, content, stop}, 0, {}, {}})),
        document_(scene_->document),
        transforms_(document_),
        stop_(stop),
        dropped_(strictness) {
    mesh_.file = path;
    scene_->texcoord_set = layout_set(document_);
    texcoord_ = fmt::format("TEXCOORD_{}", scene_->texcoord_set);
  }

  PolygonMesh read() {
    const Gltf& meshes = document_.list("meshes");
    numbered_ = numbered_vertices(document_);
    for (std::size_t m = 0; m < meshes.size(); ++m) read_mesh(m, meshes[m]);
    if (mesh_.texcoords.empty())
      mesh_.polygon_texcoords.clear();
    else
      mesh_.polygon_texcoords.resize(mesh_.polygons.size());
    if (mesh_.normals.empty())
      mesh_.polygon_normals.clear();
    else
      mesh_.polygon_normals.resize(mesh_.polygons.size());
    require_complete(mesh_);
    dropped_.conclude(mesh_);
    mesh_.gltf = scene_;
    return std::move(mesh_);
  }

 private:
  // The content of some Vertices.
  struct Content {
    std::vector<Index> texcoord, normal;  // in the polygon mesh; -1: broken; empty: none
  };

  void read_mesh(std::size_t m, const Gltf& mesh) {
    const auto primitives = mesh.find("primitives");
    if (primitives == mesh.end() || !primitives->is_array())
      document_.damaged(fmt::format("mesh {} has no list of primitives", m));
    numbers_ = {};
    transform_ = transforms_.of_mesh(m);
    contents_.clear();
    known_.clear();
    if (mesh.contains("name") && mesh["name"].is_string())
      add_directive("o", mesh["name"].get<std::string>());
    for (std::size_t p = 0; p < primitives->size(); ++p) {
      stop_.poll();
      const Gltf& primitive = (*primitives)[p];
      if (!primitive.is_object() || !primitive.contains("attributes") ||
          !primitive["attributes"].is_object())
        document_.damaged(place(m, p) + " has no attributes");
      const std::size_t mode =
          document_.optional_index(primitive, "mode", "primitives").value_or(kTriangles);
      constexpr std::size_t kLast = kTriangleFan;
      if (mode > kLast) document_.damaged(place(m, p) + " has an unknown mode");
      if (!has_triangles(primitive)) continue;
      read_primitive(m, p, primitive, mode);
    }
  }

  void add_directive(const char* keyword, const std::string& name) {
    if (!name.empty())
      mesh_.directives.emplace_back(static_cast<Index>(mesh_.polygons.size()),
                                    one_word_line(keyword, name));
  }

  // Adds a line with the name of the material, if any.
  void use_material(const Gltf& primitive) {
    const auto k = document_.optional_index(primitive, "material", "primitives");
    if (!k) return;
    const Gltf& materials = document_.list("materials");
    if (*k >= materials.size()) document_.damaged(fmt::format("primitives: no material {}", *k));
    const auto name = materials[*k].find("name");
    if (name != materials[*k].end() && name->is_string())
      add_directive("usemtl", name->get<std::string>());
  }

  // Primitives with the same attributes and targets share their vertices.
  Index vertices_of(std::size_t m, std::size_t p, const Gltf& primitive) {
    const auto targets = primitive.find("targets");
    const std::string key = primitive["attributes"].dump() +
                            (targets == primitive.end() ? std::string() : targets->dump());
    const auto [entry, is_new] =
        known_.try_emplace(key, static_cast<Index>(scene_->vertices.size()));
    if (is_new) {
      scene_->vertices.push_back({m, {}, {}, transform_.linear().determinant() < 0});
      contents_.emplace(entry->second, read_vertices(m, p, primitive));
    }
    scene_->vertices[to_size(entry->second)].primitives.push_back(p);
    return entry->second;
  }

  Content read_vertices(std::size_t m, std::size_t p, const Gltf& primitive) {
    const Gltf& attributes = primitive["attributes"];
    const std::string where = place(m, p);
    const GltfElements positions = attribute(document_, attributes, "POSITION", where, 0, 3);
    const std::size_t count = positions.count;
    require_counts(document_, attributes, where, count);
    const std::vector<GltfElements> identity = identity_of(document_, primitive, where, count);
    std::optional<GltfElements> copy_of;
    if (numbered_ > 0) {
      copy_of = attribute(document_, attributes, kInputVertex, where, count, 2);
      if (copy_of->component != GltfComponent::UShort)
        document_.damaged(fmt::format("{}: {} is no list of numbers", where, kInputVertex));
    }
    Content content;
    std::vector<Index>& numbers = scene_->vertices.back().numbers;
    std::string key;
    double largest = 0;
    for (std::size_t v = 0; v < count; ++v) {
      const Vector3 local(positions.value(v, 0), positions.value(v, 1), positions.value(v, 2));
      if (!local.allFinite())
        document_.damaged(fmt::format("{}: POSITION {} is not finite", where, v));
      largest = std::max(largest, local.cwiseAbs().maxCoeff());
      if (copy_of) {
        numbers.push_back(numbered_vertex(*copy_of, v, local));
        continue;
      }
      key.clear();
      for (const double x : local) append_number(x, key);
      for (const GltfElements& list : identity)
        for (std::size_t k = 0; k < list.width; ++k) append_number(list.value(v, k), key);
      const auto next = static_cast<Index>(mesh_.positions.size());
      numbers.push_back(numbers_.number(key, next));
      if (numbers.back() == next) add_position(local);
    }
    add_rounding(largest);
    if (attributes.contains(texcoord_)) read_texcoords(attributes, where, content);
    if (attributes.contains("NORMAL")) read_normals(attributes, where, content);
    return content;
  }

  void add_position(const Vector3& local) {
    constexpr std::size_t kMaximum = std::numeric_limits<Index>::max();
    if (mesh_.positions.size() >= kMaximum) document_.damaged("more than 2^31 vertices");
    mesh_.positions.emplace_back(transform_ * local);
    if (!mesh_.positions.back().allFinite())
      document_.damaged("a node puts a vertex beyond the range of doubles");
  }

  // Returns the number of a vertex of another file, which may have copies. Vertices that are
  // missing are put at the first one's position; no face uses them.
  Index numbered_vertex(const GltfElements& copy_of, std::size_t v, const Vector3& local) {
    const std::size_t number = copy_of.integer(v, 0) | (std::size_t{copy_of.integer(v, 1)} << 16);
    if (number >= numbered_)
      document_.damaged(fmt::format("{} {} is out of range", kInputVertex, number));
    while (mesh_.positions.size() <= number) {
      mesh_.positions.emplace_back(transform_ * local);
      is_placed_.push_back(0);
    }
    const Vector3 here = transform_ * local;
    if (is_placed_[number] && mesh_.positions[number] != here)
      document_.damaged(fmt::format("{} {} is at two places", kInputVertex, number));
    is_placed_[number] = 1;
    mesh_.positions[number] = here;
    return static_cast<Index>(number);
  }

  // Adds one unit roundoff of floats for coordinates up to `largest`.
  void add_rounding(double largest) {
    constexpr double kUnit = 0x1p-24;
    const double stretch = transform_.linear().cwiseAbs().rowwise().sum().maxCoeff();
    mesh_.position_rounding =
        std::max(mesh_.position_rounding, kUnit * stretch * largest * std::sqrt(3.0));
  }

  // Equal coordinates get one number: where only normals differ there is no seam.
  void read_texcoords(const Gltf& attributes, const std::string& where, Content& content) {
    const GltfElements uv = attribute(document_, attributes, texcoord_, where,
                                      scene_->vertices.back().numbers.size(), 2);
    std::string key;
    for (std::size_t v = 0; v < uv.count; ++v) {
      const double u = uv.value(v, 0), down = uv.value(v, 1), up = 1 - down;
      if (!std::isfinite(u) || !std::isfinite(up)) {
        dropped_.add(DroppedPart::Texcoord, [&] {
          return fmt::format("{}: {}: {} {} is not finite", mesh_.file, where, texcoord_, v);
        });
        content.texcoord.push_back(-1);
        continue;
      }
      key.clear();
      for (const double x : {u, down}) append_number(x, key);
      const auto next = static_cast<Index>(mesh_.texcoords.size());
      const Index number = texcoord_numbers_.number(key, next);
      content.texcoord.push_back(number);
      if (number != next) continue;
      mesh_.texcoords.emplace_back(u, up);
      constexpr double kHalfSpacing = 0x1p-53;
      mesh_.texcoord_rounding.emplace_back(
          0, 1 - up == down ? 0.0 : kHalfSpacing * std::max(1.0, std::abs(up)));
    }
  }

  void read_normals(const Gltf& attributes, const std::string& where, Content& content) {
    const GltfElements normals = attribute(document_, attributes, "NORMAL", where,
                                           scene_->vertices.back().numbers.size(), 3);
    const Eigen::Matrix3d turn = transform_.linear().inverse().transpose();
    std::string key;
    for (std::size_t v = 0; v < normals.count; ++v) {
      const Vector3 local(normals.value(v, 0), normals.value(v, 1), normals.value(v, 2));
      const Vector3 normal = (turn * local).stableNormalized();
      if (!normal.allFinite()) {
        dropped_.add(DroppedPart::Normal, [&] {
          return fmt::format("{}: {}: NORMAL {} is not finite", mesh_.file, where, v);
        });
        content.normal.push_back(-1);
        continue;
      }
      content.normal.push_back(static_cast<Index>(mesh_.normals.size()));
      mesh_.normals.push_back(normal);
    }
  }

  void read_primitive(std::size_t m, std::size_t p, const Gltf& primitive, std::size_t mode) {
    const Index number = vertices_of(m, p, primitive);
    const GltfScene::Vertices& vertices = scene_->vertices[to_size(number)];
    const Content& content = contents_.at(number);
    const std::string where = place(m, p);
    use_material(primitive);
    const auto count = vertices.numbers.size();
    for (const auto& triangle : triangles_of(document_, primitive, mode, count, where))
      add_face({number, static_cast<Index>(p), triangle}, content);
  }

  void add_face(const GltfScene::Face& face, const Content& content) {
    const bool is_mirrored = scene_->vertices[to_size(face.vertices)].is_mirrored;
    std::array<std::uint32_t, 3> corners = face.corners;
    if (is_mirrored) std::swap(corners[1], corners[2]);
    const auto mapped = [&](const std::vector<Index>& numbers) {
      std::vector<Index> list;
      if (numbers.empty()) return list;
      for (const std::uint32_t v : corners) list.push_back(numbers[v]);
      if (std::find(list.begin(), list.end(), -1) != list.end()) list.clear();
      return list;
    };
    scene_->faces.push_back(face);
    mesh_.polygons.push_back(mapped(scene_->vertices[to_size(face.vertices)].numbers));
    mesh_.polygon_texcoords.push_back(mapped(content.texcoord));
    mesh_.polygon_normals.push_back(mapped(content.normal));
    mesh_.polygon_lines.push_back(static_cast<long>(mesh_.polygons.size()));
  }

  std::shared_ptr<GltfScene> scene_;
  std::string texcoord_;  // name of the attribute that is read
  const GltfDocument& document_;
  NodeTransforms transforms_;
  const StopCheck& stop_;
  DroppedParts dropped_;
  PolygonMesh mesh_;
  NodeTransform transform_ = NodeTransform::Identity();  // of the current mesh
  VertexNumbers numbers_, texcoord_numbers_;             // of the current mesh; of all meshes
  std::size_t numbered_ = 0;     // number of vertices; 0: not all have kInputVertex
  std::vector<char> is_placed_;  // flags of vertices with kInputVertex
  std::unordered_map<std::string, Index> known_;
  std::unordered_map<Index, Content> contents_;
};

}  // namespace

PolygonMesh read_gltf(const std::string& path, const std::string& content, const StopCheck& stop,
                      Strictness strictness) {
  return GltfReader(path, content, stop, strictness).read();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
