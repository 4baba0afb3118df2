#include "majorant/mesh/internal/sheets.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "majorant/mesh/half_edge.h"
#include "majorant/mesh/internal/union_find.h"

namespace majorant {
namespace {

// For every list its rank among the lists of the same vertices, in any order.
std::vector<Index> ranks(std::vector<std::vector<Index>> lists) {
  std::vector<Index> order(lists.size());
  std::iota(order.begin(), order.end(), 0);
  for (auto& list : lists) std::sort(list.begin(), list.end());
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return lists[a] < lists[b]; });
  std::vector<Index> rank(lists.size(), 0);
  for (std::size_t k = 1; k < order.size(); ++k)
    if (lists[order[k]] == lists[order[k - 1]]) rank[order[k]] = rank[order[k - 1]] + 1;
  return rank;
}

class Gluing {
 public:
  Gluing(const Cells& triangles, const std::vector<Vector3>& positions, const StopCheck& stop)
      : triangles_(triangles),
        positions_(positions),
        stop_(stop),
        opposite_(to_size(3 * face_count()), -1),
        is_turned_(to_size(face_count()), 0),
        layer_(to_size(face_count()), 0) {}

  Sheets make(const std::vector<Index>& polygon, const std::vector<std::vector<Index>>& polygons,
              Orientation orientation) {
    find_layers(polygon, polygons);
    stop_.poll();
    glue();
    stop_.poll();
    if (orientation == Orientation::MadeConsistent)
      orient();
    else
      open_disagreeing();
    stop_.poll();
    number_corners();
    note_split_edges();
    return finished();
  }

 private:
  Index face_count() const { return static_cast<Index>(triangles_.rows()); }
  Index half_edge_count() const { return 3 * face_count(); }
  Index from(Index h) const { return from_vertex(triangles_, h); }
  Index to(Index h) const { return to_vertex(triangles_, h); }
  // As given, both sides of an edge run against each other.
  bool agrees(Index h) const { return from(h) != from(opposite_[h]); }
  void join(Index h, Index o) {
    opposite_[h] = o;
    opposite_[o] = h;
  }
  void open(Index h) {
    if (opposite_[h] >= 0) opposite_[opposite_[h]] = -1;
    opposite_[h] = -1;
  }
  double length(Index h) const { return (positions_[to(h)] - positions_[from(h)]).norm(); }

