#include "majorant/mesh/repair.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include "majorant/framework/argument_check.h"
#include "majorant/framework/error.h"
#include "majorant/framework/stop_check.h"
#include "majorant/framework/types.h"
#include "majorant/mesh/internal/place_text.h"
#include "majorant/mesh/mesh_messages.h"
#include "majorant/mesh/mesh_validation.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/mesh/texture_borders.h"
#include "majorant/mesh/triangle_list.h"
#include "majorant/mesh/triangulate_polygon.h"
#include "majorant/mesh/union_find.h"
#include "majorant/mesh/weld.h"

namespace majorant {
namespace {

// Triangles in any state -> sheets: surfaces that are edge- and vertex-manifold and oriented. What
// cannot be glued is left open; see repair.h for the rules.

struct Sheets {
  Cells faces;                  // #F by 3 vertices of the sheets; turned ones have corners 0, 2, 1
  std::vector<Index> vertex;    // the given vertex of each: those in use, ascending, then copies
  std::vector<char> is_turned;  // #F
  // Half-edges and faces of the triangles as they were given; one half-edge for an edge.
  std::vector<Index> repeated, duplicates, turned;  // faces
  std::vector<Index> split_edges, cut_edges;        // half-edges
  Index one_sided = 0;                              // components that were cut for that
  // Given vertices, ascending, where sheets merely touch: not those that have copies because of an
  // edge or a face above.
  std::vector<Index> split_vertices;
  Index pieces_given = 0;  // that hang together across edges between the same vertices
};

// Sorts each list, and returns their order then; equal ones stay in theirs.
std::vector<Index> sorted_order(IndexLists& lists) {
  for (const auto list : lists) std::sort(list.begin(), list.end());
  std::vector<Index> order(lists.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) {
    return std::ranges::lexicographical_compare(lists[a], lists[b]);
  });
  return order;
}

// For every list a number, equal for lists of the same vertices, in any order.
std::vector<Index> classes(IndexLists lists) {
  const std::vector<Index> order = sorted_order(lists);
  std::vector<Index> number(lists.size(), 0);
  for (std::size_t k = 1; k < order.size(); ++k)
    number[order[k]] =
        number[order[k - 1]] + !std::ranges::equal(lists[order[k]], lists[order[k - 1]]);
  return number;
}

// For every list its rank among the lists of the same vertices, in any order.
std::vector<Index> ranks(IndexLists lists) {
  const std::vector<Index> order = sorted_order(lists);
  std::vector<Index> rank(lists.size(), 0);
  for (std::size_t k = 1; k < order.size(); ++k)
    if (std::ranges::equal(lists[order[k]], lists[order[k - 1]]))
      rank[order[k]] = rank[order[k - 1]] + 1;
  return rank;
}

class Gluing {
 public:
  // place: by vertex, the first vertex where it is; edges between equal places are joined.
  Gluing(const Cells& triangles, const std::vector<Vector3>& positions,
         const std::vector<Index>& place, const StopCheck& stop)
      : triangles_(triangles),
        positions_(positions),
        place_(place),
        stop_(stop),
        opposite_(to_size(3 * face_count()), -1),
        is_turned_(to_size(face_count()), 0),
        layer_(to_size(face_count()), 0) {}

  Sheets make(const std::vector<Index>& polygon, const IndexLists& polygons,
              Orientation orientation, CrowdedEdges crowded_edges) {
    find_layers(polygon, polygons);
    stop_.poll();
    glue();
    sheets_.pieces_given = piece_count();
    join_places(polygon, polygons);
    if (crowded_edges == CrowdedEdges::Paired) pair_crowded();
    stop_.poll();
    if (orientation == Orientation::MadeConsistent)
      orient();
    else
      open_disagreeing();
    stop_.poll();
    number_corners();
    while (open_crowded()) number_corners();
    note_split_edges();
    return finished();
  }

