#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <vector>

#include "majorant/framework/error.h"
#include "majorant/framework/pair_order.h"
#include "majorant/io/atomic_file.h"
#include "majorant/io/formats.h"
#include "majorant/io/internal/cell_writers.h"
#include "majorant/io/internal/cones_of.h"
#include "majorant/io/io.h"
#include "majorant/io/map_check.h"
#include "majorant/io/written_mark.h"
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

// A vertex of the mesh with a texture coordinate; -1: without faces.
struct PlyVertex {
  Index v, vt;
  auto operator<=>(const PlyVertex&) const = default;
};

class PlyText {
 public:
  explicit PlyText(const PolygonMesh& mesh) : mesh_(mesh) {
    for (std::size_t p = 0; p < mesh.polygons.size(); ++p)
      for (std::size_t k = 0; k < mesh.polygons[p].size(); ++k)
        corners_.push_back({mesh.polygons[p][k], mesh.polygon_texcoords[p][k]});
    const auto positions = static_cast<Index>(mesh.positions.size());
    const PairOrder order(positions, static_cast<Index>(corners_.size()),
                          [&](Index corner) { return corners_[corner]; });
    numbers_.resize(corners_.size());
    for (Index v = 0; v < positions; ++v) {
      if (order.of(v).empty()) vertices_.push_back({v, -1});
      for (const auto& [vt, corner] : order.of(v)) {
        if (vertices_.empty() || vertices_.back() != PlyVertex{v, vt}) vertices_.push_back({v, vt});
        numbers_[corner] = static_cast<Index>(vertices_.size()) - 1;
      }
    }
    has_colors_ =
        !mesh.colors.empty() && std::all_of(mesh.colors.begin(), mesh.colors.end(),
                                            [](const Vector3& color) { return color.allFinite(); });
    has_small_faces_ =
        std::all_of(mesh.polygons.begin(), mesh.polygons.end(), [](const auto polygon) {
          return polygon.size() <= std::numeric_limits<std::uint8_t>::max();
        });
  }

  std::string text(const std::map<Index, int>& cones) const {
    std::string text = header(cones);
    constexpr std::size_t kVertex = 5 * sizeof(double) + sizeof(std::int32_t) + 3;
    text.reserve(text.size() + kVertex * vertices_.size() +
                 sizeof(std::int32_t) * (mesh_.polygons.size() + numbers_.size()));
    for (const PlyVertex& vertex : vertices_) add_vertex(vertex, text);
    std::size_t corner = 0;
    for (const auto polygon : mesh_.polygons) {
      if (has_small_faces_)
        append(static_cast<std::uint8_t>(polygon.size()), text);
      else
        append(static_cast<std::uint32_t>(polygon.size()), text);
      for (std::size_t k = 0; k < polygon.size(); ++k)
        append(std::int32_t{numbers_[corner++]}, text);
    }
    return text;
  }

 private:
  std::string header(const std::map<Index, int>& cones) const {
    std::string text = "ply\nformat binary_little_endian 1.0\n" + mark_text(MarkStyle::PlyComment);
    if (!cones.empty()) text += fmt::format("comment {}\n", kConesComment);
    for (const auto& [vertex, turns] : cones)
      text += fmt::format("comment {}\n", cone_comment(vertex, turns));
    text += fmt::format("element vertex {}\n", vertices_.size());
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

  const PolygonMesh& mesh_;
  std::vector<PlyVertex> vertices_, corners_;  // ascending; corners polygon by polygon
  std::vector<Index> numbers_;                 // number of the vertex, by corner
  bool has_colors_ = false, has_small_faces_ = true;
};

}  // namespace

std::string ply_text(const PolygonMesh& mesh) {
  std::string text = fmt::format(
      "ply\nformat binary_little_endian 1.0\n{}element vertex {}\nproperty double x\nproperty "
      "double "
      "y\nproperty double z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
      mark_text(MarkStyle::PlyComment), mesh.positions.size(), mesh.polygons.size());
  for (const Vector3& p : mesh.positions)
    for (const double x : p) append(x, text);
  for (const auto polygon : mesh.polygons) {
    append(static_cast<std::uint8_t>(polygon.size()), text);
    for (const Index v : polygon) append(std::int32_t{v}, text);
  }
  return text;
}

void write_ply(const std::string& path, const MapFile& map, const PolygonMesh* input,
               const TessellationOptions& options, const FileVerification& verify) {
  require_sound(path, map);
  if (input != nullptr) require_complete(path, map);
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
