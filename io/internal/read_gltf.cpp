// glTF 2.0 and GLB. Each mesh is read once, where the first node that shows it stands: instances
// share its texture coordinates, and so its layout. glTF cannot share a vertex whose corners differ
// in normals or texture coordinates: vertices of a mesh at exactly one place, in all morph targets
// and for all joints, are one, numbered by first appearance.
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
#include "majorant/io/internal/gltf_scene.h"
#include "majorant/io/internal/mesh_readers.h"

namespace majorant {
namespace {

using Transform = Eigen::Affine3d;

// Where the first node that shows a mesh puts it; nothing for meshes that no node shows.
class NodeTransforms {
 public:
  explicit NodeTransforms(const GltfDocument& document)
      : document_(document), nodes_(document.list("nodes")) {
    of_mesh_.resize(document.list("meshes").size());
    is_visited_.assign(nodes_.size(), 0);
    find_parents();
    visit_scenes();
    for (std::size_t k = 0; k < nodes_.size(); ++k)
      if (!has_parent_[k]) visit(k);
    if (const auto left = std::find(is_visited_.begin(), is_visited_.end(), 0);
        left != is_visited_.end())
      document_.damaged(fmt::format("node {} is its own ancestor", left - is_visited_.begin()));
  }

  Transform of_mesh(std::size_t mesh) const {
    return of_mesh_[mesh].value_or(Transform::Identity());
  }

 private:
  struct Visit {
    std::size_t node;
    Transform parent;
  };

  const Gltf& array(const Gltf& object, const char* key, const char* name) const {
    static const Gltf kNone = Gltf::array();
    const auto found = object.find(key);
    if (found == object.end()) return kNone;
    if (!found->is_array()) document_.damaged(fmt::format("{}: {} is no list", name, key));
    return *found;
  }

  std::vector<std::size_t> node_numbers(const Gltf& object, const char* key,
                                        const char* name) const {
    std::vector<std::size_t> numbers;
    for (const Gltf& entry : array(object, key, name)) {
      if (!entry.is_number_unsigned() || entry.get<std::uint64_t>() >= nodes_.size())
        document_.damaged(fmt::format("{}: {} names a node that is not there", name, key));
      numbers.push_back(entry.get<std::size_t>());
    }
    return numbers;
  }

  void find_parents() {
    has_parent_.assign(nodes_.size(), 0);
    for (const Gltf& node : nodes_)
      for (const std::size_t child : node_numbers(node, "children", "nodes")) {
        if (has_parent_[child]) document_.damaged(fmt::format("node {} has two parents", child));
        has_parent_[child] = 1;
      }
  }

  // The scene that is shown comes first.
  void visit_scenes() {
    const Gltf& scenes = document_.list("scenes");
    const auto visit_roots = [&](const Gltf& scene) {
      for (const std::size_t root : node_numbers(scene, "nodes", "scenes")) visit(root);
    };
    const std::size_t shown =
        document_.optional_index(document_.json(), "scene", "glTF").value_or(0);
    if (shown < scenes.size()) visit_roots(scenes[shown]);
    for (const Gltf& scene : scenes) visit_roots(scene);
  }

  std::vector<double> numbers(const Gltf& node, const char* key, std::size_t count) const {
    std::vector<double> values;
    for (const Gltf& entry : array(node, key, "nodes")) {
      if (!entry.is_number()) document_.damaged(fmt::format("nodes: {} has no numbers", key));
      values.push_back(entry.get<double>());
    }
    const bool is_finite =
        std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
    if ((!values.empty() && values.size() != count) || !is_finite)
      document_.damaged(fmt::format("nodes: {} has no {} finite numbers", key, count));
    return values;
  }

  Transform local(const Gltf& node) const {
    Transform out = Transform::Identity();
    constexpr std::size_t kMatrix = 16, kVector = 3, kQuaternion = 4;
    if (const auto m = numbers(node, "matrix", kMatrix); !m.empty()) {
      out.matrix().topRows<3>() = Eigen::Map<const Eigen::Matrix4d>(m.data()).topRows<3>();
      return out;
    }
    if (const auto t = numbers(node, "translation", kVector); !t.empty())
      out.translate(Vector3(t[0], t[1], t[2]));
    if (const auto r = numbers(node, "rotation", kQuaternion); !r.empty())
      if (const Eigen::Quaterniond q(r[3], r[0], r[1], r[2]); q.norm() > 0)
        out.rotate(q.normalized());
    if (const auto s = numbers(node, "scale", kVector); !s.empty())
      out.scale(Vector3(s[0], s[1], s[2]));
    return out;
  }

  // Depth first, in the order of the file. A node that another root leads to, too, is left alone.
  void visit(std::size_t root) {
    std::vector<Visit> open{{root, Transform::Identity()}};
    while (!open.empty()) {
      const auto [k, parent] = open.back();
      open.pop_back();
      if (is_visited_[k]) continue;
      is_visited_[k] = 1;
      const Gltf& node = nodes_[k];
      const Transform here = parent * local(node);
      show_mesh(node, here);
      const std::vector<std::size_t> children = node_numbers(node, "children", "nodes");
      for (auto child = children.rbegin(); child != children.rend(); ++child)
        open.push_back({*child, here});
    }
  }