 private:
  Index face_count() const { return static_cast<Index>(triangles_.rows()); }
  Index half_edge_count() const { return 3 * face_count(); }
  Index from(Index h) const { return from_vertex(triangles_, h); }
  Index to(Index h) const { return to_vertex(triangles_, h); }
  Index place(Index v) const { return place_.empty() ? v : place_[v]; }
  // As given, both sides of an edge run against each other.
  bool agrees(Index h) const {
    const Index o = opposite_[h];
    return from(h) == to(o) || (from(h) != from(o) && place(from(h)) == place(to(o)));
  }
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
  void find_layers(const std::vector<Index>& polygon, const IndexLists& polygons) {
    IndexLists corners;
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
    static bool before(const Side& s, const Side& t) {
      return std::tie(s.low, s.high, s.layer, s.half_edge) <
             std::tie(t.low, t.high, t.layer, t.half_edge);
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
    std::sort(sides.begin(), sides.end(), Side::before);
    for (std::size_t first = 0, last = 0; first < sides.size(); first = last) {
      while (last < sides.size() && sides[last].same_edge(sides[first])) ++last;
      if (last - first == 2) join(sides[first].half_edge, sides[first + 1].half_edge);
      if (last - first > 2) crowded_begin_.push_back(crowded_.size());
      for (std::size_t s = first; last - first > 2 && s < last; ++s)
        crowded_.push_back(sides[s].half_edge);
    }
  }

  Index piece_count() const {
    UnionFind pieces(face_count());
    for (Index h = 0; h < half_edge_count(); ++h)
      if (opposite_[h] > h) pieces.join(face_of(h), face_of(opposite_[h]));
    Index count = 0;
    for (Index f = 0; f < face_count(); ++f) count += pieces.find(f) == f;
    return count;
  }

  // The sides of edges of more than two faces, where solids meet: RepairOptions::crowded_edges.
  void pair_crowded() {
    UnionFind pieces(face_count());
    for (Index h = 0; h < half_edge_count(); ++h)
      if (opposite_[h] > h) pieces.join(face_of(h), face_of(opposite_[h]));
    std::vector<char> is_crowded(opposite_.size(), 0), has_border(to_size(face_count()), 0);
    for (const Index h : crowded_) is_crowded[h] = 1;
    for (Index h = 0; h < half_edge_count(); ++h)
      if (opposite_[h] < 0 && !is_crowded[h]) has_border[pieces.find(face_of(h))] = 1;
    for (std::size_t k = 0; k < crowded_begin_.size(); ++k) {
      stop_.poll_at(k);
      const auto begin = static_cast<std::ptrdiff_t>(crowded_begin_[k]);
      const auto end = static_cast<std::ptrdiff_t>(
          k + 1 < crowded_begin_.size() ? crowded_begin_[k + 1] : crowded_.size());
      std::vector<Index> sides(crowded_.begin() + begin, crowded_.begin() + end);
      if (std::any_of(sides.begin(), sides.end(),
                      [&](Index h) { return has_border[pieces.find(face_of(h))] != 0; }))
        continue;
      std::stable_sort(sides.begin(), sides.end(), [&](Index a, Index b) {
        return pieces.find(face_of(a)) < pieces.find(face_of(b));
      });
      std::vector<Index> others;
      for (std::size_t first = 0, last = 0; first < sides.size(); first = last) {
        const Index piece = pieces.find(face_of(sides[first]));
        while (last < sides.size() && pieces.find(face_of(sides[last])) == piece) ++last;
        if (last - first == 2 && from(sides[first]) == to(sides[first + 1]))
          join_pair(sides[first], sides[first + 1]);
        else
          for (std::size_t s = first; s < last; ++s) others.push_back(sides[s]);
      }
      pair_wedges(others);
    }
  }

  void join_pair(Index h, Index o) {
    join(h, o);
    joined_.push_back(h);
  }

  // Joins the sides of one edge that bound the same wedges of the inside, which is behind the
  // faces: seen along the edge, the inside begins at a side that runs against it, counterclockwise,
  // and ends at one that runs along it. Nothing where there are not as many of both, or where two
  // faces lie on each other.
  void pair_wedges(const std::vector<Index>& sides) {
    if (sides.empty()) return;
    const Index low = std::min(from(sides[0]), to(sides[0]));
    const Index high = std::max(from(sides[0]), to(sides[0]));
    const Vector3 axis = (positions_[high] - positions_[low]).stableNormalized();
    const Vector3 x = axis.unitOrthogonal(), y = axis.cross(x);
    struct Around {
      double angle;
      Index half_edge;
      bool runs_along;
    };
    std::vector<Around> around;
    std::ptrdiff_t surplus = 0;
    for (const Index h : sides) {
      const Vector3 into = positions_[from(previous(h))] - positions_[low];
      const bool runs_along = from(h) == low;
      around.push_back({std::atan2(into.dot(y), into.dot(x)), h, runs_along});
      surplus += runs_along ? 1 : -1;
    }
    std::sort(around.begin(), around.end(), [](const Around& a, const Around& b) {
      return std::tie(a.angle, a.half_edge) < std::tie(b.angle, b.half_edge);
    });
    bool is_clear = surplus == 0;
    for (std::size_t k = 0; k < around.size(); ++k) {
      const double step = std::remainder(around[(k + 1) % around.size()].angle - around[k].angle,
                                         2 * std::numbers::pi);
      is_clear &= std::abs(step) > kSameDirection;
    }
    if (!is_clear) return;
    // Twice around, as brackets: those that begin before the first turn's start end after it.
    std::vector<Index> begun;
    for (std::size_t k = 0; k < 2 * around.size(); ++k) {
      const auto& [angle, h, runs_along] = around[k % around.size()];
      if (opposite_[h] >= 0) continue;
      if (!runs_along) {
        if (k < around.size()) begun.push_back(h);
      } else if (!begun.empty()) {
        join_pair(begun.back(), h);
        begun.pop_back();
      }
    }
  }

  // Triangles, and the polygons that they are of, by where their corners are: equal numbers for
  // those at the same places.
  std::array<std::vector<Index>, 2> numbers_of_places(const std::vector<Index>& polygon,
                                                      const IndexLists& polygons) const {
    IndexLists corners, of_polygons = polygons;
    for (Index f = 0; f < face_count(); ++f)
      corners.push_back(
          {place(triangles_(f, 0)), place(triangles_(f, 1)), place(triangles_(f, 2))});
    for (Index& v : of_polygons.indices()) v = place(v);
    std::array<std::vector<Index>, 2> numbers{classes(std::move(corners)), {}};
    const std::vector<Index> polygon_class = classes(std::move(of_polygons));
    for (const Index p : polygon) numbers[1].push_back(polygon_class[p]);
    return numbers;
  }

  // Joins open sides between the same places, each with the only one that may be its other side.
  void join_places(const std::vector<Index>& polygon, const IndexLists& polygons) {
    if (place_.empty()) return;
    const auto [triangle_class, polygon_class] = numbers_of_places(polygon, polygons);
    std::vector<char> is_crowded(opposite_.size(), 0);
    for (const Index h : crowded_) is_crowded[h] = 1;
    std::vector<Side> sides;
    for (Index h = 0; h < half_edge_count(); ++h) {
      const Index a = place(from(h)), b = place(to(h));
      if (layer_[face_of(h)] >= 0 && opposite_[h] < 0 && !is_crowded[h] && a != b)
        sides.push_back({std::min(a, b), std::max(a, b), layer_[face_of(h)], h});
    }
    std::sort(sides.begin(), sides.end(), Side::before);
    const auto may_meet = [&, &triangle = triangle_class, &whole = polygon_class](Index h,
                                                                                  Index o) {
      const Index f = face_of(h), g = face_of(o);
      return f != g && place(from(h)) == place(to(o)) && triangle[f] != triangle[g] &&
             (whole[f] != whole[g] || polygon[f] == polygon[g]);
    };
    for (std::size_t first = 0, last = 0; first < sides.size(); first = last) {
      while (last < sides.size() && sides[last].same_edge(sides[first])) ++last;
      const auto only_other = [&](Index h) {
        Index found = -1;
        for (std::size_t s = first; s < last; ++s) {
          if (!may_meet(h, sides[s].half_edge)) continue;
          if (found >= 0) return Index{-1};
          found = sides[s].half_edge;
        }
        return found;
      };
      for (std::size_t s = first; s < last && last - first > 1; ++s) {
        stop_.poll_at(s);
        const Index h = sides[s].half_edge;
        if (opposite_[h] >= 0) continue;
        if (const Index o = only_other(h); o >= 0 && only_other(o) == h) {
          join(h, o);
          joined_.push_back(h);
        }
      }
    }
  }

  // Opens joined edges at the ends of edges that more than two sides would have, by the copies of
  // their ends. Returns whether there were any.
  bool open_crowded() {
    if (joined_.empty()) return false;
    std::vector<std::array<Index, 2>> ends;
    for (Index h = 0; h < half_edge_count(); ++h)
      if (layer_[face_of(h)] >= 0)
        ends.push_back({std::min(copy_[h], copy_[next(h)]), std::max(copy_[h], copy_[next(h)])});
    std::sort(ends.begin(), ends.end());
    std::vector<char> is_crowded(opposite_.size(), 0);  // by copy
    for (std::size_t k = 2; k < ends.size(); ++k)
      if (ends[k] == ends[k - 2]) is_crowded[ends[k][0]] = is_crowded[ends[k][1]] = 1;
    return std::erase_if(joined_, [&](Index h) {
             if (!is_crowded[copy_[h]] && !is_crowded[copy_[next(h)]]) return false;
             open(h);
             return true;
           }) > 0;
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
      if (first[v] < 0 || number[first[v]] >= 0) continue;
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

  // Radians, around an edge: faces that are closer lie on each other.
  static constexpr double kSameDirection = 1e-9;
  // Part of a length: above rounding, or faces would be turned to and fro.
  static constexpr double kShorter = 1e-9;

  const Cells& triangles_;
  const std::vector<Vector3>& positions_;
  const std::vector<Index>& place_;
  const StopCheck& stop_;
  std::vector<Index> opposite_;  // of the triangles as given, whichever way both run
  std::vector<char> is_turned_;
  std::vector<Index> layer_, crowded_, copy_;
  std::vector<std::size_t> crowded_begin_;  // in crowded_, of every edge
  std::vector<Index> joined_;               // one side of each edge that was joined later
  Sheets sheets_;
};

// triangles: #F by 3 vertices of `positions`; polygon: of the file, by triangle.
Sheets make_sheets(const Cells& triangles, const std::vector<Index>& polygon,
                   const IndexLists& polygons, const std::vector<Vector3>& positions,
                   const std::vector<Index>& place, const RepairOptions& options,
                   const StopCheck& stop) {
  return Gluing(triangles, positions, place, stop)
      .make(polygon, polygons, options.orientation, options.crowded_edges);
}

using Places = std::vector<std::array<Index, 2>>;

// Rest triangles of faces without area and of needles: repair.h says which, and why.
class Regularizing {
 public:
  Regularizing(const Points3& positions, const Cells& faces)
      : positions_(positions),
        faces_(faces),
        sum_(to_size(vertices())),
        count_(to_size(vertices())) {
    double total = 0;
    Index edges = 0;
    for (Index f = 0; f < faces.rows(); ++f)
      for (Index k = 0; k < 3; ++k) {
        const double l = length(f, k);
        if (!(l > 0)) continue;
        for (const Index v : {faces(f, k), faces(f, next(k))}) {
          sum_[v] += l;
          ++count_[v];
        }
        total += l;
        ++edges;
      }
    mean_ = edges > 0 ? total / edges : 1;
  }

  std::vector<RestTriangle> triangles(double least_height) const {
    std::vector<RestTriangle> out;
    for (Index f = 0; f < faces_.rows(); ++f) {
      Index longest = 0;
      for (Index k = 1; k < 3; ++k)
        if (length(f, k) > length(f, longest)) longest = k;
      const double size = length(f, longest);
      if (!(size > 0))
        out.push_back({f, point(f)});
      else if (!(height(f) > least_height))
        out.push_back({f, needle(f, longest, size)});
    }
    return out;
  }

 private:
  Index vertices() const { return static_cast<Index>(positions_.rows()); }
  Vector3 edge(Index f, Index k) const {
    return positions_.row(faces_(f, next(k))) - positions_.row(faces_(f, k));
  }
  double length(Index f, Index k) const { return edge(f, k).stableNorm(); }

  // Over the longest edge, in parts of it.
  double height(Index f) const {
    const double longest = std::max({length(f, 0), length(f, 1), length(f, 2)});
    return (edge(f, 0) / longest).cross(edge(f, 1) / longest).norm();
  }

  // The foot of its height stays where it is.
  std::array<Vector2, 3> needle(Index f, Index longest, double size) const {
    const Vector3 along = edge(f, longest) / size, up = -edge(f, previous(longest));
    std::array<Vector2, 3> corners;
    corners[longest] = {0, 0};
    corners[next(longest)] = {size, 0};
    corners[previous(longest)] = {std::clamp(along.dot(up), 0.0, size), kNeedleHeight * size};
    return corners;
  }

  std::array<Vector2, 3> point(Index f) const {
    double sum = 0;
    Index count = 0;
    for (Index k = 0; k < 3; ++k) {
      sum += sum_[faces_(f, k)];
      count += count_[faces_(f, k)];
    }
    const double side = kNeedleHeight * (count > 0 ? sum / count : mean_);
    return {Vector2(0, 0), Vector2(side, 0), Vector2(side / 2, std::sqrt(0.75) * side)};
  }

  const Points3& positions_;
  const Cells& faces_;
  std::vector<double> sum_;   // by vertex: lengths of edges there that have one,
  std::vector<Index> count_;  // how many
  double mean_;
};

const FindingText& text_of(RepairKind kind) {
  static constexpr std::array<FindingText, 11> kTexts = {{
      {"welded", "vertex welded to another", "vertices welded to others", "vertex"},
      {"repeated_vertex", "face with a repeated vertex split off",
       "faces with a repeated vertex split off", "face"},
      {"duplicate_face", "duplicate or folded face split off",
       "duplicate or folded faces split off", "face"},
      {"split_edge", "edge of more than two faces split", "edges of more than two faces split",
       "edge"},
      {"split_vertex", "vertex split, a copy for every sheet",
       "vertices split, a copy for every sheet", "vertex"},
      {"turned_face", "face turned to agree with its neighbours",
       "faces turned to agree with their neighbours", "face"},
      {"cut_edge", "edge cut, where faces cannot agree on a side",
       "edges cut, where faces cannot agree on a side", "edge"},
      {"crossing_polygon", "polygon that crosses itself taken as triangles",
       "polygons that cross themselves taken as triangles", "face"},
      {"regularized_face", "face with no or nearly no area measured against a needle",
       "faces with no or nearly no area measured against needles", "face"},
      {"moved_to_origin", "mesh moved to the origin for the run",
       "meshes moved to the origin for the run", ""},
      {"collapsed_edge", "edge of no length collapsed", "edges of no length collapsed", "edge"},
  }};
  return kTexts[static_cast<std::size_t>(kind)];
}

// A point from which all differences are exact, where every coordinate is far from 0 for their
// range: half way between the smallest and the largest, of which none is more than twice another.
Vector3 origin_of(const PolygonMesh& input, const std::vector<Index>& used) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Vector3 low = Vector3::Constant(kInfinity), high = -low, origin = Vector3::Zero();
  for (const Index v : used) {
    low = low.cwiseMin(input.positions[v]);
    high = high.cwiseMax(input.positions[v]);
  }
  const double extent = (high - low).maxCoeff();
  const double largest = std::max(low.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff());
  if (!(largest > kFarAway * extent)) return origin;
  for (int k = 0; k < 3; ++k) {
    const double a = std::min(std::abs(low[k]), std::abs(high[k]));
    const double b = std::max(std::abs(low[k]), std::abs(high[k]));
    if (std::signbit(low[k]) == std::signbit(high[k]) && b <= 2 * a)
      origin[k] = low[k] + (high[k] - low[k]) / 2;
  }
  return origin;
}

// Part of the area of a polygon's triangles that may face aside or away: coordinates of
// five digits; polygons that are bent more do not cross themselves in space.
constexpr double kAside = 1e-4;

// Returns whether triangles over these corners are in one plane, and some face its other side.
bool disagree(const std::vector<Vector3>& corners,
              const std::vector<std::array<int, 3>>& triangles) {
  std::vector<Vector3> areas;
  Vector3 normal = Vector3::Zero();  // of the largest
  double sum = 0;
  for (const auto& t : triangles) {
    const Vector3& first = corners[t[0]];
    areas.push_back((corners[t[1]] - first).cross(corners[t[2]] - first));
    if (areas.back().norm() > normal.norm()) normal = areas.back();
    sum += areas.back().norm();
  }
  if (sum == 0) return false;
  normal.normalize();
  bool is_plane = true, is_any_away = false;
  for (const Vector3& area : areas) {
    is_plane = is_plane && area.cross(normal).norm() <= kAside * sum;
    is_any_away = is_any_away || area.dot(normal) < -kAside * sum;
  }
  return is_plane && is_any_away;
}

// triangles: of the polygon with these corners; texture coordinates may have chosen them.
bool is_crossing(const std::vector<Vector3>& corners,
                 const std::vector<std::array<int, 3>>& triangles) {
  if (!disagree(corners, triangles)) return false;
  try {
    return disagree(corners, triangulate_polygon(corners));
  } catch (const Error&) {
    return true;
  }
}

// The weld distance that is proposed, as a part of the length of edges. Small enough that no chain
// of such steps crosses a face.
constexpr double kWeldPart = 0.1;

class Repairing {
 public:
  Repairing(const PolygonMesh& input, const RepairOptions& options, const StopCheck& stop)
      : input_(input), options_(options), stop_(stop) {}

