#include "majorant/quads/internal/movable_quads.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>
#include <span>
#include <utility>

namespace majorant {

MovableQuads::MovableQuads(PolygonMesh& mesh, const SurfaceMesh& surface, const HeldVertices& held)
    : mesh_(mesh),
      surface_mesh_(surface),
      surface_(surface),
      has_features_(!held.feature_edges.empty()),
      lengths_(surface, held.is_feature),
      border_(held.points),
      sides_(mesh.positions.size()),
      quads_(mesh.positions.size()),
      likely_(mesh.positions.size(), -1),
      below_(mesh.polygons.size(), -1),
      is_turned_(mesh.polygons.size(), 0) {
  for (Index q = 0; q < static_cast<Index>(mesh.polygons.size()); ++q) {
    for (const Index v : mesh.polygons[q]) quads_[v].push_back(q);
    is_turned_[q] = is_turned(q);
  }
  if (!surface.boundary_loops().empty() || !held.feature_edges.empty()) find_sliding(surface, held);
}

void MovableQuads::place_on_border(std::size_t v, const BorderPoint& point) {
  border_[v] = point;
  mesh_.positions[v] = lengths_.position(point);
}

void MovableQuads::restore(const std::vector<Vector3>& positions,
                           const std::vector<BorderPoint>& border) {
  mesh_.positions = positions;
  border_ = border;
}

std::array<double, 2> MovableQuads::room_of(std::size_t v) const {
  const Index h = border_[v].half_edge;
  const BorderPoint &before = border_[to_size(sides_[v].before)],
                    &after = border_[to_size(sides_[v].after)];
  const double all = lengths_.loop_length(h), here = lengths_.length_at(border_[v]);
  // A neighbour on another line is at the start or the end of this one.
  const auto length_of = [&](const BorderPoint& p, double end) {
    return lengths_.loop_of(p.half_edge) == lengths_.loop_of(h) ? lengths_.length_at(p) : end;
  };
  const auto forward = [&](double length) {
    return lengths_.is_closed(h) ? length - all * std::floor(length / all) : std::max(length, 0.0);
  };
  return {forward(here - length_of(before, 0)), forward(length_of(after, all) - here)};
}

bool MovableQuads::slide(std::size_t v, double by) {
  const BorderPoint before = border_[v];
  const Vector3 place = mesh_.positions[v];
  const double quality = std::min(worst(v), kGood);
  border_[v] = lengths_.point_at(before.half_edge, lengths_.length_at(before) + by);
  mesh_.positions[v] = lengths_.position(border_[v]);
  if (worst(v) >= quality && turns_no_more(v)) return true;
  border_[v] = before;
  mesh_.positions[v] = place;
  return false;
}

std::array<Vector3, 4> MovableQuads::corners_of(Index q) const {
  const std::span<const Index> c = mesh_.polygons[q];
  return {mesh_.positions[c[0]], mesh_.positions[c[1]], mesh_.positions[c[2]],
          mesh_.positions[c[3]]};
}

Vector3 MovableQuads::normal_of(const std::array<Vector3, 4>& p) {
  return (p[2] - p[0]).cross(p[3] - p[1]);
}

bool MovableQuads::is_turned(Index q) {
  const std::array<Vector3, 4> p = corners_of(q);
  const NearestPoint nearest = surface_.tree().nearest((p[0] + p[1] + p[2] + p[3]) / 4, below_[q]);
  below_[q] = nearest.face;
  return surface_.is_away(p, nearest);
}

int MovableQuads::turned_around(std::size_t v) {
  int count = 0;
  for (const Index q : quads_[v]) count += is_turned(q);
  return count;
}

int MovableQuads::known_turned_around(std::size_t v) const {
  int count = 0;
  for (const Index q : quads_[v]) count += is_turned_[q];
  return count;
}

bool MovableQuads::turns_no_more(std::size_t v) {
  const int most = known_turned_around(v);
  int count = 0;
  turned_now_.clear();
  for (const Index q : quads_[v]) {
    turned_now_.push_back(is_turned(q));
    count += turned_now_.back();
    if (count > most) return false;
  }
  for (std::size_t k = 0; k < turned_now_.size(); ++k) is_turned_[quads_[v][k]] = turned_now_[k];
  return true;
}

void MovableQuads::note_turned(std::size_t v) {
  for (const Index q : quads_[v]) is_turned_[q] = is_turned(q);
}

double MovableQuads::worst(std::size_t v) const {
  double least = 1;
  for (const Index q : quads_[v]) {
    const std::array<Vector3, 4> p = corners_of(q);
    const Vector3 n = normal_of(p).stableNormalized();
    for (std::size_t k = 0; k < 4; ++k) least = std::min(least, sine_at(p, k, n));
  }
  return least;
}

Vector3 MovableQuads::middle(std::size_t v) const {
  Vector3 sum = Vector3::Zero();
  for (const Index q : quads_[v]) {
    const std::span<const Index> c = mesh_.polygons[q];
    for (std::size_t k = 0; k < 4; ++k)
      if (c[k] == static_cast<Index>(v))  // every neighbour is the next corner in one quad
        sum += mesh_.positions[c[(k + 1) % 4]];
  }
  return sum / static_cast<double>(quads_[v].size());
}

Vector3 MovableQuads::on_surface(std::size_t v, const Vector3& p) {
  const NearestPoint nearest = surface_.tree().nearest(p, likely_[v]);
  likely_[v] = nearest.face;
  Vector3 point = Vector3::Zero();
  for (int k = 0; k < 3; ++k)
    point += nearest.barycentric[k] *
             Vector3(surface_.positions().row(surface_mesh_.faces()(nearest.face, k)));
  return point;
}

bool MovableQuads::move_towards(std::size_t v, const Vector3& goal) {
  const Vector3 before = mesh_.positions[v];
  const double quality = std::min(worst(v), kGood);
  for (const double part : {1.0, 0.5, 0.25}) {
    mesh_.positions[v] = on_surface(v, before + part * (goal - before));
    if (worst(v) >= quality && turns_no_more(v)) return true;
  }
  mesh_.positions[v] = before;
  return false;
}

Index MovableQuads::face_below_quad(Index q) {
  const std::array<Vector3, 4> p = corners_of(q);
  below_[q] = surface_.tree().nearest((p[0] + p[1] + p[2] + p[3]) / 4, below_[q]).face;
  return below_[q];
}

Index MovableQuads::face_below_vertex(std::size_t v) {
  likely_[v] = surface_.tree().nearest(mesh_.positions[v], likely_[v]).face;
  return likely_[v];
}

Vector3 MovableQuads::normal_below(Index face) const {
  const auto corner = [&](int k) {
    return Vector3(surface_mesh_.positions().row(surface_mesh_.faces()(face, k)));
  };
  return (corner(1) - corner(0)).cross(corner(2) - corner(0)).stableNormalized();
}

double MovableQuads::sine_at(const std::array<Vector3, 4>& p, std::size_t k, const Vector3& n) {
  const Vector3 along = (p[(k + 1) % 4] - p[k]).stableNormalized();
  const Vector3 back = (p[(k + 3) % 4] - p[k]).stableNormalized();
  return along.cross(back).dot(n);
}

void MovableQuads::find_sliding(const SurfaceMesh& surface, const HeldVertices& held) {
  const std::vector<char> is_corner = held_corners(surface, held.is_feature, held.border_turn);
  std::set<std::pair<Index, Index>> edges;
  for (const auto quad : mesh_.polygons)
    for (std::size_t k = 0; k < 4; ++k) edges.emplace(quad[k], quad[(k + 1) % 4]);
  for (const auto& [from, to] : held.feature_edges) {
    sides_[from].after = to;
    sides_[to].before = from;
  }
  for (const auto& [from, to] : edges) {
    if (edges.count({to, from}) > 0) continue;
    sides_[from].after = to;
    sides_[to].before = from;
  }
  for (std::size_t v = 0; v < border_.size(); ++v) {
    const BorderPoint& at = border_[v];
    if (at.half_edge < 0 || sides_[v].before < 0 || sides_[v].after < 0) continue;
    sides_[v].slides = !((at.along == 0 && is_corner[surface.from_vertex(at.half_edge)]) ||
                         (at.along == 1 && is_corner[surface.to_vertex(at.half_edge)]));
  }
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
