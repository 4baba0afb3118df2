#include "majorant/parametrization/tessellation/internal/piece_boundary.h"

#include <algorithm>
#include <set>

#include "majorant/certify/box_pairs.h"
#include "majorant/mesh/exact_predicates.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/mesh/union_find.h"

namespace majorant {
namespace {

using Edge = MapPieces::Edge;

bool is_on_plane_boundary(const MapPieces& pieces, const Edge& edge) {
  const int k = pieces.cell_edge(edge);
  return k >= 0 && pieces.plane_sides(edge.cell, k) != 2;
}

// visit(edge, from, to): every edge of every piece, with its texture coordinates.
template <class Visit>
void visit_edges(const MapPieces& pieces, const Visit& visit) {
  for (Index c = 0; c < pieces.cell_count(); ++c)
    for (const MapPieces::Piece& piece : pieces.pieces(c))
      for (Index k = 0; k < 3; ++k) {
        const Edge edge{c, piece.corners[k], piece.corners[next(k)]};
        visit(edge, pieces.points(c)[edge.i].vt, pieces.points(c)[edge.j].vt);
      }
}

// Whether the direction from p to q is in [0, pi).
bool is_above(const Vector2& p, const Vector2& q) {
  return q.y() > p.y() || (q.y() == p.y() && q.x() > p.x());
}

// The components of the image: a number for every cell.
std::vector<Index> components(const MapPieces& pieces) {
  UnionFind sets(pieces.cell_count());
  std::vector<Index> first_cell;  // by plane edge
  for (Index c = 0; c < pieces.cell_count(); ++c)
    for (int k = 0; k < 3; ++k) {
      const std::size_t edge = to_size(pieces.plane_edge(c, k));
      if (first_cell.size() <= edge) first_cell.resize(edge + 1, -1);
      if (first_cell[edge] < 0) first_cell[edge] = c;
      sets.join(c, first_cell[edge]);
    }
  std::vector<Index> result;
  for (Index c = 0; c < pieces.cell_count(); ++c) result.push_back(sets.find(c));
  return result;
}

class OverlapSearch {
 public:
  OverlapSearch(const MapPieces& pieces, const std::vector<BoundaryEdge>& edges)
      : pieces_(pieces), edges_(edges) {
    for (const BoundaryEdge& e : edges) {
      boxes_.push_back({from(e).cwiseMin(to(e)), from(e).cwiseMax(to(e))});
      const Vector2 middle = pieces.middles(pieces.sides(e.edge)).front();
      bend_.push_back((middle - (from(e) + to(e)) / 2).norm());
    }
  }

  std::vector<Index> run() {
    BoxTree(boxes_).visit_pairs([&](Index i, Index j) {
      if (!meet(edges_[i], edges_[j])) return true;
      // Origin: chosen, not tuned; whatever is cut, the result is proven.
      constexpr double kPart = 0.25;
      const double least = kPart * std::max(bend_[i], bend_[j]);
      for (const Index k : {i, j})
        if (bend_[k] >= least) found_.insert(k);
      return true;
    });
    if (found_.empty()) find_nested();
    return {found_.begin(), found_.end()};
  }

 private:
  const Vector2& from(const BoundaryEdge& e) const { return pieces_.texcoords()[e.from]; }
  const Vector2& to(const BoundaryEdge& e) const { return pieces_.texcoords()[e.to]; }

  bool meet(const BoundaryEdge& e, const BoundaryEdge& f) const {
    if (e.to == f.from || f.to == e.from) {
      const bool is_first = e.to == f.from;
      const BoundaryEdge &first = is_first ? e : f, &second = is_first ? f : e;
      return segments_fold(from(first), to(first), to(second));
    }
    return segments_meet(from(e), to(e), from(f), to(f));
  }

