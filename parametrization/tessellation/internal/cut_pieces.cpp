#include "majorant/parametrization/tessellation/internal/cut_pieces.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <set>
#include <tuple>

#include "majorant/framework/error.h"
#include "majorant/mesh/box_tree.h"
#include "majorant/mesh/exact_predicates.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/mesh/union_find.h"

namespace majorant {
namespace {

using Edge = MapPieces::Edge;
using Piece = MapPieces::Piece;

// Upper bound on the halvings of a piece, the bits of a double less one. Two halvings halve the
// edges, so after 52 the area is 2^-52 of the cell's, the resolution of doubles of the cell's size.
constexpr int kDeepestCut = 52;
// Upper bound on the pieces of a cell beyond the initial ones: those of a lattice with 64 pieces an
// edge. A map that is not locally injective would need any number. Chosen, not tuned.
constexpr std::size_t kMaxPieces = 64 * 64;
constexpr std::size_t kMaxNamedCells = 8;  // cells in a message; then the search ends
// Lower bound on the area of a piece after a flip, relative to the two pieces. Chosen, not tuned.
constexpr double kMinFlippedArea = 1.0 / 64;
// At larger depths diagonals and edges are not chosen by the pieces that they repair, since only
// halving longest edges bounds shapes. Chosen, not tuned.
constexpr int kMaxChoiceDepth = 12;
// The ratio below which two edges are equally long, far above the rounding of a length: seen from
// another cell, an edge is evaluated in another order.
constexpr double kMinLongerRatio = 1 + 1e-9;

double area(const Vector3& a, const Vector3& b, const Vector3& c) {  // of a cell of area 1
  return (b[1] - a[1]) * (c[2] - a[2]) - (b[2] - a[2]) * (c[1] - a[1]);
}

// Returns height over longest edge, relative to that edge.
double shape(const Vector3& a, const Vector3& b, const Vector3& c) {
  const double longest =
      std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return longest > 0 ? (b - a).cross(c - a).norm() / longest : 0;
}

class Cutter {
 public:
  explicit Cutter(MapPieces& pieces)
      : pieces_(pieces), most_pieces_(pieces.pieces(0).size() + kMaxPieces) {
    for (Index c = pieces.cell_count() - 1; c >= 0; --c) open_.push_back(c);
  }

  void make_positive() {
    while (!open_.empty()) {
      const Index cell = open_.back();
      open_.pop_back();
      settle(cell);
    }
    if (!hopeless_.empty()) refuse();
  }

  // Returns whether the pieces turn once around every vertex; cuts the edges at others.
  bool turns_once() {
    const std::vector<Edge> spokes = spokes_of_wound_vertices(pieces_);
    cut_all(spokes);
    return spokes.empty();
  }

  // Returns false if boundary edges had to be cut.
  bool is_without_overlap() {
    const std::vector<BoundaryEdge> edges = boundary_edges(pieces_);
    std::vector<Edge> to_cut;
    for (const Index k : edges_to_cut(pieces_, edges)) to_cut.push_back(edges[k].edge);
    cut_all(to_cut);
    return to_cut.empty();
  }

 private:
  struct Choice {
    int not_positive;  // number of such pieces, increase
    int pieces;        // their number, increase
    double shape;      // of the worst one
    Edge edge;

    auto key() const { return std::tuple(not_positive, pieces, -shape); }
  };

  bool is_positive(Index c, const std::array<int, 3>& p) const {
    return orientation(pieces_.uv(c, p[0]), pieces_.uv(c, p[1]), pieces_.uv(c, p[2])) > 0;
  }

  void settle(Index cell) {
    while (!hopeless_.contains(cell)) {
      const std::vector<Piece>& all = pieces_.pieces(cell);
      const auto bad = std::find_if(all.begin(), all.end(), [&](const Piece& piece) {
        return !is_positive(cell, piece.corners);
      });
      if (bad == all.end()) return;
      const auto piece = static_cast<int>(bad - all.begin());
      if (flip_edge_of(cell, piece)) continue;
      if (!cut(edge_to_cut(cell, *bad))) give_up(cell);
    }
  }

  Edge edge_to_cut(Index cell, const Piece& piece) const {
    if (piece.depth <= kMaxChoiceDepth)
      if (const Choice choice = best_choice(cell, piece); choice.not_positive < 0)
        return choice.edge;
    return longest_edge_near(cell, piece);
  }