  RepairedSurface run() {
    require_sound_lists(input_);
    if (options_.weld) require_usable_distance(*options_.weld);
    weld_vertices();
    stop_.poll();
    list_ = triangulate(input_, Crossing::Fanned, stop_);
    given_.resize(static_cast<Index>(list_.triangles.size()), 3);
    for (Index f = 0; f < given_.rows(); ++f)
      for (Index k = 0; k < 3; ++k) given_(f, k) = welded_[list_.triangles[f][k]];
    IndexLists polygons = input_.polygons;
    for (Index& v : polygons.indices()) v = welded_[v];
    sheets_ =
        make_sheets(given_, list_.polygon, polygons, input_.positions, place_, options_, stop_);
    out_.one_sided = sheets_.one_sided;
    turn_corners();
    build();
    name_welded();
    find_texture_seams();
    for (const Index v : coincident_vertices(input_)) out_.coincident_left += out_.welded[v] == v;
    note_all();
    return std::move(out_);
  }

 private:
  void require_usable_distance(double distance) const {
    require_at_least("repair: RepairOptions::weld", distance, 0);
    if (const double most = usable_weld_distance(input_); distance > most)
      throw Error(ErrorKind::Unsupported,
                  fmt::format("{}: vertices {:g} apart cannot be welded: most faces have edges of "
                              "{:.3g} and less, and would be torn apart; give a weld distance well "
                              "below that, such as {:.1g}",
                              input_.file, distance, most, kWeldPart * most));
  }

