#include "majorant/parametrization/scaffold/internal/scaffold_triangulation.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <queue>
#include <stdexcept>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/mesh/constrained_delaunay.h"
#include "majorant/mesh/exact_predicates.h"

namespace majorant {
namespace {

// Bounds on the number of pieces of a side of the frame. Pieces are about as long as the frame's
// distance from the image, so that the triangles between them are well shaped.
constexpr double kMinFramePieces = 4, kMaxFramePieces = 64;
// Bounds on the cost of refinement, which always terminates: points inserted per edge, and the
// least bound. Common boundaries need one point an edge.
constexpr Index kMaxInsertionsPerEdge = 6, kMinInsertionBound = 2000;

// New points see boundary edges at less than 120 degrees: the lenses of [Che93]. With circles (90
// degrees) a sixth more triangles of jagged boundaries stay below 15 degrees.
constexpr double kEncroachingCosine = -0.5;

// The values of FaceMark::region.
struct Side {
  enum : int { Unknown, Scaffold, Image };
};

using Face = ConstrainedDelaunay::Face;

struct Edge {
  Index from, to, loop;
};

// Returns whether two edges have a point in common, other than the one where an edge ends and the
// next one starts. Exact.
bool edges_meet(const std::vector<Vector2>& points, const Edge& e, const Edge& f) {
  const Vector2 &a = points[e.from], &b = points[e.to], &c = points[f.from], &d = points[f.to];
  if (e.to == f.from) return a == b || b == d || segments_fold(a, b, d);
  if (f.to == e.from) return edges_meet(points, f, e);
  return segments_meet(a, b, c, d);
}

// Throws the Error for the first boundary edges that meet.
[[noreturn]] void refuse(const std::vector<Vector2>& points, const std::vector<Edge>& edges) {
  const auto extent = [&](Index e) {
    return std::minmax(points[edges[e].from].x(), points[edges[e].to].x());
  };
  const auto left = [&](Index e) { return extent(e).first; };
  const auto right = [&](Index e) { return extent(e).second; };
  std::vector<Index> order(edges.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](Index e, Index f) { return left(e) < left(f); });
  std::pair<Index, Index> first{static_cast<Index>(edges.size()), 0};  // none
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = i + 1; j < order.size() && left(order[j]) <= right(order[i]); ++j)
      if (const std::pair<Index, Index> pair = std::minmax(order[i], order[j]);
          pair < first && edges_meet(points, edges[pair.first], edges[pair.second]))
        first = pair;
  if (to_size(first.first) == edges.size())
    throw std::logic_error("triangulate_scaffold: boundary edges are lost");
  const Edge &e = edges[first.first], &f = edges[first.second];
  throw Error(ErrorKind::Infeasible,
              fmt::format("triangulate_scaffold: edges ({}, {}) of loop {} and ({}, {}) of loop {} "
                          "of the image's boundary intersect or touch",
                          e.from, e.to, e.loop, f.from, f.to, f.loop));
}

// Returns a rectangle around the points, counterclockwise from the lower left corner, with points
// on its sides. Points of a side have one coordinate in common, exactly.
std::vector<Vector2> frame_around(const std::vector<Vector2>& points, double margin) {
  Eigen::AlignedBox2d box;
  for (const Vector2& p : points) box.extend(p);
  const double gap = margin * box.sizes().maxCoeff();
  const Vector2 frame_low = box.min().array() - gap, frame_high = box.max().array() + gap;
  const bool is_resolved = (frame_low.array() - gap / 8 < frame_low.array()).all() &&
                           (frame_high.array() + gap / 8 > frame_high.array()).all();
  if (!is_resolved || !(frame_high - frame_low).allFinite())
    throw Error(ErrorKind::Infeasible,
                fmt::format("triangulate_scaffold: no frame fits around the image with margin {}; "
                            "its points are too close to each other, or too far from the origin",
                            margin));
  const std::array<Vector2, 4> corners = {frame_low, Vector2(frame_high.x(), frame_low.y()),
                                          frame_high, Vector2(frame_low.x(), frame_high.y())};
  std::vector<Vector2> frame;
  for (std::size_t side = 0; side < 4; ++side) {
    const Vector2 from = corners[side], step = corners[(side + 1) % 4] - from;
    const double pieces =
        std::clamp(std::round(step.cwiseAbs().maxCoeff() / gap), kMinFramePieces, kMaxFramePieces);
    for (double k = 0; k < pieces; ++k) {
      frame.push_back(from + k / pieces * step);
    }
  }
  return frame;
}

