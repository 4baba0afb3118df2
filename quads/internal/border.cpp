#include "majorant/quads/internal/border.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <set>
#include <utility>

#include "majorant/quads/features.h"

namespace majorant {
namespace {

// Cuts faces into smaller ones, whose numbers and corners it collects.
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
    std::vector<Index> first;  // new face of every old one
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
  // Messages name it as the vertex of the file that is near.
  Index new_vertex(const Vector3& p, Index near) {
    points_.push_back(p);
    parts_.input_vertex.push_back(mesh_.input_vertex(near));
    return static_cast<Index>(points_.size()) - 1;
  }

  void place_middles() {
    std::vector<char> is_on_held(to_size(mesh_.vertex_count()), 0);
    for (Index h = 0; h < mesh_.half_edge_count(); ++h)
      if (is_held_[h]) is_on_held[mesh_.from_vertex(h)] = is_on_held[mesh_.to_vertex(h)] = 1;
    middle_.assign(to_size(mesh_.half_edge_count()), -1);
    for (Index h = 0; h < mesh_.half_edge_count(); ++h) {
      const Index o = mesh_.opposite(h), a = mesh_.from_vertex(h), b = mesh_.to_vertex(h);
      if (o < h || is_held_[h] || !is_on_held[a] || !is_on_held[b]) continue;
      if (is_kept_[face_of(h)] || is_kept_[face_of(o)]) continue;
      middle_[h] = middle_[o] = new_vertex((points_[a] + points_[b]) / 2, a);
    }
  }

  void divide(Index f) {
    std::vector<Index> around;  // corners and middles
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

  // From a middle, so that every new edge has one.
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

RoomySurface with_room(const SurfaceMesh& mesh, const std::vector<char>& is_feature) {
  RoomySurface roomy{Divider(mesh, is_feature).divided(), {}};
  if (is_feature.empty()) return roomy;
  // No feature is cut.
  std::set<std::pair<Index, Index>> edges;
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    if (is_feature[h]) edges.emplace(mesh.from_vertex(h), mesh.to_vertex(h));
  for (Index h = 0; h < roomy.mesh.half_edge_count(); ++h)
    roomy.is_feature.push_back(edges.count({roomy.mesh.from_vertex(h), roomy.mesh.to_vertex(h)}) >
                               0);
  return roomy;
}

std::vector<char> border_corners(const SurfaceMesh& mesh) {
  std::vector<char> is_corner(to_size(mesh.vertex_count()), 0);
  for (const std::vector<Index>& loop : mesh.boundary_loops())
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vector3 p = mesh.input_position(loop[i]);
      const Vector3 in = p - mesh.input_position(loop[(i + loop.size() - 1) % loop.size()]);
      const Vector3 out = mesh.input_position(loop[(i + 1) % loop.size()]) - p;
      const double turn = std::atan2(in.cross(out).norm(), in.dot(out)) * 180 / std::numbers::pi;
      is_corner[loop[i]] = turn >= kCornerTurn;
    }
  return is_corner;
}

std::vector<char> held_corners(const SurfaceMesh& mesh, const std::vector<char>& is_feature) {
  std::vector<char> is_corner = border_corners(mesh);
  if (is_feature.empty()) return is_corner;
  const std::vector<char> of_features = feature_lines(mesh, is_feature).is_corner;
  for (std::size_t v = 0; v < is_corner.size(); ++v) is_corner[v] |= of_features[v];
  return is_corner;
}

BorderLengths::BorderLengths(const SurfaceMesh& mesh, const std::vector<char>& is_feature)
    : mesh_(mesh),
      loop_of_(to_size(mesh.half_edge_count()), -1),
      begin_(to_size(mesh.half_edge_count()), 0) {
  for (const auto& loop : boundary_half_edges(mesh.faces(), mesh.opposites())) add_loop(loop, true);
  for (const FeatureLine& line : feature_lines(mesh, is_feature).lines)
    add_loop(line.half_edges, line.is_closed);
}

void BorderLengths::add_loop(const std::vector<Index>& half_edges, bool is_closed) {
  double length = 0;
  std::map<double, Index>& by_length = loops_.emplace_back();
  for (const Index h : half_edges) {
    loop_of_[h] = static_cast<Index>(loops_.size()) - 1;
    begin_[h] = length;
    by_length.emplace(length, h);
    length += mesh_.edge_length(h);
  }
  loop_length_.push_back(length);
  is_closed_.push_back(is_closed);
}

double BorderLengths::loop_length(Index half_edge) const {
  return loop_length_[loop_of_[half_edge]];
}

double BorderLengths::length_at(const BorderPoint& point) const {
  return begin_[point.half_edge] + point.along * mesh_.edge_length(point.half_edge);
}

BorderPoint BorderLengths::point_at(Index half_edge, double length) const {
  const double all = loop_length(half_edge);
  length =
      is_closed(half_edge) ? length - all * std::floor(length / all) : std::clamp(length, 0.0, all);
  const std::map<double, Index>& loop = loops_[loop_of_[half_edge]];
  const auto [begin, h] = *std::prev(loop.upper_bound(std::max(length, 0.0)));
  return {h, std::clamp((length - begin) / mesh_.edge_length(h), 0.0, 1.0)};
}

Vector3 BorderLengths::position(const BorderPoint& point) const {
  const Vector3 a = mesh_.input_position(mesh_.from_vertex(point.half_edge));
  const Vector3 b = mesh_.input_position(mesh_.to_vertex(point.half_edge));
  return (1 - point.along) * a + point.along * b;
}

std::vector<char> held_flags(const SurfaceMesh& mesh, const std::vector<char>& is_feature) {
  std::vector<char> is_held;
  for (std::size_t h = 0; h < mesh.opposites().size(); ++h)
    is_held.push_back(mesh.opposites()[h] < 0 || (!is_feature.empty() && is_feature[h]));
  return is_held;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
