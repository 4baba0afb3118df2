#include "majorant/quads/internal/resolved_surface.h"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "majorant/quads/internal/border.h"

namespace majorant {
namespace {

// Divides faces and collects the numbers and corners of the new ones.
class Divider {
 public:
  Divider(const SurfaceMesh& mesh, const std::vector<char>& is_feature)
      : mesh_(mesh), is_held_(held_flags(mesh, is_feature)), parts_(mesh.parts()) {
    is_kept_.assign(to_size(mesh.face_count()), 0);
    for (const RestTriangle& rest : mesh.rest_triangles()) is_kept_[rest.face] = 1;
    for (const auto& p : parts_.positions.rowwise()) points_.emplace_back(p);
  }

  SurfaceMesh divided() {
    place_middles();
    std::vector<Index> first;  // first new face of each old one
    for (Index f = 0; f < mesh_.face_count(); ++f) {
      first.push_back(static_cast<Index>(faces_.size()));
      divide(f);
    }
    if (points_.size() == to_size(mesh_.vertex_count())) return SurfaceMesh::from_parts(parts_);
    for (RestTriangle& rest : parts_.rest_triangles) rest.face = first[rest.face];
    parts_.positions.resize(static_cast<Index>(points_.size()), 3);
    for (std::size_t v = 0; v < points_.size(); ++v)
      parts_.positions.row(static_cast<Index>(v)) = points_[v];
    parts_.faces.resize(static_cast<Index>(faces_.size()), 3);
    for (std::size_t f = 0; f < faces_.size(); ++f)
      for (int k = 0; k < 3; ++k) parts_.faces(static_cast<Index>(f), k) = faces_[f][k];
    parts_.input_face = input_face_;
    parts_.corner_texcoords.resize(0, 6);
    parts_.texcoord_ids.resize(0, 3);
    return SurfaceMesh::from_parts(std::move(parts_));
  }

 private:
  // Messages name the new vertex as the nearby vertex of the file.
  Index new_vertex(const Vector3& p, Index near) {
    points_.push_back(p);
    parts_.input_vertex.push_back(mesh_.input_vertex(near));
    return static_cast<Index>(points_.size()) - 1;
  }

  void place_middles() {
    std::vector<char> is_on_held(to_size(mesh_.vertex_count()), 0);
    for (Index h = 0; h < mesh_.half_edge_count(); ++h)
      if (is_held_[h]) is_on_held[mesh_.from_vertex(h)] = is_on_held[mesh_.to_vertex(h)] = 1;
    std::vector<char> is_enclosed(to_size(mesh_.vertex_count()), 1);
    for (Index v = 0; v < mesh_.vertex_count(); ++v) is_enclosed[v] = !is_on_held[v];
    for (Index h = 0; h < mesh_.half_edge_count(); ++h)
      if (!is_on_held[mesh_.to_vertex(h)]) is_enclosed[mesh_.from_vertex(h)] = 0;
    middle_.assign(to_size(mesh_.half_edge_count()), -1);
    for (Index h = 0; h < mesh_.half_edge_count(); ++h) {
      const Index o = mesh_.opposite(h), a = mesh_.from_vertex(h), b = mesh_.to_vertex(h);
      const bool is_between =
          (is_on_held[a] || is_enclosed[a]) && (is_on_held[b] || is_enclosed[b]);
      if (o < h || is_held_[h] || !is_between) continue;
      if (is_kept_[face_of(h)] || is_kept_[face_of(o)]) continue;
      middle_[h] = middle_[o] = new_vertex((points_[a] + points_[b]) / 2, a);
    }
  }

  void divide(Index f) {
    std::vector<Index> around;  // corners and midpoints
    bool is_all_held = true;
    for (Index h = 3 * f; h < 3 * f + 3; ++h) {
      around.push_back(mesh_.from_vertex(h));
      if (middle_[h] >= 0) around.push_back(middle_[h]);
      is_all_held &= is_held_[h] != 0;
    }
    if (around.size() == 3 && (!is_all_held || is_kept_[f])) {
      add(f, {around[0], around[1], around[2]});
    } else if (is_all_held || around.size() == 6) {
      const Vector3 sum = points_[mesh_.faces()(f, 0)] + points_[mesh_.faces()(f, 1)] +
                          points_[mesh_.faces()(f, 2)];
      const Index center = new_vertex(sum / 3, around[0]);
      for (std::size_t k = 0; k < around.size(); ++k)
        add(f, {around[k], around[(k + 1) % around.size()], center});
    } else {
      fan(f, around);
    }
  }

  // Starts at a midpoint, so that every new edge has one.
  void fan(Index f, const std::vector<Index>& around) {
    std::size_t first = 0;
    while (around[first] < mesh_.vertex_count()) ++first;
    const std::size_t n = around.size();
    for (std::size_t k = 1; k + 1 < n; ++k)
      add(f, {around[first], around[(first + k) % n], around[(first + k + 1) % n]});
  }

  void add(Index f, const std::array<Index, 3>& corners) {
    faces_.push_back(corners);
    input_face_.push_back(mesh_.input_face(f));
  }

