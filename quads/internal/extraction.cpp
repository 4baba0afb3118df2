#include "majorant/quads/internal/extraction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "majorant/framework/error.h"
#include "majorant/quads/internal/quantization.h"

namespace majorant {
namespace {

// The distance of point k of an arc that is cut into `count` edges.
std::int64_t cut(std::int64_t length, Index k, Index count) {
  return static_cast<std::int64_t>(WideInteger{length} * k / count);
}

// A rectangle's side, cut into edges: distances from its first corner, of every whole number.
std::vector<std::int64_t> cut_points(const TMesh& mesh, const std::vector<Index>& half_arcs,
                                     const std::vector<Index>& edges) {
  std::vector<std::int64_t> points{0};
  std::int64_t begin = 0;
  for (const Index h : half_arcs) {
    const Index count = edges[arc_of(h)];
    const std::int64_t length = mesh.arcs[arc_of(h)].length();
    for (Index k = 1; k <= count; ++k) {
      // As the arc counts from its own start, so that both of its patches have the same points.
      const std::int64_t from_start = cut(length, h % 2 == 0 ? k : count - k, count);
      points.push_back(begin + (h % 2 == 0 ? from_start : length - from_start));
    }
    begin += length;
  }
  return points;
}

}  // namespace

ExtractedQuads::ExtractedQuads(const SeamlessLattice& lattice, const TMesh& mesh,
                               const std::vector<Index>& edges)
    : lattice_(lattice), mesh_(mesh), edges_(edges), same_(0), same_on_held_(0) {
  vertex_count_ = static_cast<Index>(mesh.nodes.size());
  for (const Index count : edges) {
    first_on_arc_.push_back(vertex_count_);
    vertex_count_ += std::max(count - 1, 0);
  }
  for (const TPatch& patch : mesh.patches) {
    first_in_patch_.push_back(vertex_count_);
    vertex_count_ += std::max(sum_of(patch.sides[0], edges) - 1, 0) *
                     std::max(sum_of(patch.sides[1], edges) - 1, 0);
  }
  same_ = same_on_held_ = UnionFind(vertex_count_);
  join();
}

// The vertex after so many edges of the half-arc.
Index ExtractedQuads::vertex_on(Index half_arc, Index step) const {
  const Index arc = arc_of(half_arc), count = edges_[arc];
  const Index from_start = half_arc % 2 == 0 ? step : count - step;
  if (from_start == 0) return mesh_.arcs[arc].node[0];
  if (from_start == count) return mesh_.arcs[arc].node[1];
  return first_on_arc_[arc] + from_start - 1;
}

std::vector<Index> ExtractedQuads::vertices_of_side(const std::vector<Index>& half_arcs) const {
  std::vector<Index> vertices{mesh_.from_node(half_arcs.front())};
  for (const Index h : half_arcs)
    for (Index k = 1; k <= edges_[arc_of(h)]; ++k) vertices.push_back(vertex_on(h, k));
  return vertices;
}

void ExtractedQuads::join() {
  for (Index a = 0; a < static_cast<Index>(edges_.size()); ++a) {
    if (edges_[a] > 0) continue;
    const auto& [from, to] = mesh_.arcs[a].node;
    same_.join(from, to);
    if (mesh_.is_held(a)) same_on_held_.join(from, to);
  }
  for (const TPatch& patch : mesh_.patches)
    for (std::size_t s = 0; s < 2; ++s) {
      if (sum_of(patch.sides[s], edges_) > 0) continue;
      const std::vector<Index> there = vertices_of_side(patch.sides[s + 1]);
      const std::vector<Index> back = vertices_of_side(patch.sides[(s + 3) % 4]);
      for (std::size_t i = 0; i < there.size(); ++i)
        same_.join(there[i], back[back.size() - 1 - i]);
    }
}

std::vector<Index> ExtractedQuads::vertices_of_held() const {
  std::vector<Index> vertices;
  for (Index a = 0; a < static_cast<Index>(edges_.size()); ++a)
    if (mesh_.is_held(a))
      for (Index k = 0; k <= edges_[a]; ++k) vertices.push_back(vertex_on(2 * a, k));
  return vertices;
}

// By name in same_: whether two cones, corners or stretches of held lines are one vertex.
std::vector<char> ExtractedQuads::joins_too_much() {
  std::vector<char> is_joined(to_size(vertex_count_), 0);
  std::vector<Index> cone = std::vector<Index>(is_joined.size(), -1), stretch = cone;
  for (std::size_t n = 0; n < mesh_.nodes.size(); ++n) {
    if (mesh_.nodes[n].vertex < 0) continue;
    const Index name = same_.find(static_cast<Index>(n));
    if (cone[name] >= 0) is_joined[name] = 1;
    cone[name] = static_cast<Index>(n);
  }
  for (const Index v : vertices_of_held()) {
    const Index name = same_.find(v), own = same_on_held_.find(v);
    if (stretch[name] >= 0 && stretch[name] != own) is_joined[name] = 1;
    stretch[name] = own;
    // A cone from the inside.
    if (cone[name] >= 0 && mesh_.nodes[cone[name]].side == Side::Inside) is_joined[name] = 1;
  }
  return is_joined;
}

std::vector<Index> ExtractedQuads::joining_arcs() {
  std::vector<Index> arcs = arcs_of_short_borders();
  const std::vector<Index> joining = arcs_that_join(joins_too_much());
  arcs.insert(arcs.end(), joining.begin(), joining.end());
  return arcs;
}

std::vector<Index> ExtractedQuads::arcs_of_bad_quads() {
  struct QuadSide {
    std::array<Index, 2> vertices;
    std::size_t patch;
  };
  std::vector<QuadSide> sides;
  std::vector<char> is_bad(to_size(vertex_count_), 0);
  std::vector<std::pair<Index, std::size_t>> bad;  // vertex, patch
  for (std::size_t p = 0; p < mesh_.patches.size(); ++p)
    for (std::array<Index, 4> quad : quads_of(p)) {
      for (Index& v : quad) v = same_.find(v);
      for (std::size_t k = 0; k < 4; ++k) {
        sides.push_back({{quad[k], quad[(k + 1) % 4]}, p});
        if (quad[k] == quad[(k + 1) % 4] || quad[k] == quad[(k + 2) % 4])
          bad.emplace_back(quad[k], p);
      }
    }
  const auto before = [](const QuadSide& a, const QuadSide& b) { return a.vertices < b.vertices; };
  std::stable_sort(sides.begin(), sides.end(), before);
  for (std::size_t i = 1; i < sides.size(); ++i)
    if (sides[i].vertices == sides[i - 1].vertices)
      for (const Index v : sides[i].vertices) bad.emplace_back(v, sides[i].patch);
  for (const auto& [vertex, patch] : bad) is_bad[vertex] = 1;
  std::vector<Index> arcs = arcs_that_join(is_bad);
  if (!arcs.empty()) return arcs;
  const auto edge_length = [&](Index half_arc) {
    const Index a = arc_of(half_arc);
    return static_cast<double>(mesh_.arcs[a].length()) / (edges_[a] + 1);
  };
  for (const auto& [vertex, patch] : bad) {
    Index longest = mesh_.patches[patch].sides[0].front();
    for (const std::vector<Index>& side : mesh_.patches[patch].sides)
      for (const Index h : side)
        if (edge_length(h) > edge_length(longest)) longest = h;
    arcs.push_back(arc_of(longest));
  }
  return arcs;
}

// Of every vertex where is_joined, by its name in same_, the longest.
std::vector<Index> ExtractedQuads::arcs_that_join(const std::vector<char>& is_joined) {
  using Longest = std::map<Index, Index>;  // arc, by vertex
  const auto add = [&](Longest& longest, Index vertex, Index arc) {
    if (edges_[arc] > 0 || !is_joined[vertex]) return;
    const auto [found, is_new] = longest.try_emplace(vertex, arc);
    if (!is_new && mesh_.arcs[arc].length() > mesh_.arcs[found->second].length())
      found->second = arc;
  };
  Longest longest, across;
  for (Index a = 0; a < static_cast<Index>(edges_.size()); ++a)
    add(longest, same_.find(mesh_.arcs[a].node[0]), a);
  // Of vertices that no arc leads to: both long sides of a patch without width are of the border.
  for (const TPatch& patch : mesh_.patches)
    for (std::size_t s = 0; s < 2; ++s) {
      if (sum_of(patch.sides[s], edges_) > 0) continue;
      for (const Index v : vertices_of_side(patch.sides[s + 1]))
        for (const Index h : patch.sides[s]) add(across, same_.find(v), arc_of(h));
    }
  longest.merge(across);
  std::vector<Index> arcs;
  for (const auto& [vertex, arc] : longest) arcs.push_back(arc);
  return arcs;
}

// Loops of the border, and feature lines around, that would have fewer edges than a quad: of each
// the arc with the longest ones.
std::vector<Index> ExtractedQuads::arcs_of_short_borders() const {
  constexpr Index kLeast = 4;
  UnionFind loops(static_cast<Index>(mesh_.nodes.size()));
  // Others than those around are held apart at their ends.
  std::vector<char> is_around(edges_.size(), 0);
  for (Index a = 0; a < static_cast<Index>(edges_.size()); ++a) {
    const std::vector<Index>& of_line = mesh_.lines[mesh_.arcs[a].line].arcs;
    is_around[a] = mesh_.is_on_border(a) ||
                   (mesh_.is_on_feature(a) &&
                    mesh_.arcs[of_line.front()].node[0] == mesh_.arcs[of_line.back()].node[1]);
  }
  for (Index a = 0; a < static_cast<Index>(edges_.size()); ++a)
    if (mesh_.is_on_border(a)) loops.join(mesh_.arcs[a].node[0], mesh_.arcs[a].node[1]);
  struct Loop {
    Index edges = 0, arc = -1;
    double longest = 0;
  };
  std::map<std::pair<Index, Index>, Loop> found;  // by node, and line of features
  for (Index a = 0; a < static_cast<Index>(edges_.size()); ++a) {
    if (!is_around[a]) continue;
    const bool is_border = mesh_.is_on_border(a);
    Loop& loop = found[{is_border ? loops.find(mesh_.arcs[a].node[0]) : -1,
                        is_border ? -1 : mesh_.arcs[a].line}];
    loop.edges += edges_[a];
    const double length = static_cast<double>(mesh_.arcs[a].length()) / (edges_[a] + 1);
    if (length > loop.longest) {
      loop.longest = length;
      loop.arc = a;
    }
  }
  std::vector<Index> arcs;
  for (const auto& [name, loop] : found)
    if (loop.edges < kLeast) arcs.push_back(loop.arc);
  return arcs;
}

// Of the points of an arc, those that a line passes first lie in its first faces.
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
        const Index vertex = k == intervals ? arc.node[1] : vertex_on(2 * a, k);
        positions_[vertex] = position(place);
        // Where a feature ends on the border the vertex is one of the border.
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

// A face has one held edge at most.
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
  // Straight lines pass a face once or a few times, where they wind around.
  for (Index step = 0; step < 10 * surface.face_count(); ++step) {
    Index out = -1;
    for (Index h = 3 * place.face; h < 3 * place.face + 3 && out < 0; ++h) {
      const LatticePoint a = lattice_.corner(h), b = lattice_.corner(next(h));
      // What lies on the line counts as left of it.
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

std::vector<std::array<Index, 4>> ExtractedQuads::quads_of(std::size_t patch) const {
  const auto& sides = mesh_.patches[patch].sides;
  const std::vector<Index> lower = vertices_of_side(sides[0]), right = vertices_of_side(sides[1]),
                           upper = vertices_of_side(sides[2]), left = vertices_of_side(sides[3]);
  const std::size_t p = lower.size() - 1, q = right.size() - 1;
  const auto vertex = [&](std::size_t a, std::size_t b) {
    if (b == 0) return lower[a];
    if (b == q) return upper[p - a];
    if (a == 0) return left[q - b];
    if (a == p) return right[b];
    return first_in_patch_[patch] + static_cast<Index>((b - 1) * (p - 1) + a - 1);
  };
  std::vector<std::array<Index, 4>> quads;
  for (std::size_t b = 0; b < q; ++b)
    for (std::size_t a = 0; a < p; ++a)
      quads.push_back({vertex(a, b), vertex(a + 1, b), vertex(a + 1, b + 1), vertex(a, b + 1)});
  return quads;
}

PolygonMesh ExtractedQuads::polygons() {
  positions_.assign(to_size(vertex_count_), Vector3::Zero());
  on_held_.assign(to_size(vertex_count_), {});
  place_arcs();
  PolygonMesh mesh;
  std::vector<std::array<Index, 4>> quads;
  for (std::size_t i = 0; i < mesh_.patches.size(); ++i) {
    const std::vector<std::array<Index, 4>> more = quads_of(i);
    if (!more.empty()) place_inside(mesh_.patches[i], first_in_patch_[i]);
    quads.insert(quads.end(), more.begin(), more.end());
    patch_of_.resize(quads.size(), static_cast<Index>(i));
  }
  // Joined vertices lie at their cone, else where one of a held line was, else in the middle of
  // where they were.
  std::vector<Vector3> sum(to_size(vertex_count_), Vector3::Zero());
  std::vector<Index> count(to_size(vertex_count_), 0);
  number_.assign(to_size(vertex_count_), -1);
  for (Index v = 0; v < vertex_count_; ++v) {
    const Index name = same_.find(v);
    sum[name] += positions_[v];
    ++count[name];
  }
  std::vector<BorderPoint> on_held(to_size(vertex_count_));
  const auto hold = [&](Index v) {
    sum[same_.find(v)] = positions_[v];
    count[same_.find(v)] = 1;
    on_held[same_.find(v)] = on_held_[v];
  };
  for (const Index v : vertices_of_held()) hold(v);
  for (Index v = 0; v < static_cast<Index>(mesh_.nodes.size()); ++v)
    if (mesh_.nodes[v].vertex >= 0) hold(v);
  for (const auto& quad : quads) {
    std::vector<Index> corners;
    for (const Index v : quad) {
      const Index name = same_.find(v);
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
      const Index from = number_[same_.find(vertex_on(2 * a, k))],
                  to = number_[same_.find(vertex_on(2 * a, k + 1))];
      if (from >= 0 && to >= 0) held.feature_edges.push_back({from, to});
    }
  }
  return held;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
