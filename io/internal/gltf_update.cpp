#include "majorant/io/internal/gltf_update.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/io/files/input_file.h"

namespace majorant {
namespace {

std::string texcoord_name(std::size_t set) { return fmt::format("TEXCOORD_{}", set); }

constexpr const char* kTangent = "TANGENT";
constexpr const char* kVariants = "KHR_materials_variants";

// A vertex of the output: one of the input, or a place between three of them.
struct Blend {
  std::array<std::uint32_t, 3> from{};
  Barycentric weights = Barycentric::Unit(0);
  Index vertex = -1;  // of the mesh, where it is a new one
  bool is_vertex() const { return weights[0] == 1; }
};

using Uv = std::array<float, 2>;  // as the file has them

// Vertices of the output that come of some Vertices of the scene: these first, then copies and new
// ones.
class NewVertices {
 public:
  explicit NewVertices(std::size_t count) : uv_(count), has_uv_(count, 0) {}

  std::uint32_t number(std::uint32_t vertex, const Uv& uv) {
    if (!has_uv_[vertex]) {
      has_uv_[vertex] = 1;
      uv_[vertex] = uv;
    }
    if (is_same(uv_[vertex], uv)) return vertex;
    return add({vertex, vertex, vertex, bits(uv)}, {{vertex, vertex, vertex}}, uv);
  }
  // blend: ordered by the numbers that the corners have in the mesh, so that all sides of an edge
  // compute the same.
  std::uint32_t number(const Blend& blend, const Uv& uv) {
    has_blends_ = true;
    constexpr auto kBlend = std::numeric_limits<std::uint32_t>::max();
    return add({static_cast<std::uint32_t>(blend.vertex), kBlend, used_corners(blend), bits(uv)},
               blend, uv);
  }

  std::size_t count() const { return uv_.size(); }
  const std::vector<Uv>& uv() const { return uv_; }
  const std::vector<Blend>& added() const { return added_; }
  bool has_blends() const { return has_blends_; }

 private:
  using Key = std::tuple<std::uint32_t, std::uint32_t, std::uint64_t, std::uint64_t>;

  static bool is_same(const Uv& a, const Uv& b) { return bits(a) == bits(b); }
  static std::uint64_t bits(const Uv& uv) { return std::bit_cast<std::uint64_t>(uv); }
  // The corners that are not left out, of an edge both.
  static std::uint64_t used_corners(const Blend& blend) {
    std::uint64_t key = 0;
    for (std::size_t k = 0; k < 3; ++k)
      if (blend.weights[static_cast<Index>(k)] != 0)
        key = key * 0x9E3779B97F4A7C15U + blend.from[k] + 1;
    return key;
  }

  std::uint32_t add(const Key& key, const Blend& blend, const Uv& uv) {
    const auto [entry, is_new] = numbers_.try_emplace(key, static_cast<std::uint32_t>(uv_.size()));
    if (is_new) {
      uv_.push_back(uv);
      added_.push_back(blend);
    }
    return entry->second;
  }

