#include "majorant/quads/internal/extraction.h"

#include <algorithm>
#include <cmath>

#include "majorant/framework/error.h"
#include "majorant/quads/internal/quantization.h"

namespace majorant {
namespace {

// Returns the distance of point k of an arc that is divided into `count` edges.
std::int64_t cut(std::int64_t length, Index k, Index count) {
  return static_cast<std::int64_t>(WideInteger{length} * k / count);
}

// Returns the distances of all points of a rectangle's side from its first corner.
std::vector<std::int64_t> cut_points(const TMesh& mesh, const std::vector<Index>& half_arcs,
                                     const std::vector<Index>& edges) {
  std::vector<std::int64_t> points{0};
  std::int64_t begin = 0;
  for (const Index h : half_arcs) {
    const Index count = edges[arc_of(h)];
    const std::int64_t length = mesh.arcs[arc_of(h)].length();
    for (Index k = 1; k <= count; ++k) {
      // Distances are measured from the arc's own start, so that both patches get the same points.
      const std::int64_t from_start = cut(length, h % 2 == 0 ? k : count - k, count);
      points.push_back(begin + (h % 2 == 0 ? from_start : length - from_start));
    }
    begin += length;
  }
  return points;
}

}  // namespace

// Places the points of arcs. Points that a line passes first lie in its first faces.
void ExtractedQuads::place_arcs() {
  places_.resize(mesh_.arcs.size());
  for (const TraceLine& line : mesh_.lines) {
    std::size_t leg = 0;
    for (const Index a : line.arcs) {
      const TArc& arc = mesh_.arcs[a];
      const Index count = edges_[a], intervals = std::max(count, 1);
      for (Index k = 0; k <= intervals; ++k) {
        const std::int64_t distance = arc.begin + cut(arc.length(), k, intervals);
        while (leg + 1 < line.legs.size() &&
               !lattice_.contains(line.legs[leg].face, line.legs[leg].at(distance)))
          ++leg;
        const Place place{line.legs[leg].face, line.legs[leg].at(distance),
                          line.legs[leg].direction};
        if (!lattice_.contains(place.face, place.at))
          throw Error(ErrorKind::Infeasible, "a point of a patch's side is in none of its faces");
        places_[a].push_back(place);
        const Index vertex = k == intervals ? arc.node[1] : connectivity_.vertex_on(2 * a, k);
        positions_[vertex] = position(place);
        // A vertex at the end of a feature on the border is a border vertex.
        const bool is_first = on_held_[vertex].half_edge < 0;
        if (line.side == Side::Border || (line.side == Side::Feature && is_first))
          on_held_[vertex] = held_point(place);
      }
    }
  }
  for (std::size_t n = 0; n < mesh_.nodes.size(); ++n)
    if (const Index v = mesh_.nodes[n].vertex; v >= 0)
      positions_[n] = lattice_.surface().input_position(v);
}

// A face has at most one held edge.
BorderPoint ExtractedQuads::held_point(const Place& place) const {
  Index h = 3 * place.face;
  while (lattice_.surface().opposite(h) >= 0 && !lattice_.is_feature(h)) ++h;
  const LatticePoint edge = lattice_.corner(next(h)) - lattice_.corner(h);
  const double along = static_cast<double>(dot(place.at - lattice_.corner(h), edge)) /
                       static_cast<double>(dot(edge, edge));
  return {h, along};
}

Vector3 ExtractedQuads::position(const Place& place) const {
  const Index h = 3 * place.face;
  const LatticePoint a = lattice_.corner(h), b = lattice_.corner(h + 1), c = lattice_.corner(h + 2);
  const auto area = static_cast<double>(cross(b - a, c - a));
  const double first = static_cast<double>(cross(b - place.at, c - place.at)) / area;
  const double second = static_cast<double>(cross(c - place.at, a - place.at)) / area;
  const SurfaceMesh& surface = lattice_.surface();
  const auto corner = [&](Index k) { return surface.input_position(surface.from_vertex(h + k)); };
  return first * corner(0) + second * corner(1) + (1 - first - second) * corner(2);
}

void ExtractedQuads::walk(Place& place, LatticePoint by) const {
  LatticePoint goal = place.at + turned(by, place.direction);
  const SurfaceMesh& surface = lattice_.surface();
  // A straight line crosses a face once, or a few times if it winds around.
  for (Index step = 0; step < 10 * surface.face_count(); ++step) {
    Index out = -1;
    for (Index h = 3 * place.face; h < 3 * place.face + 3 && out < 0; ++h) {
      const LatticePoint a = lattice_.corner(h), b = lattice_.corner(next(h));
      // A goal on the line counts as left of it.
      if (side(a, b, goal) < 0 && side(place.at, goal, a) < 0 && side(place.at, goal, b) >= 0)
        out = h;
    }
    if (out >= 0 && surface.opposite(out) < 0) break;
    if (out < 0) {
      if (!lattice_.contains(place.face, goal)) break;
      place.at = goal;
      return;
    }
    place.at = lattice_.beyond(out, place.at);
    goal = lattice_.beyond(out, goal);
    place.direction = lattice_.direction_beyond(out, place.direction);
    place.face = face_of(surface.opposite(out));
  }
  throw Error(ErrorKind::Infeasible, "a point inside of a patch was not found on the surface");
}

void ExtractedQuads::place_inside(const TPatch& patch, Index first) {
  const std::vector<std::int64_t> lower = cut_points(mesh_, patch.sides[0], edges_),
                                  right = cut_points(mesh_, patch.sides[1], edges_),
                                  upper = cut_points(mesh_, patch.sides[2], edges_),
                                  left = cut_points(mesh_, patch.sides[3], edges_);
  const std::size_t p = lower.size() - 1, q = right.size() - 1;
  const auto width = static_cast<double>(patch.width), height = static_cast<double>(patch.height);
  std::size_t column = 0;
  for (const Index h : patch.sides[0]) {
    const Index count = edges_[arc_of(h)];
    for (Index k = 1; k <= count; ++k) {
      if (++column == p) return;
      Place place = places_[arc_of(h)][h % 2 == 0 ? k : count - k];
      if (h % 2 == 1) place.direction = quarter(place.direction + 2);
      const auto x0 = static_cast<double>(lower[column]);
      const double dx = static_cast<double>(patch.width - upper[p - column]) - x0;
      LatticePoint here{lower[column], 0};
      for (std::size_t j = 1; j < q; ++j) {
        // x = x0 + dx y / height, y = y0 + dy x / width.
        const auto y0 = static_cast<double>(patch.height - left[q - j]);
        const double dy = static_cast<double>(right[j]) - y0;
        const double y = (y0 + dy * x0 / width) / (1 - dx * dy / (width * height));
        const double x = x0 + dx * y / height;
        const LatticePoint there{std::llround(x), std::llround(y)};
        walk(place, there - here);
        here = there;
        positions_[first + static_cast<Index>((j - 1) * (p - 1) + column - 1)] = position(place);
      }
    }
  }
}

PolygonMesh ExtractedQuads::polygons() {
  positions_.assign(to_size(connectivity_.vertex_count()), Vector3::Zero());
  on_held_.assign(to_size(connectivity_.vertex_count()), {});
  place_arcs();
  PolygonMesh mesh;
  std::vector<std::array<Index, 4>> quads;
  for (std::size_t i = 0; i < mesh_.patches.size(); ++i) {
    const std::vector<std::array<Index, 4>> more = connectivity_.quads_of(i);
    if (!more.empty()) place_inside(mesh_.patches[i], connectivity_.first_in_patch(i));
    quads.insert(quads.end(), more.begin(), more.end());
    patch_of_.resize(quads.size(), static_cast<Index>(i));
  }
  // A joined vertex lies at its cone, else at a vertex of a held line, else at the mean of its
  // vertices.
  std::vector<Vector3> sum(to_size(connectivity_.vertex_count()), Vector3::Zero());
  std::vector<Index> count(to_size(connectivity_.vertex_count()), 0);
  number_.assign(to_size(connectivity_.vertex_count()), -1);
  for (Index v = 0; v < connectivity_.vertex_count(); ++v) {
    const Index name = connectivity_.joined(v);
    sum[name] += positions_[v];
    ++count[name];
  }
  std::vector<BorderPoint> on_held(to_size(connectivity_.vertex_count()));
  const auto hold = [&](Index v) {
    sum[connectivity_.joined(v)] = positions_[v];
    count[connectivity_.joined(v)] = 1;
    on_held[connectivity_.joined(v)] = on_held_[v];
  };
  for (const Index v : connectivity_.vertices_of_held()) hold(v);
  for (Index v = 0; v < static_cast<Index>(mesh_.nodes.size()); ++v)
    if (mesh_.nodes[v].vertex >= 0) hold(v);
  for (const auto& quad : quads) {
    std::vector<Index> corners;
    for (const Index v : quad) {
      const Index name = connectivity_.joined(v);
      if (number_[name] < 0) {
        number_[name] = static_cast<Index>(mesh.positions.size());
        mesh.positions.push_back(sum[name] / count[name]);
        held_points_.push_back(on_held[name]);
      }
      corners.push_back(number_[name]);
    }
    mesh.polygons.push_back(corners);
  }
  return mesh;
}

HeldVertices ExtractedQuads::held_vertices() {
  HeldVertices held{held_points_, lattice_.features(), {}, lattice_.border_turn()};
  for (Index a = 0; a < static_cast<Index>(edges_.size()); ++a) {
    if (!mesh_.is_on_feature(a)) continue;
    for (Index k = 0; k < edges_[a]; ++k) {
      const Index from = number_[connectivity_.joined(connectivity_.vertex_on(2 * a, k))],
                  to = number_[connectivity_.joined(connectivity_.vertex_on(2 * a, k + 1))];
      if (from >= 0 && to >= 0) held.feature_edges.push_back({from, to});
    }
  }
  return held;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