  void cut_all(const std::vector<Edge>& edges) {
    for (const Edge& edge : edges) cut(edge);
    if (!hopeless_.empty()) refuse();
  }

  static bool has_edge(const Piece& piece, int i, int j) {
    return std::ranges::count(piece.corners, i) > 0 && std::ranges::count(piece.corners, j) > 0;
  }

  // Returns false if a limit was reached; the cells are recorded.
  bool cut(const Edge& edge) {
    const std::vector<Edge> sides = pieces_.sides(edge);
    bool is_within_limits = true;
    int depth = -1;
    for (const auto& [c, i, j] : sides) {
      for (const Piece& piece : pieces_.pieces(c))
        if (has_edge(piece, i, j)) depth = std::max(depth, piece.depth);
      if (depth < kDeepestCut && pieces_.pieces(c).size() < most_pieces_) continue;
      give_up(c);
      is_within_limits = false;
    }
    if (depth < 0) return is_within_limits;  // already cut as an edge of another cell
    pieces_.split(edge);
    for (const Edge& side : sides) open_.push_back(side.cell);
    return is_within_limits;
  }

  void give_up(Index cell) {
    hopeless_.insert(cell);
    if (hopeless_.size() >= kMaxNamedCells) refuse();
  }

  [[noreturn]] void refuse() const {
    std::set<Index> cells;
    for (const Index c : hopeless_) cells.insert(pieces_.map_cell(c));
    throw Error(ErrorKind::Invalid,
                fmt::format("cell{} {}{}: no straight pieces are proven valid; the map is not "
                            "injective there, or too thin for double precision",
                            cells.size() > 1 ? "s" : "", fmt::join(cells, ", "),
                            cells.size() >= kMaxNamedCells ? " and others" : ""));
  }

  // Returns whether flipping an edge of two pieces of the cell made both positive.
  bool flip_edge_of(Index c, int first) {
    const std::vector<Piece>& all = pieces_.pieces(c);
    if (all[first].depth > kMaxChoiceDepth) return false;
    const std::array<int, 3> corners = all[first].corners;
    for (Index e = 0; e < 3; ++e) {
      const int i = corners[e], j = corners[next(e)], k = corners[previous(e)];
      for (std::size_t second = 0; second < all.size(); ++second) {
        const std::array<int, 3>& q = all[second].corners;
        const auto place = static_cast<Index>(std::ranges::find(q, j) - q.begin());
        if (place == 3 || q[next(place)] != i) continue;
        const int l = q[previous(place)];
        const std::array<std::array<int, 3>, 2> flipped = {{{i, l, k}, {l, j, k}}};
        if (all[second].depth > kMaxChoiceDepth || !may_be_pieces(c, flipped)) continue;
        pieces_.flip(c, {first, static_cast<int>(second)}, flipped);
        return true;
      }
    }
    return false;
  }

  bool may_be_pieces(Index c, const std::array<std::array<int, 3>, 2>& two) const {
    const auto area_of = [&](const std::array<int, 3>& p) {
      const auto& points = pieces_.points(c);
      return area(points[p[0]].xi, points[p[1]].xi, points[p[2]].xi);
    };
    const double a = area_of(two[0]), b = area_of(two[1]);
    return std::min(a, b) > kMinFlippedArea * (a + b) && is_positive(c, two[0]) &&
           is_positive(c, two[1]);
  }

  Choice best_choice(Index c, const Piece& piece) const {
    const std::array<int, 3>& p = piece.corners;
    const std::array<Choice, 3> choices = {consider({c, p[0], p[1]}), consider({c, p[1], p[2]}),
                                           consider({c, p[2], p[0]})};
    return *std::ranges::min_element(choices, {}, &Choice::key);
  }