  std::vector<Uv> uv_;
  std::vector<char> has_uv_;
  std::vector<Blend> added_;
  std::map<Key, std::uint32_t> numbers_;
  bool has_blends_ = false;
};

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

// The set of coordinates that a texture is shown by: KHR_texture_transform may name another one.
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

// Materials that show textures by the old coordinates, of this set, and those that show them by
// another one.
class MovedMaterials {
 public:
  MovedMaterials(Gltf& json, std::size_t old_set) : json_(json), old_set_(old_set) {
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

  bool uses_old_set(const Gltf& primitive) const {
    const std::set<std::size_t> used = materials_of(primitive);
    return std::any_of(used.begin(), used.end(),
                       [&](std::size_t k) { return k < uses_old_set_.size() && uses_old_set_[k]; });
  }

  // Gives the primitive materials that show by `set` what they have shown by the old one.
  void move(Gltf& primitive, std::size_t set) {
    if (primitive.contains("material")) move_reference(primitive["material"], set);
    if (Gltf* variants = mappings(primitive))
      for (Gltf& mapping : *variants)
        if (mapping.is_object() && mapping.contains("material"))
          move_reference(mapping["material"], set);
  }

 private:
  static Gltf* mappings(Gltf& primitive) {
    if (!primitive.is_object() || !primitive.contains("extensions")) return nullptr;
    Gltf& extensions = primitive["extensions"];
    if (!extensions.is_object() || !extensions.contains(kVariants)) return nullptr;
    Gltf& variants = extensions[kVariants];
    return variants.is_object() && variants.contains("mappings") && variants["mappings"].is_array()
               ? &variants["mappings"]
               : nullptr;
  }

  static std::set<std::size_t> materials_of(const Gltf& primitive) {
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

  void move_reference(Gltf& reference, std::size_t set) {
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

  Gltf& json_;
  std::size_t old_set_;
  Gltf before_;
  std::vector<char> uses_old_set_;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> moved_;  // material, set: the new one
  std::set<std::size_t> is_changed_;
};

// The first set of texture coordinates that a primitive does not have.
std::size_t next_set(const Gltf& attributes) {
  std::size_t set = 0;
  while (attributes.contains(texcoord_name(set))) ++set;
  return set;
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
    embed_images();
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

  // v upwards to v downwards.
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

  // The weights of a new vertex are those of the polygon that comes first to it.
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
    extended_.clear();
    const Gltf new_attributes = [&] {
      Gltf all = renamed(k, attributes, moved);
      all[texcoord_] = add_uv(new_[k]);
      for (std::size_t lower = 0; lower < set_; ++lower)  // sets have no gaps
        if (!all.contains(texcoord_name(lower))) all[texcoord_name(lower)] = all[texcoord_];
      if (has_blends_) all[kInputVertex] = add_numbers(k);
      return all;
    }();
    Gltf targets;
    if (first.contains("targets"))
      for (const Gltf& target : first["targets"]) targets.push_back(renamed(k, target, moved));
    for (const std::size_t p : vertices.primitives) {
      const Primitive which{vertices.mesh, p};
      Gltf& now = primitive(which);
      now["attributes"] = new_attributes;
      if (!targets.is_null()) now["targets"] = targets;
      if (is_kept) materials.move(now, set);
      update_indices(which, new_[k], now);
    }
  }

  // Attributes or a target, under the names that they have now.
  Gltf renamed(std::size_t k, const Gltf& attributes, const std::string& moved) {
    Gltf out = Gltf::object();
    for (const auto& [name, number] : attributes.items()) {
      const bool is_replaced =
          (name == texcoord_ && moved.empty()) || (name == kInputVertex && has_blends_);
      if (is_replaced) continue;
      const auto accessor = document_.index(attributes, name.c_str(), "attributes");
      out[name == texcoord_ ? moved : name] =
          new_[k].added().empty() ? accessor : extended(k, attributes, name, accessor);
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

  // The vertices of the mesh: where there are new ones, a reader would number them as it finds
  // them.
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

  // An accessor with the added vertices behind the others; elements are copied as they are, unless
  // there are new ones between them.
  std::size_t extended(std::size_t k, const Gltf& attributes, const std::string& name,
                       std::size_t accessor) {
    const auto [entry, is_new] = extended_.try_emplace(accessor, 0);
    if (!is_new) return entry->second;
    const NewVertices& vertices = new_[k];
    const GltfElements old = document_.elements(accessor, name);
    Gltf json = document_.list("accessors")[accessor];
    for (const char* key : {"bufferView", "byteOffset", "sparse"}) json.erase(key);
    json["count"] = vertices.count();
    std::string bytes;
    const bool is_whole = name.starts_with("JOINTS_") || name.starts_with("_");
    if (!vertices.has_blends() || is_whole) {
      bytes = old.bytes;
      for (const Blend& blend : vertices.added())
        bytes += blend.is_vertex() || name.starts_with("_")
                     ? old.element(nearest(blend))
                     : joints_of(attributes, name, old, blend);
      entry->second = out_.add_accessor(std::move(json), bytes, old.element_size(),
                                        GltfOutput::Target::Vertices);
      return entry->second;
    }
    json["componentType"] = static_cast<int>(GltfComponent::Float);
    json.erase("normalized");
    std::vector<double> low(old.width, INFINITY), high(old.width, -INFINITY);
    const auto add = [&](const std::vector<double>& element) {
      for (std::size_t i = 0; i < old.width; ++i) {
        append_float(element[i], bytes);
        low[i] = std::min(low[i], element[i]);
        high[i] = std::max(high[i], element[i]);
      }
    };
    for (std::size_t e = 0; e < old.count; ++e) add(element_of(old, e));
    for (const Blend& blend : vertices.added())
      add(blend.is_vertex()              ? element_of(old, blend.from[0])
          : name.starts_with("WEIGHTS_") ? weights_of(attributes, name, blend)
                                         : between(old, name, blend));
    const bool has_bounds = json.contains("min") || json.contains("max");
    entry->second = out_.add_accessor(std::move(json), bytes, old.width * sizeof(float),
                                      GltfOutput::Target::Vertices);
    if (has_bounds) out_.set_bounds(entry->second, low, high);
    return entry->second;
  }

  static std::uint32_t nearest(const Blend& blend) {
    Index largest = 0;
    blend.weights.maxCoeff(&largest);
    return blend.from[to_size(largest)];
  }

  static std::vector<double> element_of(const GltfElements& elements, std::size_t e) {
    std::vector<double> values;
    for (std::size_t k = 0; k < elements.width; ++k) values.push_back(elements.value(e, k));
    return values;
  }

  static std::vector<double> between(const GltfElements& elements, const std::string& name,
                                     const Blend& blend) {
    std::vector<double> values(elements.width, 0.0);
    for (std::size_t k = 0; k < 3; ++k) {
      const double weight = blend.weights[static_cast<Index>(k)];
      if (weight == 0) continue;
      for (std::size_t i = 0; i < values.size(); ++i)
        values[i] += weight * elements.value(blend.from[k], i);
    }
    const bool is_normal = name == "NORMAL" && values.size() == 3;
    const bool is_tangent = name == kTangent && values.size() == 4;
    if (!is_normal && !is_tangent) return values;
    const Vector3 direction = Eigen::Map<const Vector3>(values.data()).stableNormalized();
    if (!(direction.norm() > 0)) return element_of(elements, nearest(blend));
    std::copy(direction.begin(), direction.end(), values.begin());
    if (is_tangent) values[3] = elements.value(nearest(blend), 3);  // which side: 1 or -1
    return values;
  }

  // Joints of a new vertex and their weights, as many as its sets hold: the largest of those that
  // its corners have.
  std::vector<std::pair<std::uint32_t, double>> influences(const Gltf& attributes,
                                                           const Blend& blend) {
    std::map<std::uint32_t, double> of_joint;
    std::size_t sets = 0;
    for (;; ++sets) {
      const std::string joints = fmt::format("JOINTS_{}", sets);
      const std::string weights = fmt::format("WEIGHTS_{}", sets);
      if (!attributes.contains(joints) || !attributes.contains(weights)) break;
      const GltfElements& of = cached(attributes, joints);
      const GltfElements& by = cached(attributes, weights);
      for (std::size_t k = 0; k < 3; ++k)
        if (const double weight = blend.weights[static_cast<Index>(k)]; weight != 0)
          for (std::size_t i = 0; i < of.width; ++i)
            if (const double w = by.value(blend.from[k], i); w != 0)
              of_joint[of.integer(blend.from[k], i)] += weight * w;
    }
    std::vector<std::pair<std::uint32_t, double>> list(of_joint.begin(), of_joint.end());
    std::stable_sort(list.begin(), list.end(),
                     [](const auto& a, const auto& b) { return a.second > b.second; });
    list.resize(4 * sets);
    double sum = 0;
    for (const auto& [joint, weight] : list) sum += weight;
    for (auto& [joint, weight] : list) weight /= sum > 0 ? sum : 1;
    return list;
  }

  static std::size_t set_of(const std::string& name) {
    return static_cast<std::size_t>(std::atoi(name.c_str() + name.find('_') + 1));
  }

  std::string joints_of(const Gltf& attributes, const std::string& name, const GltfElements& old,
                        const Blend& blend) {
    const auto list = influences(attributes, blend);
    std::string bytes;
    for (std::size_t i = 0; i < old.width; ++i) {
      const std::size_t at = 4 * set_of(name) + i;
      const std::uint32_t joint = at < list.size() ? list[at].first : 0;
      bytes.append(reinterpret_cast<const char*>(&joint), size_of(old.component));
    }
    return bytes;
  }

  std::vector<double> weights_of(const Gltf& attributes, const std::string& name,
                                 const Blend& blend) {
    const auto list = influences(attributes, blend);
    std::vector<double> values;
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t at = 4 * set_of(name) + i;
      values.push_back(at < list.size() ? list[at].second : 0);
    }
    return values;
  }

  const GltfElements& cached(const Gltf& attributes, const std::string& name) {
    const std::size_t accessor = document_.index(attributes, name.c_str(), "attributes");
    const auto found = elements_.find(accessor);
    if (found != elements_.end()) return found->second;
    return elements_.emplace(accessor, document_.elements(accessor, name)).first->second;
  }

  // Indices stay as they are where nothing has changed.
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

  // Points and lines whose material shows its textures by another set now have it, too.
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

  // Names of images are relative to the file: in another folder it has them itself.
  void embed_images() {
    namespace fs = std::filesystem;
    if (!out_.json().contains("images")) return;
    std::error_code failed;
    const auto folder = [&](const std::string& file) {
      return fs::weakly_canonical(fs::absolute(file, failed).parent_path(), failed);
    };
    if (folder(path_) == folder(document_.path())) return;
    for (Gltf& image : out_.json()["images"]) {
      if (!image.contains("uri")) continue;
      const auto uri = image["uri"].get<std::string>();
      if (uri.starts_with("data:")) continue;
      const std::string file = file_of_uri(document_.path(), uri);
      if (!fs::is_regular_file(file, failed)) continue;
      const std::string bytes = read_whole_file(file);
      const std::string kind = media_type(bytes);
      if (kind.empty()) continue;
      image["bufferView"] = out_.add_view(bytes, 0, GltfOutput::Target::None);
      image["mimeType"] = kind;
      image.erase("uri");
    }
  }

  static std::string media_type(const std::string& bytes) {
    if (bytes.starts_with("\x89PNG")) return "image/png";
    if (bytes.starts_with("\xFF\xD8\xFF")) return "image/jpeg";
    if (bytes.starts_with("RIFF") && bytes.substr(0, 12).ends_with("WEBP")) return "image/webp";
    return {};
  }

  const GltfScene& scene_;
  const GltfDocument& document_;
  const PolygonMesh& input_;
  const PolygonMesh& mesh_;
  const std::vector<PolygonOrigin>& origins_;
  const std::string& path_;
  std::size_t set_;       // of the new coordinates
  std::string texcoord_;  // its name
  GltfOutput out_;
  bool has_blends_ = false;                                         // anywhere
  std::vector<NewVertices> new_;                                    // by Vertices of the scene
  std::map<Primitive, std::vector<std::uint32_t>> before_, after_;  // corners of triangles
  std::map<Index, std::map<Index, double>> weights_;  // by new vertex of the mesh: of corners
  std::map<std::size_t, std::size_t> extended_;       // by accessor, of the Vertices at hand
  std::map<std::size_t, GltfElements> elements_;      // by accessor
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
