// glTF 2.0 and GLB. A file that was read from glTF is kept except for changes by new texture
// coordinates. Other meshes become a file with one mesh.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "majorant/framework/error.h"
#include "majorant/io/atomic_file.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/files/srgb.h"
#include "majorant/io/float_room.h"
#include "majorant/io/gltf_layout.h"
#include "majorant/io/internal/gltf_output.h"
#include "majorant/io/internal/gltf_scene.h"
#include "majorant/io/internal/gltf_update.h"
#include "majorant/io/internal/plain_materials.h"
#include "majorant/io/io.h"
#include "majorant/io/map_check.h"
#include "majorant/parametrization/tessellation/tessellate_map.h"

namespace majorant {
namespace {

// A vertex of the file: vertex of the mesh, texture coordinate, normal and old texture coordinate;
// -1: none.
struct Corner {
  Index v = -1, vt = -1, vn = -1, old = -1;
  auto operator<=>(const Corner&) const = default;
};

// A triangle of the file.
struct Triangle {
  std::array<Corner, 3> corners;
  int material = -1;
};

// A file with one mesh and a primitive for each material.
class PlainFile {
 public:
  // input: the mesh that the map was made from, or null; origins: for each polygon of `mesh`, its
  // polygon in the input.
  PlainFile(const PolygonMesh& mesh, const PolygonMesh* input,
            const std::vector<PolygonOrigin>& origins, std::size_t uv_set)
      : mesh_(mesh), input_(input), origins_(origins), uv_set_(uv_set) {
    if (input != nullptr) materials_ = plain_materials(*input);
    collect_triangles();
    drop_equal_coordinates();
    number_vertices();
  }

  GltfOutput output(const std::string& path) const {
    GltfOutput out({{"asset", {{"version", "2.0"}}},
                    {"scene", 0},
                    {"scenes", {{{"nodes", {0}}}}},
                    {"nodes", {{{"mesh", 0}}}}});
    Gltf attributes{{"POSITION", add_positions(out)}};
    add_texcoords(out, attributes);
    if (has_normals_)
      attributes["NORMAL"] = add_floats(out, 3, [&](const Corner& c, std::size_t k) {
        if (c.vn < 0) return k == 2 ? 1.0 : 0.0;  // vertices without faces
        return mesh_.normals[c.vn].stableNormalized()[static_cast<Index>(k)];
      });
    const bool has_colors = !mesh_.colors.empty() &&
                            std::all_of(mesh_.colors.begin(), mesh_.colors.end(),
                                        [](const Vector3& color) { return color.allFinite(); });
    if (has_colors)
      attributes["COLOR_0"] = add_floats(out, 3, [&](const Corner& c, std::size_t k) {
        return srgb_to_linear(std::clamp(mesh_.colors[c.v][static_cast<Index>(k)], 0.0, 1.0));
      });
    attributes[kInputVertex] = add_numbers(out);
    add_materials(out);
    Gltf primitives = Gltf::array();
    for (int material = -1; material < static_cast<int>(materials_.materials.size()); ++material)
      add_primitive(out, attributes, material, primitives);
    out.json()["meshes"] = {{{"primitives", primitives}}};
    mark_layout_set(out.json(), uv_set_, path);
    return out;
  }

 private:
  // Splits polygons into the same triangles as a reader of their texture coordinates.
  void collect_triangles() {
    has_normals_ = mesh_.polygon_normals.size() == mesh_.polygons.size() &&
                   std::all_of(mesh_.polygon_normals.begin(), mesh_.polygon_normals.end(),
                               [](const auto list) { return !list.empty(); }) &&
                   std::all_of(mesh_.normals.begin(), mesh_.normals.end(),
                               [](const Vector3& n) { return n.stableNorm() > 0; });
    const bool has_old = input_ != nullptr && !input_->polygon_texcoords.empty() &&
                         (uv_set_ > 0 || !materials_.images.empty());
    const MapFile cells = to_map_file(mesh_);
    for (Index c = 0; c < cells.cells.rows(); ++c) {
      const auto p = to_size(cells.input_face[c]);
      Triangle triangle;
      if (!materials_.of_polygon.empty())
        triangle.material = materials_.of_polygon[to_size(origins_[p].polygon)];
      for (std::size_t k = 0; k < 3; ++k) {
        std::size_t corner = 0;
        triangle.corners[k] = corner_at(p, cells, cells.cells(c, static_cast<Index>(k)), corner);
        if (has_old) triangle.corners[k].old = old_texcoord(p, corner);
      }
      triangles_.push_back(triangle);
    }
  }