  void weld_vertices() {
    const bool is_soup_welded = options_.welding != Welding::Nothing && is_soup(input_);
    if (options_.weld || is_soup_welded) {
      welded_ = weld(input_, options_.weld.value_or(0), stop_);
      return;
    }
    welded_.resize(input_.positions.size());
    std::iota(welded_.begin(), welded_.end(), 0);
    if (options_.welding != Welding::EqualPlaces) return;
    place_ = first_at_place(input_);
    if (place_ == welded_) place_.clear();
  }

  // Pieces of the file, whose vertices are apart.
  Index pieces_given() const {
    if (!place_.empty()) return sheets_.pieces_given;
    Cells triangles(given_.rows(), 3);
    for (Index f = 0; f < triangles.rows(); ++f)
      for (Index k = 0; k < 3; ++k) triangles(f, k) = list_.triangles[f][k];
    return make_sheets(triangles, list_.polygon, input_.polygons, input_.positions, {}, options_,
                       stop_)
        .pieces_given;
  }

  // The list as the faces are in the end.
  void turn_corners() {
    for (std::size_t f = 0; f < list_.triangles.size(); ++f)
      if (sheets_.is_turned[f]) {
        std::swap(list_.triangles[f][1], list_.triangles[f][2]);
        std::swap(list_.corners[f][1], list_.corners[f][2]);
      }
  }