  const SurfaceMesh& mesh_;
  const std::vector<char> is_held_;  // by half-edge
  SurfaceParts parts_;
  std::vector<char> is_kept_;  // by face
  std::vector<Index> middle_;  // by half-edge
  std::vector<Vector3> points_;
  std::vector<std::array<Index, 3>> faces_;
  std::vector<Index> input_face_;
};

}  // namespace

ResolvedSurface resolve_feature_edges(const SurfaceMesh& mesh,
                                      const std::vector<char>& is_feature) {
  ResolvedSurface resolved{Divider(mesh, is_feature).divided(), {}};
  if (is_feature.empty()) return resolved;
  // Edges that are features must not be cut.
  std::set<std::pair<Index, Index>> edges;
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    if (is_feature[h]) edges.emplace(mesh.from_vertex(h), mesh.to_vertex(h));
  for (Index h = 0; h < resolved.mesh.half_edge_count(); ++h)
    resolved.is_feature.push_back(
        edges.count({resolved.mesh.from_vertex(h), resolved.mesh.to_vertex(h)}) > 0);
  return resolved;
}

ResolvedSurface subdivided(const ResolvedSurface& surface) {
  const SurfaceMesh& mesh = surface.mesh;
  SurfaceParts parts = mesh.parts();
  const Index vertices = mesh.vertex_count(), faces = mesh.face_count();
  std::vector<Index> middle(to_size(mesh.half_edge_count()), -1);
  std::vector<Vector3> added;
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    if (middle[h] >= 0) continue;
    middle[h] = vertices + static_cast<Index>(added.size());
    if (const Index o = mesh.opposite(h); o >= 0) middle[o] = middle[h];
    added.emplace_back(
        (mesh.positions().row(mesh.from_vertex(h)) + mesh.positions().row(mesh.to_vertex(h))) / 2);
    // Messages name the new vertex as the nearby vertex of the file.
    parts.input_vertex.push_back(mesh.input_vertex(mesh.from_vertex(h)));
  }
  parts.positions.conservativeResize(vertices + static_cast<Index>(added.size()), 3);
  for (std::size_t k = 0; k < added.size(); ++k)
    parts.positions.row(vertices + static_cast<Index>(k)) = added[k];
  parts.faces.resize(4 * faces, 3);
  parts.input_face.clear();
  ResolvedSurface result{mesh, {}, surface.border_turn};
  for (Index f = 0; f < faces; ++f) {
    const std::array<Index, 3> m = {middle[3 * f], middle[3 * f + 1], middle[3 * f + 2]};
    // There are three faces at the corners, which keep their numbers, and one between them.
    parts.faces.row(4 * f) << mesh.faces()(f, 0), m[0], m[2];
    parts.faces.row(4 * f + 1) << m[0], mesh.faces()(f, 1), m[1];
    parts.faces.row(4 * f + 2) << m[2], m[1], mesh.faces()(f, 2);
    parts.faces.row(4 * f + 3) << m[1], m[2], m[0];
    for (int k = 0; k < 4; ++k) parts.input_face.push_back(mesh.input_face(f));
    if (surface.is_feature.empty()) continue;
    const auto flag = [&](Index k) { return surface.is_feature[3 * f + k]; };
    for (const char is_feature : {flag(0), char{0}, flag(2), flag(0), flag(1), char{0}, char{0},
                                  flag(1), flag(2), char{0}, char{0}, char{0}})
      result.is_feature.push_back(is_feature);
  }
  parts.rest_triangles.clear();
  for (const auto& [face, corners] : mesh.rest_triangles()) {
    const auto& [a, b, c] = corners;
    const Vector2 ab = (a + b) / 2, bc = (b + c) / 2, ca = (c + a) / 2;
    parts.rest_triangles.push_back({4 * face, {a, ab, ca}});
    parts.rest_triangles.push_back({4 * face + 1, {ab, b, bc}});
    parts.rest_triangles.push_back({4 * face + 2, {ca, bc, c}});
    parts.rest_triangles.push_back({4 * face + 3, {bc, ca, ab}});
  }
  parts.corner_texcoords.resize(0, 6);
  parts.texcoord_ids.resize(0, 3);
  result.mesh = SurfaceMesh::from_parts(std::move(parts));
  return result;
}

ResolvedSurface smooth_border(const ResolvedSurface& surface) {
  // Sweeps move vertices to the middle of both neighbours until no turn exceeds this angle, in
  // degrees; the field ignores turns below 45. More sweeps would leave faces near the border
  // without area. Chosen, not tuned.
  constexpr int kMaxSweeps = 6;
  constexpr double kSmooth = 30;
  const SurfaceMesh& mesh = surface.mesh;
  const std::vector<char> is_corner = held_corners(mesh, surface.is_feature, surface.border_turn);
  SurfaceParts parts = mesh.parts();
  for (const std::vector<Index>& loop : mesh.boundary_loops()) {
    const std::size_t n = loop.size();
    std::vector<Vector3> points;
    for (const Index v : loop) points.emplace_back(mesh.positions().row(v));
    for (int sweep = 0; sweep < kMaxSweeps; ++sweep) {
      double most = 0;
      std::vector<Vector3> moved = points;
      for (std::size_t i = 0; i < n; ++i) {
        if (is_corner[loop[i]]) continue;
        const Vector3 &before = points[(i + n - 1) % n], &after = points[(i + 1) % n];
        most = std::max(most, turn_between(points[i] - before, after - points[i]));
        moved[i] = (before + 2 * points[i] + after) / 4;
      }
      if (most <= kSmooth) break;
      points = std::move(moved);
    }
    for (std::size_t i = 0; i < n; ++i) parts.positions.row(loop[i]) = points[i];
  }
  return {SurfaceMesh::from_parts(std::move(parts)), surface.is_feature, surface.border_turn};
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