  // Returns the input's coordinates at a corner of a polygon: (0, 0) if it has none.
  Index old_texcoord(std::size_t p, std::size_t corner) {
    const PlaceOnPolygon& place = origins_[p].corners[corner];
    const auto& texture = input_->polygon_texcoords[to_size(origins_[p].polygon)];
    Vector2 uv = Vector2::Zero();
    for (std::size_t k = 0; k < 3 && !texture.empty(); ++k)
      if (const double weight = place.weights[static_cast<Index>(k)]; weight != 0)
        uv += weight * input_->texcoords[to_size(texture[place.corners[k]])];
    const auto [entry, is_new] =
        old_numbers_.try_emplace({uv.x(), uv.y()}, static_cast<Index>(old_.size()));
    if (is_new) old_.push_back(uv);
    return entry->second;
  }

  // Old coordinates that equal the new ones need no set.
  void drop_equal_coordinates() {
    for (const Triangle& triangle : triangles_)
      for (const Corner& corner : triangle.corners)
        has_old_ = has_old_ || (corner.old >= 0 &&
                                old_[to_size(corner.old)] != mesh_.texcoords[to_size(corner.vt)]);
    if (has_old_) return;
    for (Triangle& triangle : triangles_)
      for (Corner& corner : triangle.corners) corner.old = -1;
  }

  // Returns the set by which materials show their images: that of the old coordinates, or of the
  // new ones.
  std::size_t shown_set() const { return has_old_ && uv_set_ == 0 ? 1 : 0; }

  // Sets have no gaps: those before the new coordinates are the old ones, or copies of the new
  // ones.
  void add_texcoords(GltfOutput& out, Gltf& attributes) const {
    const auto add = [&](const auto& uv_of) {
      return add_floats(out, 2, [&](const Corner& c, std::size_t k) {
        const Vector2 uv = uv_of(c);
        return k == 0 ? uv.x() : 1 - uv.y();
      });
    };
    const std::size_t layout = add([&](const Corner& c) {
      return c.vt < 0 ? Vector2(Vector2::Zero()) : mesh_.texcoords[to_size(c.vt)];
    });
    attributes[fmt::format("TEXCOORD_{}", uv_set_)] = layout;
    const std::size_t old = has_old_ ? add([&](const Corner& c) {
      return c.old < 0 ? Vector2(Vector2::Zero()) : old_[to_size(c.old)];
    })
                                     : layout;
    for (std::size_t set = 0; set < uv_set_; ++set)
      attributes[fmt::format("TEXCOORD_{}", set)] = set == 0 ? old : layout;
    if (has_old_ && uv_set_ == 0) attributes["TEXCOORD_1"] = old;
  }

  void add_materials(GltfOutput& out) const {
    constexpr int kClamp = 33071;
    Gltf& document = out.json();
    for (const PlainMaterials::Image& image : materials_.images) {
      Gltf texture{{"source", document.contains("images") ? document["images"].size() : 0}};
      document["images"].push_back(
          {{"bufferView", out.add_view(image.bytes, 0, GltfOutput::Target::None)},
           {"mimeType", image.mime}});
      if (image.clamps) {
        document["samplers"] = {{{"wrapS", kClamp}, {"wrapT", kClamp}}};
        texture["sampler"] = 0;
      }
      document["textures"].push_back(std::move(texture));
    }
    for (const PlainMaterials::Material& material : materials_.materials) {
      Gltf entry = material.json;
      if (material.image >= 0) {
        Gltf& texture = entry["pbrMetallicRoughness"]["baseColorTexture"];
        texture = {{"index", material.image}};
        if (shown_set() > 0) texture["texCoord"] = shown_set();
      }
      document["materials"].push_back(std::move(entry));
    }
  }

  void add_primitive(GltfOutput& out, const Gltf& attributes, int material,
                     Gltf& primitives) const {
    std::vector<std::uint32_t> indices;
    for (const Triangle& triangle : triangles_)
      if (triangle.material == material)
        for (const Corner& corner : triangle.corners)
          indices.push_back(static_cast<std::uint32_t>(
              std::lower_bound(vertices_.begin(), vertices_.end(), corner) - vertices_.begin()));
    if (indices.empty()) return;
    Gltf primitive{{"attributes", attributes},
                   {"indices", add_indices(out, indices, vertices_.size(), GltfComponent::UShort)}};
    if (material >= 0) primitive["material"] = material;
    primitives.push_back(std::move(primitive));
  }