  // A skinned mesh is where its joints put it, whatever its node says; one that is shown without a
  // size as if nothing was said.
  void show_mesh(const Gltf& node, const Transform& here) {
    const auto mesh = document_.optional_index(node, "mesh", "nodes");
    if (!mesh) return;
    if (*mesh >= of_mesh_.size()) document_.damaged(fmt::format("nodes: no mesh {}", *mesh));
    if (of_mesh_[*mesh]) return;
    const double det = here.linear().determinant();
    const bool is_usable = here.matrix().allFinite() && det != 0 && std::isfinite(det);
    of_mesh_[*mesh] = node.contains("skin") || !is_usable ? Transform::Identity() : here;
  }

  const GltfDocument& document_;
  const Gltf& nodes_;
  std::vector<std::optional<Transform>> of_mesh_;
  std::vector<char> has_parent_, is_visited_;
};

// Numbers of vertices by all that tells them apart, within a mesh.
class VertexNumbers {
 public:
  // The number of what has this key; `next` where it is new.
  Index number(const std::string& key, Index next) {
    return numbers_.try_emplace(key, next).first->second;
  }

 private:
  std::unordered_map<std::string, Index> numbers_;
};

void append_number(double x, std::string& key) {
  x += 0.0;  // -0 is 0
  char bytes[sizeof(x)];
  std::memcpy(bytes, &x, sizeof(x));
  key.append(bytes, sizeof(x));
}

// A name of the file as a line of an OBJ.
std::string one_word_line(const char* keyword, const std::string& name) {
  std::string line = fmt::format("{} {}", keyword, name);
  std::replace_if(
      line.begin(), line.end(), [](unsigned char c) { return c < 32 || c == 127 || c == '\\'; },
      '_');
  return line;
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
    scene_->texcoord_set = layout_set();
    texcoord_ = fmt::format("TEXCOORD_{}", scene_->texcoord_set);
  }

