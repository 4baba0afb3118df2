#include "majorant/mesh/marked_creases.h"

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

#include "majorant/mesh/surface_mesh.h"

namespace majorant {
namespace {

// Normals farther apart are different: half a degree, more than the rounding of three digits.
constexpr double kSameNormal = 1e-2;
// Marks on more than this part of the length of all edges are ignored.
constexpr double kMost = 0.5;

constexpr std::string_view kSpaces = " \t\r";

std::string_view trimmed(std::string_view text) {
  const std::size_t from = text.find_first_not_of(kSpaces);
  if (from == std::string_view::npos) return {};
  return text.substr(from, text.find_last_not_of(kSpaces) - from + 1);
}

// Returns the content of the last line with this keyword before each polygon; empty if there is
// none.
std::vector<std::string> states(const PolygonMesh& polygons, std::string_view keyword) {
  std::vector<std::string> state(polygons.polygons.size());
  std::string now;
  std::size_t p = 0;
  const auto hold_until = [&](std::size_t end) {
    for (; p < end && p < state.size(); ++p) state[p] = now;
  };
  for (const auto& [polygon, line] : polygons.directives) {
    const std::string_view text = trimmed(line);
    const std::size_t end = text.find_first_of(kSpaces);
    if (text.substr(0, end) != keyword) continue;
    hold_until(to_size(polygon));
    now = end == std::string_view::npos ? "" : trimmed(text.substr(end));
  }
  hold_until(state.size());
  return state;
}

// Adds the edges with is_marked to the creases, unless they exceed the part `most` of all edges.
void add_marks(const SurfaceMesh& mesh, const std::function<bool(Index, Index)>& is_marked,
               double most, std::vector<char>& creases) {
  double all = 0, marked = 0;
  std::vector<Index> half_edges;
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    const Index o = mesh.opposite(h);
    if (o < h || mesh.input_face(face_of(h)) == mesh.input_face(face_of(o))) continue;
    const double length = mesh.edge_length(h);
    all += length;
    if (!is_marked(h, o)) continue;
    marked += length;
    half_edges.push_back(h);
  }
  if (marked > most * all) return;
  for (const Index h : half_edges) creases[h] = creases[mesh.opposite(h)] = 1;
}

}  // namespace

std::vector<char> marked_creases(const PolygonMesh& polygons, const RepairedSurface& surface) {
  const SurfaceMesh& mesh = *surface.mesh;
  std::vector<char> creases(to_size(mesh.half_edge_count()), 0);
  const auto polygon = [&](Index h) { return to_size(mesh.input_face(face_of(h))); };
  if (!polygons.directives.empty()) {
    const std::vector<std::string> material = states(polygons, "usemtl"),
                                   group = states(polygons, "s");
    add_marks(
        mesh, [&](Index h, Index o) { return material[polygon(h)] != material[polygon(o)]; }, 1,
        creases);
    const auto is_off = [](const std::string& s) { return s == "off" || s == "0"; };
    add_marks(
        mesh,
        [&](Index h, Index o) {
          return group[polygon(h)] != group[polygon(o)] || is_off(group[polygon(h)]);
        },
        kMost, creases);
  }
  if (polygons.polygon_normals.empty()) return creases;
  const auto normal = [&](Index h) -> Vector3 {
    const std::span<const Index> list = polygons.polygon_normals[polygon(h)];
    if (list.empty()) return Vector3::Zero();
    const Index corner = surface.polygon_corner(face_of(h), corner_of(h));
    return polygons.normals[to_size(list[to_size(corner)])].stableNormalized();
  };
  const auto differ = [&](Index a, Index b) {
    const Vector3 n = normal(a), m = normal(b);
    return !n.isZero() && !m.isZero() && (n - m).norm() > kSameNormal;
  };
  add_marks(
      mesh, [&](Index h, Index o) { return differ(h, next(o)) || differ(next(h), o); }, kMost,
      creases);
  return creases;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