  // Boundaries that do not meet: each component lies within another, or outside of it.
  void find_nested() {
    const std::vector<Index> component_of = components(pieces_);
    std::vector<std::vector<Index>> edges_of(to_size(pieces_.cell_count()));
    std::vector<Box2> boxes;
    std::vector<Index> roots;
    for (std::size_t k = 0; k < edges_.size(); ++k)
      edges_of[component_of[edges_[k].edge.cell]].push_back(static_cast<Index>(k));
    for (std::size_t c = 0; c < edges_of.size(); ++c) {
      if (edges_of[c].empty()) continue;
      roots.push_back(static_cast<Index>(c));
      boxes.push_back(boxes_[edges_of[c].front()]);
      for (const Index k : edges_of[c]) {
        boxes.back().low = boxes.back().low.cwiseMin(boxes_[k].low);
        boxes.back().high = boxes.back().high.cwiseMax(boxes_[k].high);
      }
    }
    BoxTree(boxes).visit_pairs([&](Index a, Index b) {
      for (const auto& [inner, outer] : {std::pair(a, b), std::pair(b, a)}) {
        const std::vector<Index>& around = edges_of[roots[outer]];
        const Vector2& p = from(edges_[edges_of[roots[inner]].front()]);
        if (winding(around, p) != 0) mark_bent(around);
      }
      return true;
    });
  }

  long winding(const std::vector<Index>& loop, const Vector2& p) const {
    long turns = 0;
    for (const Index k : loop) {
      const Vector2 &a = from(edges_[k]), &b = to(edges_[k]);
      if (a.y() <= p.y() && p.y() < b.y()) turns += orientation(a, b, p) > 0;
      if (b.y() <= p.y() && p.y() < a.y()) turns -= orientation(a, b, p) < 0;
    }
    return turns;
  }

  void mark_bent(const std::vector<Index>& edges) {
    const bool is_straight = std::ranges::all_of(edges, [&](Index k) { return bend_[k] == 0; });
    for (const Index k : edges)
      if (is_straight || bend_[k] > 0) found_.insert(k);
  }

  const MapPieces& pieces_;
  const std::vector<BoundaryEdge>& edges_;
  std::vector<Box2> boxes_;
  std::vector<double> bend_;  // distance of the curve's middle from the chord's
  std::set<Index> found_;
};

}  // namespace

std::vector<Edge> spokes_of_wound_vertices(const MapPieces& pieces) {
  // A positive piece contains the direction (1, 0) when it leads from below to above.
  std::vector<int> turns(pieces.texcoords().size(), 0);
  for (Index c = 0; c < pieces.cell_count(); ++c)
    for (const MapPieces::Piece& piece : pieces.pieces(c))
      for (Index k = 0; k < 3; ++k) {
        const int corner = piece.corners[k];
        const Vector2& p = pieces.uv(c, corner);
        const Vector2& a = pieces.uv(c, piece.corners[next(k)]);
        const Vector2& b = pieces.uv(c, piece.corners[previous(k)]);
        if (is_above(p, b) && !is_above(p, a)) ++turns[pieces.points(c)[corner].vt];
      }
  visit_edges(pieces, [&](const Edge& edge, Index from, Index to) {
    if (!is_on_plane_boundary(pieces, edge)) return;
    turns[from] = turns[to] = 1;  // there is no whole turn there
  });
  std::vector<Edge> spokes;
  visit_edges(pieces, [&](const Edge& edge, Index from, Index) {
    if (turns[from] != 1) spokes.push_back(edge);
  });
  return spokes;
}

std::vector<BoundaryEdge> boundary_edges(const MapPieces& pieces) {
  std::vector<BoundaryEdge> result;
  visit_edges(pieces, [&](const Edge& edge, Index from, Index to) {
    if (is_on_plane_boundary(pieces, edge)) result.push_back({edge, from, to});
  });
  return result;
}

std::vector<Index> edges_to_cut(const MapPieces& pieces, const std::vector<BoundaryEdge>& edges) {
  return OverlapSearch(pieces, edges).run();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
