// glTF 2.0 and GLB. A file that was read from glTF comes back with all that it had, but for what
// new texture coordinates change; of other meshes a file of one mesh is made.
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
#include "majorant/io/internal/gltf_output.h"
#include "majorant/io/internal/gltf_scene.h"
#include "majorant/io/internal/gltf_update.h"
#include "majorant/io/io.h"
#include "majorant/io/map_check.h"
#include "majorant/parametrization/tessellation/tessellate_map.h"

namespace majorant {
namespace {

// A vertex of the file: of the mesh, with a texture coordinate and a normal; -1: none.
struct Corner {
  Index v = -1, vt = -1, vn = -1;
  auto operator<=>(const Corner&) const = default;
};

// One mesh, of one primitive.
class PlainFile {
 public:
  explicit PlainFile(const PolygonMesh& mesh) : mesh_(mesh) {
    collect_corners();
    number_vertices();
  }

  GltfOutput output() const {
    GltfOutput out({{"asset", {{"version", "2.0"}}},
                    {"scene", 0},
                    {"scenes", {{{"nodes", {0}}}}},
                    {"nodes", {{{"mesh", 0}}}}});
    Gltf attributes{{"POSITION", add_positions(out)},
                    {"TEXCOORD_0", add_floats(out, 2, [&](const Corner& c, std::size_t k) {
                       const Vector2 uv = c.vt < 0 ? Vector2::Zero() : mesh_.texcoords[c.vt];
                       return k == 0 ? uv.x() : 1 - uv.y();
                     })}};
    if (has_normals_)
      attributes["NORMAL"] = add_floats(out, 3, [&](const Corner& c, std::size_t k) {
        if (c.vn < 0) return k == 2 ? 1.0 : 0.0;  // of no face
        return mesh_.normals[c.vn].stableNormalized()[static_cast<Index>(k)];
      });
    const bool has_colors = !mesh_.colors.empty() &&
                            std::all_of(mesh_.colors.begin(), mesh_.colors.end(),
                                        [](const Vector3& color) { return color.allFinite(); });
    if (has_colors)
      attributes["COLOR_0"] = add_floats(out, 3, [&](const Corner& c, std::size_t k) {
        return std::clamp(mesh_.colors[c.v][static_cast<Index>(k)], 0.0, 1.0);
      });
    attributes[kInputVertex] = add_numbers(out);
    std::vector<std::uint32_t> indices;
    for (const Corner& corner : corners_)
      indices.push_back(static_cast<std::uint32_t>(
          std::lower_bound(vertices_.begin(), vertices_.end(), corner) - vertices_.begin()));
    const std::size_t last = add_indices(out, indices, vertices_.size(), GltfComponent::UShort);
    out.json()["meshes"] = {{{"primitives", {{{"attributes", attributes}, {"indices", last}}}}}};
    return out;
  }

 private:
  // Polygons are the triangles that a reader of their texture coordinates makes of them.
  void collect_corners() {
    has_normals_ = mesh_.polygon_normals.size() == mesh_.polygons.size() &&
                   std::all_of(mesh_.polygon_normals.begin(), mesh_.polygon_normals.end(),
                               [](const auto list) { return !list.empty(); }) &&
                   std::all_of(mesh_.normals.begin(), mesh_.normals.end(),
                               [](const Vector3& n) { return n.stableNorm() > 0; });
    const MapFile cells = to_map_file(mesh_);
    for (Index c = 0; c < cells.cells.rows(); ++c) {
      const auto p = to_size(cells.input_face[c]);
      for (Index k = 0; k < 3; ++k) corners_.push_back(corner_at(p, cells, cells.cells(c, k)));
    }
  }

  Corner corner_at(std::size_t p, const MapFile& cells, Index point) const {
    const auto& polygon = mesh_.polygons[p];
    const Vector2 uv = cells.uv.row(point);
    std::size_t k = 0;
    while (polygon[k] != cells.input_vertex[point] ||
           mesh_.texcoords[mesh_.polygon_texcoords[p][k]] != uv)
      ++k;
    return {polygon[k], mesh_.polygon_texcoords[p][k],
            has_normals_ ? mesh_.polygon_normals[p][k] : -1};
  }

  void number_vertices() {
    std::vector<char> is_used(mesh_.positions.size(), 0);
    for (const Corner& corner : corners_) is_used[corner.v] = 1;
    vertices_ = corners_;
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
  std::vector<Corner> corners_, vertices_;  // of the triangles; ascending
  bool has_normals_ = false;
};

}  // namespace

std::string gltf_bytes(const std::string& path, const MapFile& map, const PolygonMesh* input,
                       const TessellationOptions& options) {
  require_sound(path, map);
  if (input != nullptr) require_complete(path, map);
  try {
    std::vector<PolygonOrigin> origins;
    const PolygonMesh mesh = tessellate_map(map, input, options, &origins);
    const bool is_gltf = input != nullptr && input->gltf != nullptr;
    const GltfOutput output = is_gltf ? updated_gltf(*input->gltf, *input, mesh, origins, path)
                                      : PlainFile(mesh).output();
    return format_of(path) == ".glb" ? output.glb() : output.text();
  } catch (const Error& error) {
    throw Error(error.kind(), fmt::format("cannot write {}: {}", path, error.what()));
  }
}

void write_gltf(const std::string& path, const MapFile& map, const PolygonMesh* input,
                const TessellationOptions& options, const FileVerification& verify) {
  write_file_atomically(path, gltf_bytes(path, map, input, options), verify);
}

bool drops_tangents(const PolygonMesh& input) {
  return input.gltf != nullptr && has_tangents(*input.gltf);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