bool precedes_lexicographically(const Vector2& a, const Vector2& b) {
  return std::pair(a.x(), a.y()) < std::pair(b.x(), b.y());
}

// A triangle of the scaffold that is to be refined. Its first corner is the lexicographically
// smallest, so that all computations are independent of the order of vertices and faces.
struct BadTriangle {
  double ratio;          // circumradius to shortest edge
  double shortest_edge;  // length
  std::array<Index, 3> vertices;
  Face face;
};

BadTriangle measured(const ConstrainedDelaunay& delaunay, Face face) {
  std::array<Index, 3> v = {delaunay.vertex(face, 0), delaunay.vertex(face, 1),
                            delaunay.vertex(face, 2)};
  const auto before = [&](Index a, Index b) {
    return precedes_lexicographically(delaunay.point(a), delaunay.point(b));
  };
  std::rotate(v.begin(), std::min_element(v.begin(), v.end(), before), v.end());
  const Vector2& a = delaunay.point(v[0]);
  const Vector2 b = delaunay.point(v[1]) - a, c = delaunay.point(v[2]) - a;
  std::array<double, 3> lengths = {b.norm(), c.norm(), (c - b).norm()};
  std::sort(lengths.begin(), lengths.end());
  // R = product of the sides / (2 cross(b, c)); rounding may give a needle any area.
  const double ratio = cross(b, c) > 0 ? lengths[1] * lengths[2] / (2 * cross(b, c))
                                       : std::numeric_limits<double>::infinity();
  return {ratio, lengths[0], v, face};
}

// Returns whether the triangle still exists: its face has the same corners.
bool is_alive(const ConstrainedDelaunay& delaunay, const BadTriangle& triangle) {
  return std::ranges::all_of(triangle.vertices, [&](Index v) {
    return delaunay.vertex(triangle.face, 0) == v || delaunay.vertex(triangle.face, 1) == v ||
           delaunay.vertex(triangle.face, 2) == v;
  });
}

Vector2 circumcentre(const ConstrainedDelaunay& delaunay, const BadTriangle& triangle) {
  const Vector2& a = delaunay.point(triangle.vertices[0]);
  const Vector2 b = delaunay.point(triangle.vertices[1]) - a,
                c = delaunay.point(triangle.vertices[2]) - a;
  const double scale = 0.5 / cross(b, c), bb = b.squaredNorm(), cc = c.squaredNorm();
  return {a.x() + scale * (c.y() * bb - b.y() * cc), a.y() + scale * (b.x() * cc - c.x() * bb)};
}

// Returns true if p is to the right of the edge ab, or so close that it sees the edge at a large
// angle.
bool encroaches(const Vector2& a, const Vector2& b, const Vector2& p) {
  const Vector2 to_a = a - p, to_b = b - p;
  return orientation(a, b, p) < 0 ||
         to_a.dot(to_b) <= kEncroachingCosine * to_a.norm() * to_b.norm();
}

// Triangulates the frame with the image inside, and refines the triangles outside the image.
class ScaffoldBuilder {
 public:
  ScaffoldBuilder(const std::vector<Points2>& loops, double margin);
  void refine(double quality);
  ScaffoldTriangulation result() const;

 private:
  bool insert_boundary();
  void insert_frame();
  void find_sides();
  void check_sides() const;
  std::optional<Face> find_room(Face start, const Vector2& centre, double clearance);

  std::vector<Vector2> points_;  // boundary, then frame
  std::vector<Edge> edges_;      // of the boundary
  ConstrainedDelaunay delaunay_;
  Index visit_ = 0;
};