  // Faces of one layer are glued to each other: of duplicates, the second ones are the second
  // layer. Layer -1 is glued to nothing.
  void find_layers(const std::vector<Index>& polygon,
                   const std::vector<std::vector<Index>>& polygons) {
    std::vector<std::vector<Index>> corners;
    for (Index f = 0; f < face_count(); ++f)
      corners.push_back({triangles_(f, 0), triangles_(f, 1), triangles_(f, 2)});
    const std::vector<Index> of_triangle = ranks(std::move(corners)), of_polygon = ranks(polygons);
    for (Index f = 0; f < face_count(); ++f) {
      const auto t = triangles_.row(f);
      if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) {
        layer_[f] = -1;
        sheets_.repeated.push_back(f);
        continue;
      }
      layer_[f] = std::max(of_triangle[f], of_polygon[polygon[f]]);
      if (layer_[f] > 0) sheets_.duplicates.push_back(f);
    }
  }

  struct Side {
    Index low, high, layer, half_edge;
    bool same_edge(const Side& s) const {
      return low == s.low && high == s.high && layer == s.layer;
    }
  };

  // Pairs of sides; of more than two none. The sides of such an edge that hang together around both
  // its ends are the two ends of a fan there, so that they are two, run against each other and have
  // the same copies of the ends: SurfaceMesh glues them.
  void glue() {
    std::vector<Side> sides;
    sides.reserve(opposite_.size());
    for (Index h = 0; h < half_edge_count(); ++h)
      if (layer_[face_of(h)] >= 0)
        sides.push_back(
            {std::min(from(h), to(h)), std::max(from(h), to(h)), layer_[face_of(h)], h});
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
      return std::tie(a.low, a.high, a.layer, a.half_edge) <
             std::tie(b.low, b.high, b.layer, b.half_edge);
    });
    for (std::size_t first = 0, last = 0; first < sides.size(); first = last) {
      while (last < sides.size() && sides[last].same_edge(sides[first])) ++last;
      if (last - first == 2) join(sides[first].half_edge, sides[first + 1].half_edge);
      for (std::size_t s = first; last - first > 2 && s < last; ++s)
        crowded_.push_back(sides[s].half_edge);
    }
  }

  void open_disagreeing() {
    for (Index h = 0; h < half_edge_count(); ++h)
      if (opposite_[h] > h && !agrees(h)) {
        sheets_.cut_edges.push_back(h);
        open(h);
      }
  }

  bool disagrees(Index h) const {
    return agrees(h) == (is_turned_[face_of(h)] != is_turned_[face_of(opposite_[h])]);
  }

  // Every component as its first face is, breadth first: where fronts that disagree meet, a surface
  // with one side is cut.
  void orient() {
    std::vector<char> seen(to_size(face_count()), 0);
    std::vector<Index> component;
    for (Index start = 0; start < face_count(); ++start) {
      if (seen[start]) continue;
      component = {start};
      seen[start] = 1;
      std::vector<Index> cut;
      for (std::size_t k = 0; k < component.size(); ++k)
        for (Index h = 3 * component[k]; h < 3 * component[k] + 3; ++h) {
          const Index o = opposite_[h];
          if (o < 0) continue;
          if (!seen[face_of(o)]) {
            seen[face_of(o)] = 1;
            is_turned_[face_of(o)] =
                agrees(h) ? is_turned_[component[k]] : !is_turned_[component[k]];
            component.push_back(face_of(o));
          } else if (o > h && disagrees(h)) {
            cut.push_back(h);
          }
        }
      if (!cut.empty()) cut_open(component);
      if (!cut.empty()) ++sheets_.one_sided;
      turn_the_fewer(component);
    }
    for (Index f = 0; f < face_count(); ++f)
      if (is_turned_[f]) sheets_.turned.push_back(f);
  }

  double cut_length(const std::vector<Index>& component) const {
    double sum = 0;
    for (const Index f : component)
      for (Index h = 3 * f; h < 3 * f + 3; ++h)
        if (opposite_[h] > h && disagrees(h)) sum += length(h);
    return sum;
  }

  // The shorter cut of two: of the component as it was oriented, and of faces as they were given,
  // each shortened.
  void cut_open(const std::vector<Index>& component) {
    shorten_cut(component);
    const double length_oriented = cut_length(component);
    std::vector<char> oriented;
    for (const Index f : component) {
      oriented.push_back(is_turned_[f]);
      is_turned_[f] = 0;
    }
    shorten_cut(component);
    if (cut_length(component) > (1 + kShorter) * length_oriented)
      for (std::size_t k = 0; k < component.size(); ++k) is_turned_[component[k]] = oriented[k];
    for (const Index f : component)
      for (Index h = 3 * f; h < 3 * f + 3; ++h)
        if (opposite_[h] >= 0 && disagrees(h)) {
          sheets_.cut_edges.push_back(std::min(h, opposite_[h]));
          open(h);
        }
  }

  // Turning a face exchanges which of its edges are cut: done while that makes the cut shorter.
  void shorten_cut(const std::vector<Index>& component) {
    std::vector<Index> left(component.rbegin(), component.rend());
    while (!left.empty()) {
      stop_.poll_at(left.size());
      const Index f = left.back();
      left.pop_back();
      double cut = 0, uncut = 0;
      for (Index h = 3 * f; h < 3 * f + 3; ++h)
        if (opposite_[h] >= 0 && face_of(opposite_[h]) != f)
          (disagrees(h) ? cut : uncut) += length(h);
      if (!(cut > (1 + kShorter) * uncut)) continue;
      is_turned_[f] ^= 1;
      for (Index h = 3 * f; h < 3 * f + 3; ++h)
        if (opposite_[h] >= 0) left.push_back(face_of(opposite_[h]));
    }
  }

  void turn_the_fewer(const std::vector<Index>& component) {
    const auto turned = std::count_if(component.begin(), component.end(),
                                      [&](Index f) { return is_turned_[f] != 0; });
    const auto all = static_cast<std::ptrdiff_t>(component.size());
    if (2 * turned > all || (2 * turned == all && is_turned_[component.front()]))
      for (const Index f : component) is_turned_[f] ^= 1;
  }

  // copy_[h]: the fan of the corner that h leaves, named by one of its corners.
  void number_corners() {
    UnionFind fans(half_edge_count());
    for (Index h = 0; h < half_edge_count(); ++h) {
      const Index o = opposite_[h];
      if (o < h) continue;
      const bool against = agrees(h);
      fans.join(h, against ? next(o) : o);
      fans.join(next(h), against ? o : next(o));
    }
    copy_.resize(opposite_.size());
    for (Index h = 0; h < half_edge_count(); ++h) copy_[h] = fans.find(h);
  }

  // One side of each edge with more than two faces.
  void note_split_edges() {
    std::vector<std::array<Index, 3>> edges;
    for (const Index h : crowded_)
      edges.push_back({std::min(from(h), to(h)), std::max(from(h), to(h)), h});
    std::sort(edges.begin(), edges.end());
    for (std::size_t k = 0; k < edges.size(); ++k)
      if (k == 0 || edges[k][0] != edges[k - 1][0] || edges[k][1] != edges[k - 1][1])
        sheets_.split_edges.push_back(edges[k][2]);
  }

  Sheets finished() {
    Index given = 0;
    for (const Index v : triangles_.reshaped()) given = std::max(given, v + 1);
    std::vector<Index> first(to_size(given), -1), number(opposite_.size(), -1);
    for (Index h = 0; h < half_edge_count(); ++h)
      if (first[from(h)] < 0) first[from(h)] = copy_[h];
    for (Index v = 0; v < given; ++v) {
      if (first[v] < 0) continue;
      number[first[v]] = static_cast<Index>(sheets_.vertex.size());
      sheets_.vertex.push_back(v);
    }
    std::vector<char> is_explained(to_size(given), 0);
    for (const auto* edges : {&sheets_.split_edges, &sheets_.cut_edges})
      for (const Index h : *edges) is_explained[from(h)] = is_explained[to(h)] = 1;
    for (const auto* faces : {&sheets_.repeated, &sheets_.duplicates})
      for (const Index f : *faces)
        for (Index k = 0; k < 3; ++k) is_explained[triangles_(f, k)] = 1;
    for (Index h = 0; h < half_edge_count(); ++h) {
      if (number[copy_[h]] >= 0) continue;
      number[copy_[h]] = static_cast<Index>(sheets_.vertex.size());
      sheets_.vertex.push_back(from(h));
      if (!is_explained[from(h)]) sheets_.split_vertices.push_back(from(h));
    }
    auto& split = sheets_.split_vertices;
    std::sort(split.begin(), split.end());
    split.erase(std::unique(split.begin(), split.end()), split.end());
    sheets_.faces.resize(face_count(), 3);
    for (Index f = 0; f < face_count(); ++f)
      for (Index k = 0; k < 3; ++k)
        sheets_.faces(f, is_turned_[f] ? (3 - k) % 3 : k) = number[copy_[3 * f + k]];
    sheets_.is_turned = std::move(is_turned_);
    return std::move(sheets_);
  }

  // Part of a length: above rounding, or faces would be turned to and fro.
  static constexpr double kShorter = 1e-9;

  const Cells& triangles_;
  const std::vector<Vector3>& positions_;
  const StopCheck& stop_;
  std::vector<Index> opposite_;  // of the triangles as given, whichever way both run
  std::vector<char> is_turned_;
  std::vector<Index> layer_, crowded_, copy_;
  Sheets sheets_;
};

}  // namespace

Sheets make_sheets(const Cells& triangles, const std::vector<Index>& polygon,
                   const std::vector<std::vector<Index>>& polygons,
                   const std::vector<Vector3>& positions, Orientation orientation,
                   const StopCheck& stop) {
  return Gluing(triangles, positions, stop).make(polygon, polygons, orientation);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
