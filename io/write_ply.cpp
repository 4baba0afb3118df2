#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>

#include "majorant/framework/error.h"
#include "majorant/io/atomic_file.h"
#include "majorant/io/internal/cones_of.h"
#include "majorant/io/io.h"
#include "majorant/io/map_check.h"
#include "majorant/parametrization/tessellation/tessellate_map.h"

namespace majorant {
namespace {

static_assert(std::endian::native == std::endian::little, "write_ply writes memory as it is");

template <class T>
void append(const T& value, std::string& text) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));
  text.append(bytes, sizeof(T));
}

// A vertex of the mesh, with a texture coordinate; -1: no face uses it.
struct PlyVertex {
  Index v, vt;
  auto operator<=>(const PlyVertex&) const = default;
};

class PlyText {
 public:
  explicit PlyText(const PolygonMesh& mesh) : mesh_(mesh) {
    std::vector<char> is_used(mesh.positions.size(), 0);
    for (std::size_t p = 0; p < mesh.polygons.size(); ++p)
      for (std::size_t k = 0; k < mesh.polygons[p].size(); ++k) {
        const Index v = mesh.polygons[p][k];
        is_used[v] = 1;
        numbers_.emplace(PlyVertex{v, mesh.polygon_texcoords[p][k]}, 0);
      }
    for (std::size_t v = 0; v < is_used.size(); ++v)
      if (!is_used[v]) numbers_.emplace(PlyVertex{static_cast<Index>(v), -1}, 0);
    Index next = 0;
    for (auto& [vertex, number] : numbers_) number = next++;
    has_colors_ =
        !mesh.colors.empty() && std::all_of(mesh.colors.begin(), mesh.colors.end(),
                                            [](const Vector3& color) { return color.allFinite(); });
    has_small_faces_ =
        std::all_of(mesh.polygons.begin(), mesh.polygons.end(), [](const auto& polygon) {
          return polygon.size() <= std::numeric_limits<std::uint8_t>::max();
        });
  }

  std::string text(const std::map<Index, int>& cones) const {
    std::string text = header(cones);
    for (const auto& [vertex, number] : numbers_) add_vertex(vertex, text);
    for (std::size_t p = 0; p < mesh_.polygons.size(); ++p) add_face(p, text);
    return text;
  }

 private:
  std::string header(const std::map<Index, int>& cones) const {
    std::string text = "ply\nformat binary_little_endian 1.0\n";
    if (!cones.empty())
      text += "comment cones: vertices count from 0; angle = quarter_turns * 90 degrees\n";
    for (const auto& [vertex, turns] : cones)
      text += fmt::format("comment cone vertex {} quarter_turns {}\n", vertex, turns);
    text += fmt::format("element vertex {}\n", numbers_.size());
    for (const char* name : {"x", "y", "z", "s", "t"})
      text += fmt::format("property double {}\n", name);
    text += "property int input_vertex\n";
    if (has_colors_) text += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    text += fmt::format("element face {}\nproperty list {} int vertex_indices\nend_header\n",
                        mesh_.polygons.size(), has_small_faces_ ? "uchar" : "uint");
    return text;
  }

  void add_vertex(const PlyVertex& vertex, std::string& text) const {
    for (const double x : mesh_.positions[vertex.v]) append(x, text);
    const Vector2 st = vertex.vt < 0 ? Vector2::Zero() : mesh_.texcoords[vertex.vt];
    for (const double x : st) append(x, text);
    append(std::int32_t{vertex.v}, text);
    if (!has_colors_) return;
    for (const double channel : mesh_.colors[vertex.v])
      append(static_cast<std::uint8_t>(std::lround(255 * std::clamp(channel, 0.0, 1.0))), text);
  }

  void add_face(std::size_t p, std::string& text) const {
    const auto& polygon = mesh_.polygons[p];
    if (has_small_faces_)
      append(static_cast<std::uint8_t>(polygon.size()), text);
    else
      append(static_cast<std::uint32_t>(polygon.size()), text);
    for (std::size_t k = 0; k < polygon.size(); ++k)
      append(std::int32_t{numbers_.at({polygon[k], mesh_.polygon_texcoords[p][k]})}, text);
  }

  const PolygonMesh& mesh_;
  std::map<PlyVertex, Index> numbers_;
  bool has_colors_ = false, has_small_faces_ = true;
};

}  // namespace

void write_ply(const std::string& path, const MapFile& map, const PolygonMesh* input,
               const TessellationOptions& options, const FileVerification& verify) {
  require_sound(path, map);
  std::string text;
  try {
    text = PlyText(tessellate_map(map, input, options)).text(cones_of(map));
  } catch (const Error& error) {
    throw Error(error.kind(), fmt::format("cannot write {}: {}", path, error.what()));
  }
  write_file_atomically(path, text, verify);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