  void build() {
    SurfaceParts parts;
    parts.file = input_.file;
    parts.input_face = list_.polygon;
    parts.faces = sheets_.faces;
    parts.input_vertex = sheets_.vertex;
    if (options_.numerics == Numerics::ForSolving) parts.origin = origin_of(input_, sheets_.vertex);
    parts.positions.resize(static_cast<Index>(sheets_.vertex.size()), 3);
    for (Index v = 0; v < parts.positions.rows(); ++v) {
      const Vector3& p = input_.positions[sheets_.vertex[v]];
      parts.positions.row(v) = parts.origin.isZero(0) ? p : Vector3(p - parts.origin);
    }
    place_texcoords(input_, list_, parts);
    parts.rest_triangles =
        Regularizing(parts.positions, parts.faces)
            .triangles(options_.numerics == Numerics::ForSolving ? kNeedleHeight
                                                                 : kDegenerateHeight);
    out_.mesh =
        std::make_shared<const SurfaceMesh>(SurfaceMesh::from_parts(std::move(parts), stop_));
    out_.polygon_corner.resize(given_.rows(), 3);
    for (Index f = 0; f < given_.rows(); ++f)
      for (Index k = 0; k < 3; ++k) out_.polygon_corner(f, k) = list_.corners[f][k];
  }

