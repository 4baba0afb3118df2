// The connectivity of a set of polygons: the pairing of sides to edges, the fans of corners around
// vertices, border loops, components and their Euler numbers. Polygons have kCorners corners each;
// their half-edges are those of HalfEdgesOf<kCorners>.
//
//   const Cells quads = (Cells(2, 4) << 0, 1, 4, 3, 1, 2, 5, 4).finished();
//   const auto from = [&](Index h) { return quads(h / 4, h % 4); };
//   const auto ends = [&](Index h) { return std::pair(from(h), from(HalfEdgesOf<4>::next(h))); };
//   const PairedSides sides = pair_sides(6, 8, ends);
//   const bool has_single_fans = touching_vertices<4>(sides.opposite, from).empty();
//   const bool is_surface = sides.is_manifold() && has_single_fans;
//   const std::size_t loops = border_loops<4>(sides.opposite).size();
//
// opposite: for each half-edge the other side of its edge, or -1. Not for three-dimensional cells,
// whose sides have up to four corners and no half-edges (volumes/internal/mesh_sides.h).
#pragma once

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "majorant/framework/pair_order.h"
#include "majorant/mesh/index_lists.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/mesh/union_find.h"

namespace majorant {

// The half-edges of polygons with kCorners corners each: kCorners f + k starts at corner k of f.
template <Index kCorners>
struct HalfEdgesOf {
  static constexpr Index face(Index half_edge) { return half_edge / kCorners; }
  static constexpr Index corner(Index half_edge) { return half_edge % kCorners; }
  static constexpr Index next(Index half_edge) {
    return half_edge % kCorners == kCorners - 1 ? half_edge - (kCorners - 1) : half_edge + 1;
  }
  static constexpr Index previous(Index half_edge) {
    return half_edge % kCorners == 0 ? half_edge + (kCorners - 1) : half_edge - 1;
  }
};

// Sorts half-edges by the smaller and the larger end of their edges. ends(h): the start and end
// vertex of h, both below `vertices`; a half-edge with a negative start is left out.
template <class Ends>
PairOrder order_of_edges(Index vertices, Index half_edges, const Ends& ends) {
  return {vertices, half_edges, [&](Index h) {
            const auto [from, to] = ends(h);
            return std::pair(std::min(from, to), std::max(from, to));
          }};
}

// The sides of edges, paired. Edges are ordered by their smaller ends, then by their larger ones;
// the sides of an edge are ascending.
struct PairedSides {
  std::vector<Index> opposite;  // the other side of an edge with two sides, in either direction
  IndexLists crowded;           // the sides of every edge of more than two
  std::vector<Index> same_way;  // the first sides of edges whose two sides run the same way

