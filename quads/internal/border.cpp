#include "majorant/quads/internal/border.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

#include "majorant/quads/features.h"

namespace majorant {

double turn_between(const Vector3& in, const Vector3& out) {
  return std::atan2(in.cross(out).norm(), in.dot(out)) * 180 / std::numbers::pi;
}

std::vector<char> border_corners(const SurfaceMesh& mesh, double border_turn) {
  std::vector<char> is_corner(to_size(mesh.vertex_count()), 0);
  for (const std::vector<Index>& loop : mesh.boundary_loops())
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vector3 p = mesh.input_position(loop[i]);
      const Vector3 in = p - mesh.input_position(loop[(i + loop.size() - 1) % loop.size()]);
      const Vector3 out = mesh.input_position(loop[(i + 1) % loop.size()]) - p;
      is_corner[loop[i]] = turn_between(in, out) >= border_turn;
    }
  return is_corner;
}

std::vector<char> held_corners(const SurfaceMesh& mesh, const std::vector<char>& is_feature,
                               double border_turn) {
  std::vector<char> is_corner = border_corners(mesh, border_turn);
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