  Index file_vertex(Index corner) const {
    return list_.triangles[face_of(corner)][corner_of(corner)];
  }

  // A vertex whose corners are copies has the name of the first one.
  void name_welded() {
    const SurfaceMesh& mesh = *out_.mesh;
    out_.welded.resize(input_.positions.size());
    std::iota(out_.welded.begin(), out_.welded.end(), 0);
    for (Index c = mesh.half_edge_count() - 1; c >= 0; --c)
      out_.welded[file_vertex(c)] = mesh.input_vertex(mesh.from_vertex(c));
  }

  // Across edges that welding closed values are compared: one vertex per corner has numbers of its
  // own.
  void find_texture_seams() {
    const SurfaceMesh& mesh = *out_.mesh;
    out_.texture_seams.assign(to_size(mesh.half_edge_count()), 0);
    const CornerPoints& uv = mesh.corner_texcoords();
    if (uv.rows() == 0) return;
    const auto texture = [&](Index c) -> Vector2 {
      return uv.row(face_of(c)).segment<2>(2 * corner_of(c));
    };
    out_.texture_seams = texture_borders(mesh);
    for (Index h = 0; h < mesh.half_edge_count(); ++h) {
      const Index o = mesh.opposite(h);
      if (o < h || !is_textured(mesh, face_of(h)) || !is_textured(mesh, face_of(o))) continue;
      const bool is_welded =
          file_vertex(h) != file_vertex(next(o)) || file_vertex(next(h)) != file_vertex(o);
      if (is_welded)
        out_.texture_seams[h] = out_.texture_seams[o] =
            texture(h) != texture(next(o)) || texture(next(h)) != texture(o);
    }
  }

  void note(RepairKind kind, Places places) {
    if (places.empty()) return;
    Repair repair{kind, static_cast<Index>(places.size()), std::move(places)};
    if (repair.places.size() > kNamedPlaces) repair.places.resize(kNamedPlaces);
    out_.repairs.push_back(std::move(repair));
  }

  // Polygons that these triangles belong to.
  Places polygons(const std::vector<Index>& triangles) const {
    Places places;
    for (const Index t : triangles) places.push_back({list_.polygon[t], -1});
    places.erase(std::unique(places.begin(), places.end()), places.end());
    return places;
  }

