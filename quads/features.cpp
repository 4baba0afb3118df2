#include "majorant/quads/features.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace majorant {
namespace {

double degrees_between(const Vector3& a, const Vector3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi;
}

Vector3 normal_of(const SurfaceMesh& mesh, Index face) {
  const auto corner = [&](int k) { return Vector3(mesh.positions().row(mesh.faces()(face, k))); };
  return (corner(1) - corner(0)).cross(corner(2) - corner(0)).stableNormalized();
}

// Returns the angle between the normals of the faces at an inner edge, in degrees.
double turn_at(const SurfaceMesh& mesh, Index half_edge) {
  return degrees_between(normal_of(mesh, face_of(half_edge)),
                         normal_of(mesh, face_of(mesh.opposite(half_edge))));
}

class LineFinder {
 public:
  LineFinder(const SurfaceMesh& mesh, const std::vector<char>& is_feature)
      : mesh_(mesh),
        is_used_(to_size(mesh.half_edge_count()), 0),
        leaving_(to_size(mesh.vertex_count())) {
    found_.is_corner.assign(to_size(mesh.vertex_count()), 0);
    for (Index h = 0; h < static_cast<Index>(is_feature.size()); ++h)
      if (is_feature[h] && mesh.opposite(h) >= 0) leaving_[mesh.from_vertex(h)].push_back(h);
  }

  FeatureLines find() {
    const std::vector<char> is_border = mesh_.boundary_flags();
    for (Index v = 0; v < mesh_.vertex_count(); ++v)
      found_.is_corner[v] = !leaving_[v].empty() && (is_border[v] || is_corner(v));
    for (const bool at_corners : {true, false})
      for (Index v = 0; v < mesh_.vertex_count(); ++v)
        if (!at_corners || found_.is_corner[v])
          for (const Index h : leaving_[v])
            if (!is_used_[h]) follow(h);
    return std::move(found_);
  }

 private:
  bool is_corner(Index v) const {
    if (leaving_[v].size() != 2) return true;
    const Vector3 p = mesh_.input_position(v);
    const Vector3 in = p - mesh_.input_position(mesh_.to_vertex(leaving_[v][0]));
    const Vector3 out = mesh_.input_position(mesh_.to_vertex(leaving_[v][1])) - p;
    return degrees_between(in, out) >= kCornerTurn;
  }

  void follow(Index first) {
    FeatureLine& line = found_.lines.emplace_back();
    Index h = first;
    for (;;) {
      line.half_edges.push_back(h);
      line.length += mesh_.edge_length(h);
      is_used_[h] = is_used_[mesh_.opposite(h)] = 1;
      const Index v = mesh_.to_vertex(h);
      if (found_.is_corner[v] || v == mesh_.from_vertex(first)) break;
      h = leaving_[v][0] == mesh_.opposite(h) ? leaving_[v][1] : leaving_[v][0];
    }
    line.is_closed = mesh_.to_vertex(h) == mesh_.from_vertex(first);
  }

  const SurfaceMesh& mesh_;
  std::vector<char> is_used_;                // by half-edge
  std::vector<std::vector<Index>> leaving_;  // by vertex: feature half-edges that leave it
  FeatureLines found_;
};

}  // namespace

std::vector<char> sharp_edges(const SurfaceMesh& mesh, double degrees) {
  std::vector<char> has_shape(to_size(mesh.face_count()), 1);
  for (const RestTriangle& rest : mesh.rest_triangles()) has_shape[rest.face] = 0;
  std::vector<char> is_sharp(to_size(mesh.half_edge_count()), 0);
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    const Index o = mesh.opposite(h);
    if (o < h) continue;  // o is -1 at the boundary
    const Index f = face_of(h), g = face_of(o);
    if (!has_shape[f] || !has_shape[g] || mesh.input_face(f) == mesh.input_face(g)) continue;
    is_sharp[h] = is_sharp[o] = turn_at(mesh, h) >= degrees;
  }
  return is_sharp;
}

FeatureLines feature_lines(const SurfaceMesh& mesh, const std::vector<char>& is_feature) {
  return LineFinder(mesh, is_feature).find();
}

std::vector<char> without_short_lines(const SurfaceMesh& mesh, std::vector<char> is_feature,
                                      double edge_length, ShortLines short_lines) {
  // edge lengths; chosen, not tuned
  constexpr double kShortest = 2, kShortestLoose = 4, kShortestSharp = 0.5;
  const std::vector<char> is_border = mesh.boundary_flags();
  for (bool has_changed = true; has_changed;) {
    has_changed = false;
    std::vector<int> edges(to_size(mesh.vertex_count()), 0);
    for (std::size_t h = 0; h < is_feature.size(); ++h)
      edges[mesh.from_vertex(static_cast<Index>(h))] += is_feature[h];
    const auto is_loose = [&](Index v) { return edges[v] == 1 && !is_border[v]; };
    for (const FeatureLine& line : feature_lines(mesh, is_feature).lines) {
      const bool has_loose_end = is_loose(mesh.from_vertex(line.half_edges.front())) ||
                                 is_loose(mesh.to_vertex(line.half_edges.back()));
      const bool is_sharp = short_lines == ShortLines::SharpKept && !has_loose_end &&
                            std::all_of(line.half_edges.begin(), line.half_edges.end(),
                                        [&](Index h) { return turn_at(mesh, h) >= kSharpTurn; });
      const double shortest =
          is_sharp ? kShortestSharp : (has_loose_end ? kShortestLoose : kShortest);
      if (line.length >= edge_length * shortest) continue;
      for (const Index h : line.half_edges) is_feature[h] = is_feature[mesh.opposite(h)] = 0;
      has_changed = true;
    }
  }
  return is_feature;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