  PolygonMesh read() {
    const Gltf& meshes = document_.list("meshes");
    count_numbered();
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
  // What is read of some Vertices.
  struct Content {
    std::vector<Index> texcoord, normal;  // of the polygon mesh; -1: broken; empty: none
  };

  std::string place(std::size_t mesh, std::size_t primitive) const {
    return fmt::format("mesh {}, primitive {}", mesh, primitive);
  }

  // The set that a file of ours says is the layout; 0 of other files.
  std::size_t layout_set() const {
    const Gltf& asset = document_.json()["asset"];
    const auto extras = asset.find("extras");
    if (extras == asset.end() || !extras->is_object()) return 0;
    const auto set = extras->find(kLayoutSet);
    if (set == extras->end() || !set->is_number_unsigned() || *set >= kMostSets) return 0;
    return set->get<std::size_t>();
  }

  // True where a primitive is a surface.
  static bool has_triangles(const Gltf& primitive) {
    const auto mode = primitive.find("mode");
    const bool is_other =
        mode != primitive.end() && mode->is_number_unsigned() && *mode < kTriangles;
    return !is_other && primitive["attributes"].contains("POSITION");
  }

  // Vertices of primitives, if all of these say which vertex of another file they are.
  void count_numbered() {
    for (const Gltf& mesh : document_.list("meshes")) {
      if (!mesh.contains("primitives") || !mesh["primitives"].is_array()) continue;
      for (const Gltf& primitive : mesh["primitives"]) {
        if (!primitive.is_object() || !primitive.contains("attributes") ||
            !primitive["attributes"].is_object() || !has_triangles(primitive))
          continue;
        const Gltf& attributes = primitive["attributes"];
        if (!attributes.contains(kInputVertex)) {
          numbered_ = 0;
          return;
        }
        numbered_ +=
            document_.count(document_.index(attributes, "POSITION", "attributes"), "POSITION");
      }
    }
  }

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

  // The name of its material where it has one.
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

  GltfElements attribute(const Gltf& attributes, const std::string& name, const std::string& where,
                         std::size_t count, std::size_t width) const {
    GltfElements elements = document_.elements(
        document_.index(attributes, name.c_str(), "attributes"), where + ": " + name);
    if ((count > 0 && elements.count != count) || elements.width != width)
      document_.damaged(fmt::format("{}: {} has {} elements of {} components", where, name,
                                    elements.count, elements.width));
    return elements;
  }

  // All that a vertex must share with another one to be the same.
  std::vector<GltfElements> identity_of(const Gltf& primitive, const std::string& where,
                                        std::size_t count) const {
    std::vector<GltfElements> lists;
    const Gltf& attributes = primitive["attributes"];
    if (const auto targets = primitive.find("targets"); targets != primitive.end()) {
      if (!targets->is_array()) document_.damaged(where + ": targets are no list");
      for (const Gltf& target : *targets) {
        if (!target.is_object()) document_.damaged(where + ": a target is no object");
        require_counts(target, where, count);
        if (target.contains("POSITION"))
          lists.push_back(attribute(target, "POSITION", where, count, 3));
      }
    }
    for (const char* name : {"JOINTS_0", "WEIGHTS_0", "JOINTS_1", "WEIGHTS_1"})
      if (attributes.contains(name)) lists.push_back(attribute(attributes, name, where, count, 4));
    return lists;
  }

  // Those that are not read here, too.
  void require_counts(const Gltf& attributes, const std::string& where, std::size_t count) const {
    for (const auto& [name, ignored] : attributes.items()) {
      const std::size_t accessor = document_.index(attributes, name.c_str(), "attributes");
      if (const std::size_t other = document_.count(accessor, name); other != count)
        document_.damaged(
            fmt::format("{}: {} has {} elements, POSITION {}", where, name, other, count));
    }
  }

  Content read_vertices(std::size_t m, std::size_t p, const Gltf& primitive) {
    const Gltf& attributes = primitive["attributes"];
    const std::string where = place(m, p);
    const GltfElements positions = attribute(attributes, "POSITION", where, 0, 3);
    const std::size_t count = positions.count;
    require_counts(attributes, where, count);
    const std::vector<GltfElements> identity = identity_of(primitive, where, count);
    std::optional<GltfElements> copy_of;
    if (numbered_ > 0) {
      copy_of = attribute(attributes, kInputVertex, where, count, 2);
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
    constexpr std::size_t kMost = std::numeric_limits<Index>::max();
    if (mesh_.positions.size() >= kMost) document_.damaged("more than 2^31 vertices");
    mesh_.positions.emplace_back(transform_ * local);
    if (!mesh_.positions.back().allFinite())
      document_.damaged("a node puts a vertex beyond the range of doubles");
  }

  // Numbers of vertices of another file, of which there may be copies. Those that are not there are
  // where the first vertex is: no face has them.
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

  // Coordinates, at most this large, are floats: a unit roundoff in each.
  void add_rounding(double largest) {
    constexpr double kUnit = 0x1p-24;
    const double stretch = transform_.linear().cwiseAbs().rowwise().sum().maxCoeff();
    mesh_.position_rounding =
        std::max(mesh_.position_rounding, kUnit * stretch * largest * std::sqrt(3.0));
  }

  // Equal ones have one number: where only normals differ there is no seam.
  void read_texcoords(const Gltf& attributes, const std::string& where, Content& content) {
    const GltfElements uv =
        attribute(attributes, texcoord_, where, scene_->vertices.back().numbers.size(), 2);
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
    const GltfElements normals =
        attribute(attributes, "NORMAL", where, scene_->vertices.back().numbers.size(), 3);
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
    std::vector<std::uint32_t> corners;
    if (primitive.contains("indices")) {
      const GltfElements indices = document_.elements(
          document_.index(primitive, "indices", "primitives"), where + ": indices");
      const bool is_whole = indices.component == GltfComponent::UByte ||
                            indices.component == GltfComponent::UShort ||
                            indices.component == GltfComponent::UInt;
      if (indices.width != 1 || !is_whole) document_.damaged(where + ": indices are no numbers");
      for (std::size_t k = 0; k < indices.count; ++k) corners.push_back(indices.integer(k));
    } else {
      corners.resize(vertices.numbers.size());
      for (std::size_t k = 0; k < corners.size(); ++k) corners[k] = static_cast<std::uint32_t>(k);
    }
    for (const std::uint32_t v : corners)
      if (v >= vertices.numbers.size())
        document_.damaged(fmt::format("{}: index {} out of range, there are {}", where, v,
                                      vertices.numbers.size()));
    if (mode == kTriangles && corners.size() % 3 != 0)
      document_.damaged(fmt::format("{}: {} corners are no triangles", where, corners.size()));
    constexpr std::size_t kBytesOfCorner = 32;  // in the lists of polygons, at least
    document_.take(kBytesOfCorner * corners.size());
    const std::size_t step = mode == kTriangles ? 3 : 1;
    for (std::size_t k = 0; k + 2 < corners.size(); k += step) {
      std::array<std::uint32_t, 3> triangle = {corners[k], corners[k + 1], corners[k + 2]};
      if (mode == kTriangleStrip && k % 2 == 1) std::swap(triangle[1], triangle[2]);
      if (mode == kTriangleFan) triangle[0] = corners[0];
      // Strips go on elsewhere by triangles without an area.
      const bool is_stitch =
          triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0];
      if (mode == kTriangleStrip && is_stitch) continue;
      add_face({number, static_cast<Index>(p), triangle}, content);
    }
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
  std::string texcoord_;  // name of the set that is read
  const GltfDocument& document_;
  NodeTransforms transforms_;
  const StopCheck& stop_;
  DroppedParts dropped_;
  PolygonMesh mesh_;
  Transform transform_ = Transform::Identity();  // of the mesh that is being read
  VertexNumbers numbers_, texcoord_numbers_;     // of that mesh; of all
  std::size_t numbered_ = 0;                     // vertices; 0: not all have kInputVertex
  std::vector<char> is_placed_;                  // of vertices with kInputVertex
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