  Places edges(const std::vector<Index>& half_edges) const {
    Places places;
    for (const Index h : half_edges) {
      const auto [a, b] = std::minmax({from_vertex(given_, h), to_vertex(given_, h)});
      places.push_back({a, b});
    }
    std::sort(places.begin(), places.end());
    return places;
  }

  // Triangles of a polygon come one after the other.
  Places crossing_polygons() const {
    Places places;
    for (std::size_t t = 0, end = 0; t < list_.polygon.size(); t = end) {
      const Index p = list_.polygon[t];
      std::vector<std::array<int, 3>> triangles;
      for (; end < list_.polygon.size() && list_.polygon[end] == p; ++end) {
        triangles.push_back(list_.corners[end]);
        if (sheets_.is_turned[end]) std::swap(triangles.back()[1], triangles.back()[2]);
      }
      if (triangles.size() == 1) continue;
      std::vector<Vector3> corners;
      for (const Index v : input_.polygons[p]) corners.push_back(input_.positions[v]);
      if (is_crossing(corners, triangles)) places.push_back({p, -1});
    }
    return places;
  }

  static Places vertices(const std::vector<Index>& vertices) {
    Places places;
    for (const Index v : vertices) places.push_back({v, -1});
    return places;
  }

  void note_all() {
    Places welded;
    for (std::size_t v = 0; v < welded_.size(); ++v)
      if (welded_[v] != static_cast<Index>(v) || out_.welded[v] != static_cast<Index>(v))
        welded.push_back({static_cast<Index>(v), -1});
    if (!welded.empty()) {
      note(RepairKind::Welded, std::move(welded));
      out_.repairs.back().pieces = {pieces_given(), out_.mesh->topology().components};
    }
    note(RepairKind::RepeatedVertex, polygons(sheets_.repeated));
    note(RepairKind::DuplicateFace, polygons(sheets_.duplicates));
    note(RepairKind::SplitEdge, edges(sheets_.split_edges));
    note(RepairKind::SplitVertex, vertices(sheets_.split_vertices));
    note(RepairKind::TurnedFace, polygons(sheets_.turned));
    note(RepairKind::CutEdge, edges(sheets_.cut_edges));
    out_.cut_edges = static_cast<Index>(sheets_.cut_edges.size());
    for (const Index h : sheets_.cut_edges)
      out_.cut_length +=
          (input_.positions[to_vertex(given_, h)] - input_.positions[from_vertex(given_, h)])
              .norm();
    note(RepairKind::CrossingPolygon, crossing_polygons());
    std::vector<Index> regularized;
    for (const RestTriangle& t : out_.mesh->rest_triangles()) regularized.push_back(t.face);
    note(RepairKind::RegularizedFace, polygons(regularized));
    if (!out_.mesh->origin().isZero(0)) out_.repairs.push_back({RepairKind::MovedToOrigin, 1, {}});
  }

  const PolygonMesh& input_;
  const RepairOptions& options_;
  const StopCheck& stop_;
  std::vector<Index> welded_;
  std::vector<Index> place_;  // by vertex, the first one there; empty: edges are joined by vertices
  TriangleList list_;
  Cells given_;
  Sheets sheets_;
  RepairedSurface out_;
};

// A mesh without the edges that have no length, and where its parts are in the one that had them.
class CollapsedPolygons {
 public:
  CollapsedPolygons(const PolygonMesh& input, const StopCheck& stop) {
    const auto vertices = static_cast<Index>(input.positions.size());
    const double close = kTenDigits * size_of(input);
    UnionFind places(vertices);
    for (std::size_t p = 0; p < input.polygons.size(); ++p) {
      stop.poll_at(p);
      const std::span<const Index> polygon = input.polygons[p];
      for (std::size_t k = 0; k < polygon.size(); ++k) {
        const auto [a, b] = std::minmax(polygon[k], polygon[(k + 1) % polygon.size()]);
        if (a == b || !((input.positions[a] - input.positions[b]).norm() <= close)) continue;
        edges_.push_back({a, b});
        places.join(a, b);
      }
    }
    if (edges_.empty()) return;
    std::sort(edges_.begin(), edges_.end());
    edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
    std::vector<Index> first(to_size(vertices), -1);
    for (Index v = 0; v < vertices; ++v) {
      if (first[places.find(v)] < 0) first[places.find(v)] = v;
      vertex_.push_back(first[places.find(v)]);
    }
    mesh_.file = input.file;
    mesh_.positions = input.positions;
    mesh_.position_rounding = input.position_rounding;
    for (std::size_t p = 0; p < input.polygons.size(); ++p) add(input.polygons[p], p);
  }