  bool is_manifold() const { return crowded.empty() && same_way.empty(); }
};

// ends: as for order_of_edges(). layer(h): sides in different layers are of different edges.
template <class Ends, class Layer>
PairedSides pair_sides(Index vertices, Index half_edges, const Ends& ends, const Layer& layer) {
  PairedSides result;
  result.opposite.assign(to_size(half_edges), -1);
  std::vector<std::pair<Index, Index>> sides;  // layer and half-edge
  const auto take = [&](Index h, Index o) {
    result.opposite[h] = o;
    result.opposite[o] = h;
    if (ends(h).first == ends(o).first) result.same_way.push_back(h);
  };
  const auto order = order_of_edges(vertices, half_edges, ends);
  order.for_each_run([&](std::span<const PairOrder::Entry> edge) {
    if (edge.size() == 1) return;
    const Index h = edge[0].number, o = edge[1].number;
    if (edge.size() == 2 && layer(h) == layer(o)) return take(h, o);
    sides.clear();
    for (const auto& [ignored, side] : edge) sides.emplace_back(layer(side), side);
    std::sort(sides.begin(), sides.end());
    for (std::size_t first = 0, last = 0; first < sides.size(); first = last) {
      while (last < sides.size() && sides[last].first == sides[first].first) ++last;
      if (last - first == 2) take(sides[first].second, sides[first + 1].second);
      if (last - first < 3) continue;
      std::vector<Index> crowded;
      for (std::size_t s = first; s < last; ++s) crowded.push_back(sides[s].second);
      result.crowded.push_back(crowded);
    }
  });
  return result;
}

template <class Ends>
PairedSides pair_sides(Index vertices, Index half_edges, const Ends& ends) {
  return pair_sides(vertices, half_edges, ends, [](Index) { return 0; });
}

// Returns for every corner (by the half-edge that leaves it) its fan, named by one of the fan's
// corners. Faces need not be oriented alike. agrees(h): whether h and opposite[h] run in opposite
// directions.
template <Index kCorners, class Agrees>
std::vector<Index> corner_fans(const std::vector<Index>& opposite, const Agrees& agrees) {
  using Sides = HalfEdgesOf<kCorners>;
  const auto count = static_cast<Index>(opposite.size());
  UnionFind fans(count);
  for (Index h = 0; h < count; ++h) {
    const Index o = opposite[h];
    if (o < h) continue;
    const bool against = agrees(h);
    fans.join(h, against ? Sides::next(o) : o);
    fans.join(Sides::next(h), against ? o : Sides::next(o));
  }
  std::vector<Index> fan(opposite.size());
  for (Index h = 0; h < count; ++h) fan[h] = fans.find(h);
  return fan;
}

// Returns the vertices whose faces form several fans, ascending. Faces must be oriented alike.
// from(h): the vertex that h leaves.
template <Index kCorners, class From>
std::vector<Index> touching_vertices(const std::vector<Index>& opposite, const From& from) {
  using Sides = HalfEdgesOf<kCorners>;
  const auto count = static_cast<Index>(opposite.size());
  std::vector<Index> corners_left;  // by vertex: those outside the fan of its first corner
  for (Index h = 0; h < count; ++h) {
    const auto v = to_size(from(h));
    if (v >= corners_left.size()) corners_left.resize(v + 1, 0);
    ++corners_left[v];
  }
  std::vector<char> is_met(corners_left.size(), 0);  // by vertex
  for (Index h = 0; h < count; ++h) {
    const Index v = from(h);
    if (std::exchange(is_met[v], 1)) continue;
    --corners_left[v];
    Index at = opposite[Sides::previous(h)];  // counterclockwise, as far as there are faces
    for (; at >= 0 && at != h; at = opposite[Sides::previous(at)]) --corners_left[v];
    if (at == h) continue;
    for (at = opposite[h]; at >= 0; at = opposite[Sides::next(at)]) --corners_left[v];  // clockwise
  }
  std::vector<Index> touching;
  for (std::size_t v = 0; v < corners_left.size(); ++v)
    if (corners_left[v] != 0) touching.push_back(static_cast<Index>(v));
  return touching;
}

// Returns the border as loops of half-edges, each of which starts where the one before it ends,
// with the faces on the left. Each loop starts at its smallest half-edge; loops are ordered by it.
// A vertex where faces merely touch occurs once for every fan. Faces must be oriented alike.
template <Index kCorners>
std::vector<std::vector<Index>> border_loops(const std::vector<Index>& opposite) {
  using Sides = HalfEdgesOf<kCorners>;
  const auto count = static_cast<Index>(opposite.size());
  std::vector<char> is_met(opposite.size(), 0);
  std::vector<std::vector<Index>> loops;
  for (Index first = 0; first < count; ++first) {
    if (opposite[first] >= 0 || is_met[first]) continue;
    std::vector<Index>& loop = loops.emplace_back();
    for (Index h = first; !is_met[h];) {
      is_met[h] = 1;
      loop.push_back(h);
      for (h = Sides::next(h); opposite[h] >= 0;) h = Sides::next(opposite[h]);
    }
  }
  return loops;
}

// Returns for every face the number of its component (connected across edges). Components are
// numbered by their first faces.
template <Index kCorners>
std::vector<Index> components_of_faces(const std::vector<Index>& opposite) {
  using Sides = HalfEdgesOf<kCorners>;
  const auto count = static_cast<Index>(opposite.size()) / kCorners;
  std::vector<Index> component(to_size(count), -1), open;
  Index next_number = 0;
  for (Index first = 0; first < count; ++first) {
    if (component[first] >= 0) continue;
    component[first] = next_number;
    for (open.push_back(first); !open.empty();) {
      const Index f = open.back();
      open.pop_back();
      for (Index h = kCorners * f; h < kCorners * (f + 1); ++h) {
        if (opposite[h] < 0 || component[Sides::face(opposite[h])] >= 0) continue;
        component[Sides::face(opposite[h])] = next_number;
        open.push_back(Sides::face(opposite[h]));
      }
    }
    ++next_number;
  }
  return component;
}

// Returns the number of components. component: the result of components_of_faces().
inline Index component_count(const std::vector<Index>& component) {
  return component.empty() ? 0 : *std::max_element(component.begin(), component.end()) + 1;
}

// Counts vertices, edges and faces of every component, in the order of components_of_faces(). The
// faces must be an oriented manifold over vertices below `vertices`, with one fan at each vertex.
// from(h): the vertex that h leaves.
template <Index kCorners, class From>
std::vector<Topology> component_topologies(Index vertices, const std::vector<Index>& opposite,
                                           const From& from) {
  using Sides = HalfEdgesOf<kCorners>;
  const std::vector<Index> component = components_of_faces<kCorners>(opposite);
  std::vector<Topology> result(to_size(component_count(component)));
  std::vector<char> is_met(to_size(vertices), 0);
  for (Index h = 0; h < static_cast<Index>(opposite.size()); ++h) {
    Topology& counts = result[component[Sides::face(h)]];
    counts.components = 1;
    counts.faces += Sides::corner(h) == 0;
    counts.edges += opposite[h] < h;  // counts an edge once, at its larger side
    counts.vertices += !std::exchange(is_met[from(h)], 1);
  }
  for (const std::vector<Index>& loop : border_loops<kCorners>(opposite))
    ++result[component[Sides::face(loop.front())]].boundary_loops;
  return result;
}

// Returns the genus of a connected surface.
inline Index genus(const SurfaceMesh& mesh) {
  const Topology& t = mesh.topology();
  return (2 - t.boundary_loops - t.euler_characteristic()) / 2;
}

// Returns whether a connected surface is a disk with or without holes.
inline bool is_planar(const SurfaceMesh& mesh) {
  return mesh.topology().boundary_loops > 0 && genus(mesh) == 0;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