ScaffoldBuilder::ScaffoldBuilder(const std::vector<Points2>& loops, double margin) {
  for (std::size_t l = 0; l < loops.size(); ++l) {
    const Index first = static_cast<Index>(points_.size());
    const Index count = static_cast<Index>(loops[l].rows());
    for (Index k = 0; k < count; ++k) {
      points_.push_back({loops[l](k, 0), loops[l](k, 1)});
      edges_.push_back({first + k, first + (k + 1) % count, static_cast<Index>(l)});
    }
  }
  if (!insert_boundary()) refuse(points_, edges_);
  const std::vector<Vector2> frame = frame_around(points_, margin);
  points_.insert(points_.end(), frame.begin(), frame.end());
  insert_frame();
  find_sides();
  check_sides();
}

// Inserts the boundary. Coinciding points become one vertex. An edge that crosses another one or
// passes through a vertex is missing in the end.
bool ScaffoldBuilder::insert_boundary() {
  delaunay_.insert(points_);
  if (to_size(delaunay_.vertex_count()) != points_.size() || delaunay_.is_flat()) return false;
  for (const Edge& edge : edges_)
    if (!delaunay_.insert_constraint(edge.from, edge.to)) return false;
  return std::all_of(edges_.begin(), edges_.end(), [&](const Edge& edge) {
    return delaunay_.find_edge(edge.from, edge.to).has_value();
  });
}

void ScaffoldBuilder::insert_frame() {
  const Index first = static_cast<Index>(edges_.size());
  const Index end = static_cast<Index>(points_.size());
  for (Index v = first; v < end; ++v) delaunay_.insert(points_[v]);
  for (Index v = first, last = end - 1; v < end; last = v++)
    if (!delaunay_.insert_constraint(last, v))
      throw std::logic_error("triangulate_scaffold: the frame crosses the boundary");
}

// Marks the sides of all faces. The frame is the convex hull; from there the side changes at every
// boundary edge.
void ScaffoldBuilder::find_sides() {
  const Face outside = delaunay_.infinite_face();
  std::vector<Face> open;
  for (int i = 0; i < 3; ++i)
    if (delaunay_.vertex(outside, i) < 0) open = {delaunay_.neighbor(outside, i)};
  delaunay_.mark(open.back()).region = Side::Scaffold;
  while (!open.empty()) {
    const Face face = open.back();
    open.pop_back();
    const int here = delaunay_.mark(face).region;
    const int beyond = here == Side::Scaffold ? Side::Image : Side::Scaffold;
    for (int i = 0; i < 3; ++i) {
      const Face next = delaunay_.neighbor(face, i);
      if (!delaunay_.is_finite(next) || delaunay_.mark(next).region != Side::Unknown) continue;
      delaunay_.mark(next).region = delaunay_.is_constrained(face, i) ? beyond : here;
      open.push_back(next);
    }
  }
}

void ScaffoldBuilder::check_sides() const {
  for (const Edge& edge : edges_)
    if (delaunay_.mark(delaunay_.find_edge(edge.from, edge.to)->first).region != Side::Image)
      throw Error(ErrorKind::Infeasible,
                  fmt::format("triangulate_scaffold: loop {} has the image on its right; outer "
                              "boundaries run counterclockwise, holes clockwise",
                              edge.loop));
}

// Returns the face that contains `centre`, searched from `start` through faces whose circumcircles
// contain it. None if it encroaches upon an edge of boundary or frame, or is closer than
// `clearance` to a vertex.
std::optional<Face> ScaffoldBuilder::find_room(Face start, const Vector2& centre,
                                               double clearance) {
  const auto corner = [&](Face face, int i) -> const Vector2& {
    return delaunay_.point(delaunay_.vertex(face, i));
  };
  const auto circle_holds_it = [&](Face face) {
    return in_circle(corner(face, 0), corner(face, 1), corner(face, 2), centre) > 0;
  };
  std::optional<Face> room;
  if (!circle_holds_it(start)) return room;  // the centre of a needle, rounded
  std::vector<Face> cavity = {start};
  delaunay_.mark(start).visit = ++visit_;
  for (std::size_t k = 0; k < cavity.size(); ++k) {
    const Face face = cavity[k];
    bool inside = true;
    for (int i = 0; i < 3; ++i) {
      const Vector2 &a = corner(face, (i + 1) % 3), &b = corner(face, (i + 2) % 3);
      if ((a - centre).squaredNorm() < clearance * clearance) return {};
      inside = inside && orientation(a, b, centre) >= 0;
      if (delaunay_.is_constrained(face, i)) {
        if (encroaches(a, b, centre)) return {};
        continue;
      }
      const Face next = delaunay_.neighbor(face, i);
      if (delaunay_.mark(next).visit != visit_ && circle_holds_it(next)) {
        delaunay_.mark(next).visit = visit_;
        cavity.push_back(next);
      }
    }
    if (inside) room = face;
  }
  return room;
}