  // Pairs of vertices of the input, ascending.
  const Places& edges() const { return edges_; }
  const PolygonMesh& mesh() const { return mesh_; }

  // surface: of mesh(). With vertices, polygons and corners of the input.
  RepairedSurface in_input(RepairedSurface surface) const {
    SurfaceParts parts = surface.mesh->parts();
    for (std::size_t f = 0; f < parts.input_face.size(); ++f) {
      const Index left = parts.input_face[f];
      parts.input_face[f] = polygon_[left];
      for (Index& corner : surface.polygon_corner.row(static_cast<Index>(f)))
        corner = corners_[left][corner];
    }
    surface.mesh = std::make_shared<const SurfaceMesh>(SurfaceMesh::from_parts(std::move(parts)));
    const std::vector<Index> welded = surface.welded;
    for (std::size_t v = 0; v < welded.size(); ++v) surface.welded[v] = welded[vertex_[v]];
    for (Repair& repair : surface.repairs)
      if (text_of(repair.kind).place == std::string_view("face"))
        for (auto& [face, none] : repair.places) face = polygon_[face];
    Repair collapsed{RepairKind::CollapsedEdge, static_cast<Index>(edges_.size()), edges_};
    if (collapsed.places.size() > kNamedPlaces) collapsed.places.resize(kNamedPlaces);
    surface.repairs.insert(surface.repairs.begin(), std::move(collapsed));
    return surface;
  }

 private:
  // The extent of the vertices that faces use.
  static double size_of(const PolygonMesh& input) {
    Eigen::AlignedBox3d box;
    for (const Index v : input.polygons.indices()) box.extend(input.positions[v]);
    return box.isEmpty() ? 0 : box.diagonal().norm();
  }

  void add(std::span<const Index> polygon, std::size_t number) {
    std::vector<Index> left, corners;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Index v = vertex_[polygon[k]];
      if (!left.empty() && left.back() == v) continue;
      left.push_back(v);
      corners.push_back(static_cast<Index>(k));
    }
    while (left.size() > 1 && left.front() == left.back()) {
      left.pop_back();
      corners.pop_back();
    }
    if (left.size() < 3) return;
    mesh_.polygons.push_back(left);
    corners_.push_back(corners);
    polygon_.push_back(static_cast<Index>(number));
  }

  PolygonMesh mesh_;
  Places edges_;
  std::vector<Index> vertex_;   // by vertex of the input: the one it became
  std::vector<Index> polygon_;  // by polygon that is left: of the input
  IndexLists corners_;          // and where its corners were
};

}  // namespace

std::string_view name_of(RepairKind kind) { return text_of(kind).name; }

std::string describe(const Repair& repair) {
  std::string text = described(text_of(repair.kind), repair.count, repair.places);
  if (repair.pieces)
    text += fmt::format(": {} piece{} before, {} after", (*repair.pieces)[0],
                        (*repair.pieces)[0] == 1 ? "" : "s", (*repair.pieces)[1]);
  return text;
}

RepairedSurface repair(const PolygonMesh& input, const RepairOptions& options,
                       const StopCheck& stop) {
  if (options.short_edges == ShortEdges::Kept) return Repairing(input, options, stop).run();
  require_sound_lists(input);
  const CollapsedPolygons collapsed(input, stop);
  if (collapsed.edges().empty()) return Repairing(input, options, stop).run();
  return collapsed.in_input(Repairing(collapsed.mesh(), options, stop).run());
}

namespace {

// Returns whether corners of a polygon of more than three lie at one place: neither that nor their
// numbers tell then which of them a welded vertex is.
bool has_corners_at_one_place(const PolygonMesh& input, Index polygon) {
  const auto& corners = input.polygons[polygon];
  if (corners.size() == 3) return false;
  std::vector<std::array<double, 3>> places;
  for (const Index v : corners) {
    const Vector3& p = input.positions[v];
    places.push_back({p.x(), p.y(), p.z()});
  }
  std::sort(places.begin(), places.end());
  return std::adjacent_find(places.begin(), places.end()) != places.end();
}

}  // namespace

PolygonMesh with_welded_vertices(PolygonMesh input, const RepairedSurface& surface) {
  const SurfaceMesh& mesh = *surface.mesh;
  for (Index f = 0; f < mesh.face_count(); ++f)
    for (Index k = 0; k < 3; ++k) {
      const std::span<Index> polygon = input.polygons[mesh.input_face(f)];
      Index& vertex = polygon[surface.polygon_corner(f, k)];
      const Index welded = mesh.input_vertex(mesh.faces()(f, k));
      if (vertex != welded && (input.positions[vertex] != input.positions[welded] ||
                               has_corners_at_one_place(input, mesh.input_face(f))))
        vertex = welded;
    }
  return input;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