  // k: the corner of the polygon, an output.
  Corner corner_at(std::size_t p, const MapFile& cells, Index point, std::size_t& k) const {
    const auto& polygon = mesh_.polygons[p];
    const Vector2 uv = cells.uv.row(point);
    k = 0;
    while (polygon[k] != cells.input_vertex[point] ||
           mesh_.texcoords[mesh_.polygon_texcoords[p][k]] != uv)
      ++k;
    return {polygon[k], mesh_.polygon_texcoords[p][k],
            has_normals_ ? mesh_.polygon_normals[p][k] : -1};
  }

  void number_vertices() {
    std::vector<char> is_used(mesh_.positions.size(), 0);
    for (const Triangle& triangle : triangles_)
      for (const Corner& corner : triangle.corners) {
        is_used[corner.v] = 1;
        vertices_.push_back(corner);
      }
    for (std::size_t v = 0; v < is_used.size(); ++v)
      if (!is_used[v]) vertices_.push_back({static_cast<Index>(v)});
    std::sort(vertices_.begin(), vertices_.end());
    vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
  }

  template <class Value>
  std::size_t add_floats(GltfOutput& out, std::size_t width, const Value& value) const {
    std::string bytes;
    for (const Corner& vertex : vertices_)
      for (std::size_t k = 0; k < width; ++k) append_float(value(vertex, k), bytes);
    return out.add_accessor({{"componentType", static_cast<int>(GltfComponent::Float)},
                             {"type", fmt::format("VEC{}", width)},
                             {"count", vertices_.size()}},
                            bytes, width * sizeof(float), GltfOutput::Target::Vertices);
  }

  std::size_t add_positions(GltfOutput& out) const {
    const std::size_t accessor = add_floats(out, 3, [&](const Corner& c, std::size_t k) {
      return mesh_.positions[c.v][static_cast<Index>(k)];
    });
    Vector3 low = mesh_.positions.front(), high = low;
    for (const Vector3& p : mesh_.positions) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    out.set_bounds(accessor, {low.begin(), low.end()}, {high.begin(), high.end()});
    return accessor;
  }

  std::size_t add_numbers(GltfOutput& out) const {
    std::string bytes;
    for (const Corner& vertex : vertices_)
      append_bytes(static_cast<std::uint32_t>(vertex.v), bytes);
    return out.add_accessor({{"componentType", static_cast<int>(GltfComponent::UShort)},
                             {"type", "VEC2"},
                             {"count", vertices_.size()}},
                            bytes, sizeof(std::uint32_t), GltfOutput::Target::Vertices);
  }

  const PolygonMesh& mesh_;
  const PolygonMesh* input_;
  const std::vector<PolygonOrigin>& origins_;
  std::size_t uv_set_;  // set of the new coordinates
  PlainMaterials materials_;
  std::vector<Triangle> triangles_;
  std::vector<Corner> vertices_;  // ascending
  std::vector<Vector2> old_;      // coordinates of the input
  std::map<std::pair<double, double>, Index> old_numbers_;
  bool has_normals_ = false, has_old_ = false;
};

std::string bytes_of(const std::string& path, const MapFile& map, const PolygonMesh* input,
                     const TessellationOptions& options, std::size_t uv_set) {
  require_sound(path, map);
  if (input != nullptr) require_complete(path, map);
  try {
    std::vector<PolygonOrigin> origins;
    const PolygonMesh mesh =
        tessellate_map(with_room_in_floats(map, StoredV::Down), input, options, &origins);
    const bool is_gltf = input != nullptr && input->gltf != nullptr;
    const GltfOutput output = is_gltf
                                  ? updated_gltf(*input->gltf, *input, mesh, origins, path, uv_set)
                                  : PlainFile(mesh, input, origins, uv_set).output(path);
    return format_of(path) == ".glb" ? output.glb() : output.text();
  } catch (const Error& error) {
    throw Error(error.kind(), fmt::format("cannot write {}: {}", path, error.what()));
  }
}

}  // namespace

std::string gltf_bytes(const std::string& path, const MapFile& map, const PolygonMesh* input,
                       const TessellationOptions& options) {
  return bytes_of(path, map, input, options, 0);
}

void write_gltf(const std::string& path, const MapFile& map, const PolygonMesh* input,
                const TessellationOptions& options, const FileVerification& verify) {
  write_gltf(path, map, input, options, verify, 0);
}

void write_gltf(const std::string& path, const MapFile& map, const PolygonMesh* input,
                const TessellationOptions& options, const FileVerification& verify,
                std::size_t uv_set) {
  write_file_atomically(path, bytes_of(path, map, input, options, uv_set), verify);
}

std::vector<std::string> left_out_of_gltf(const PolygonMesh& input) {
  return input.gltf != nullptr ? std::vector<std::string>() : plain_materials(input).left_out;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