  Choice consider(const Edge& edge) const {
    Choice choice{0, 0, std::numeric_limits<double>::infinity(), edge};
    const std::vector<Edge> sides = pieces_.sides(edge);
    const std::vector<Vector2> middles = pieces_.middles(sides);
    const Vector3 middle =
        (pieces_.position(edge.cell, edge.i) + pieces_.position(edge.cell, edge.j)) / 2;
    for (std::size_t s = 0; s < sides.size(); ++s) {
      const auto [c, i, j] = sides[s];
      for (const Piece& piece : pieces_.pieces(c)) {
        const std::array<int, 3>& p = piece.corners;
        const auto from = std::ranges::find(p, i), to = std::ranges::find(p, j);
        if (from == p.end() || to == p.end()) continue;
        ++choice.pieces;
        choice.not_positive -= !is_positive(c, p);
        for (const auto moved : {from - p.begin(), to - p.begin()}) {
          std::array<Vector2, 3> uv;
          std::array<Vector3, 3> xyz;
          for (std::size_t k = 0; k < 3; ++k) {
            const bool is_moved = k == static_cast<std::size_t>(moved);
            uv[k] = is_moved ? middles[s] : pieces_.uv(c, p[k]);
            xyz[k] = is_moved ? middle : pieces_.position(c, p[k]);
          }
          choice.not_positive += orientation(uv[0], uv[1], uv[2]) <= 0;
          choice.shape = std::min(choice.shape, shape(xyz[0], xyz[1], xyz[2]));
        }
      }
    }
    return choice;
  }

  // Returns the length of the curve through its midpoint; along a cut, the longest of its images.
  double length(const Edge& edge) const {
    const std::vector<Edge> sides = pieces_.sides(edge);
    const std::vector<Vector2> middles = pieces_.middles(sides);
    double result = 0;
    for (std::size_t s = 0; s < sides.size(); ++s) {
      const auto [c, i, j] = sides[s];
      result = std::max(
          result, (middles[s] - pieces_.uv(c, i)).norm() + (middles[s] - pieces_.uv(c, j)).norm());
    }
    return result;
  }

  struct LongEdge {
    double length;
    Edge edge;
  };

  LongEdge longest_edge(Index c, const std::array<int, 3>& p) const {
    LongEdge result{-1, {c, p[0], p[1]}};
    for (Index k = 0; k < 3; ++k) {
      const Edge edge{c, p[k], p[next(k)]};
      if (const double l = length(edge); l > result.length) result = {l, edge};
    }
    return result;
  }

  // Returns the longest edge of a piece, or of neighbours across it whose longest edge is longer
  // still.
  Edge longest_edge_near(Index cell, const Piece& piece) const {
    LongEdge longest = longest_edge(cell, piece.corners);
    for (bool is_final = false; !is_final;) {
      is_final = true;
      for (const auto& [c, i, j] : pieces_.sides(longest.edge))
        for (const Piece& other : pieces_.pieces(c)) {
          if (!is_final || !has_edge(other, i, j)) continue;
          const LongEdge candidate = longest_edge(c, other.corners);
          if (candidate.length <= kMinLongerRatio * longest.length) continue;
          longest = candidate;
          is_final = false;
        }
    }
    return longest.edge;
  }

  MapPieces& pieces_;
  std::size_t most_pieces_;
  std::vector<Index> open_;   // cells that may have pieces that are not positive
  std::set<Index> hopeless_;  // cells
};

using Edge = MapPieces::Edge;

bool is_on_plane_boundary(const MapPieces& pieces, const Edge& edge) {
  const int k = pieces.cell_edge(edge);
  return k >= 0 && pieces.plane_sides(edge.cell, k) != 2;
}

// Calls visit(edge, from, to) for every edge of every piece, with its texture coordinates.
template <class Visit>
void visit_edges(const MapPieces& pieces, const Visit& visit) {
  for (Index c = 0; c < pieces.cell_count(); ++c)
    for (const MapPieces::Piece& piece : pieces.pieces(c))
      for (Index k = 0; k < 3; ++k) {
        const Edge edge{c, piece.corners[k], piece.corners[next(k)]};
        visit(edge, pieces.points(c)[edge.i].vt, pieces.points(c)[edge.j].vt);
      }
}

// Returns whether the direction from p to q is in [0, pi).
bool is_above(const Vector2& p, const Vector2& q) {
  return q.y() > p.y() || (q.y() == p.y() && q.x() > p.x());
}

// Returns the component of the image to which every cell belongs.
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
      // The fraction is chosen, not tuned; in any case the result is proven.
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

  // Finds components inside one another. Their boundaries do not meet, so each component lies
  // inside another or outside it.
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

void cut_until_positive(MapPieces& pieces, Overlap overlap) {
  Cutter cutter(pieces);
  do {
    cutter.make_positive();
  } while (!cutter.turns_once() || (overlap == Overlap::Excluded && !cutter.is_without_overlap()));
}

std::vector<Edge> spokes_of_wound_vertices(const MapPieces& pieces) {
  // A positive piece contains the direction (1, 0) at a corner where it leads from below to above.
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
    turns[from] = turns[to] = 1;  // boundary vertices need no full turn
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