void ScaffoldBuilder::refine(double quality) {
  const auto is_better = [&](const BadTriangle& a, const BadTriangle& b) {
    if (a.ratio != b.ratio) return a.ratio < b.ratio;
    return std::ranges::lexicographical_compare(
        a.vertices, b.vertices, precedes_lexicographically,
        [&](Index v) { return delaunay_.point(v); }, [&](Index v) { return delaunay_.point(v); });
  };
  std::priority_queue<BadTriangle, std::vector<BadTriangle>, decltype(is_better)> queue(is_better);
  const auto add = [&](Face face) {
    if (delaunay_.mark(face).region != Side::Scaffold) return;
    if (const BadTriangle triangle = measured(delaunay_, face); triangle.ratio > quality)
      queue.push(triangle);
  };
  for (const Face face : delaunay_.finite_faces()) add(face);
  const std::size_t most = points_.size() + to_size(kMinInsertionBound) +
                           to_size(kMaxInsertionsPerEdge) * points_.size();
  while (!queue.empty() && to_size(delaunay_.vertex_count()) < most) {
    const BadTriangle triangle = queue.top();
    queue.pop();
    const Vector2 centre = circumcentre(delaunay_, triangle);
    if (!is_alive(delaunay_, triangle) || !centre.allFinite()) continue;
    const std::optional<Face> room = find_room(triangle.face, centre, triangle.shortest_edge);
    if (!room) continue;
    // All changed faces lie around the new vertex.
    const std::vector<Face> around = delaunay_.faces_around(delaunay_.insert(centre, *room));
    for (const Face face : around) delaunay_.mark(face).region = Side::Scaffold;
    for (const Face face : around) add(face);
  }
}

ScaffoldTriangulation ScaffoldBuilder::result() const {
  ScaffoldTriangulation scaffold;
  scaffold.positions.resize(delaunay_.vertex_count(), 2);
  for (Index v = 0; v < delaunay_.vertex_count(); ++v)
    scaffold.positions.row(v) = delaunay_.point(v);
  std::vector<std::array<Index, 3>> faces;
  for (const Face face : delaunay_.finite_faces()) {
    if (delaunay_.mark(face).region != Side::Scaffold) continue;
    std::array<Index, 3> corners = {delaunay_.vertex(face, 0), delaunay_.vertex(face, 1),
                                    delaunay_.vertex(face, 2)};
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    faces.push_back(corners);
  }
  std::sort(faces.begin(), faces.end());
  scaffold.faces.resize(static_cast<Index>(faces.size()), 3);
  for (std::size_t f = 0; f < faces.size(); ++f)
    scaffold.faces.row(static_cast<Index>(f)) << faces[f][0], faces[f][1], faces[f][2];
  for (std::size_t v = edges_.size(); v < points_.size(); ++v)
    scaffold.frame.push_back(static_cast<Index>(v));
  return scaffold;
}

}  // namespace

ScaffoldTriangulation triangulate_scaffold(const std::vector<Points2>& loops,
                                           const ScaffoldOptions& options) {
  if (!(options.margin > 0 && std::isfinite(options.margin)) || !(options.quality >= 1))
    throw InvalidArgument("triangulate_scaffold: margin > 0 and quality >= 1 are needed");
  if (loops.empty()) throw InvalidArgument("triangulate_scaffold: no loops");
  for (std::size_t l = 0; l < loops.size(); ++l)
    if (loops[l].rows() < 3 || !loops[l].allFinite())
      throw InvalidArgument(
          fmt::format("triangulate_scaffold: loop {} needs 3 or more points, all finite", l));
  ScaffoldBuilder builder(loops, options.margin);
  builder.refine(options.quality);
  return builder.result();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
