#include "majorant/parametrization/scaffold/internal/scaffold_triangulation.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <queue>
#include <stdexcept>
#include <tuple>
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

enum class Side { Unknown, Scaffold, Image };
struct FaceMark {
  Side side = Side::Unknown;
  Index visit = 0;  // number of the last search that visited the face
};

using Delaunay = internal::ConstrainedDelaunay<Index, FaceMark>;
using Point = Delaunay::Point;
using VertexHandle = Delaunay::Vertex_handle;
using FaceHandle = Delaunay::Face_handle;

struct Edge {
  Index from, to, loop;
};

Vector2 vector_of(const Point& p) { return {p.x(), p.y()}; }

// Returns whether two edges have a point in common, other than the one where an edge ends and the
// next one starts. Exact.
bool edges_meet(const std::vector<Point>& points, const Edge& e, const Edge& f) {
  const auto point = [&](Index v) { return vector_of(points[v]); };
  const Vector2 a = point(e.from), b = point(e.to), c = point(f.from), d = point(f.to);
  if (e.to == f.from) return a == b || b == d || segments_fold(a, b, d);
  if (f.to == e.from) return edges_meet(points, f, e);
  return segments_meet(a, b, c, d);
}

// Throws the Error of the first boundary edges that meet.
[[noreturn]] void refuse(const std::vector<Point>& points, const std::vector<Edge>& edges) {
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
std::vector<Point> frame_around(const std::vector<Point>& points, double margin) {
  Eigen::AlignedBox2d box;
  for (const Point& p : points) box.extend(vector_of(p));
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
  std::vector<Point> frame;
  for (std::size_t side = 0; side < 4; ++side) {
    const Vector2 from = corners[side], step = corners[(side + 1) % 4] - from;
    const double pieces =
        std::clamp(std::round(step.cwiseAbs().maxCoeff() / gap), kMinFramePieces, kMaxFramePieces);
    for (double k = 0; k < pieces; ++k) {
      const Vector2 point = from + k / pieces * step;
      frame.push_back({point.x(), point.y()});
    }
  }
  return frame;
}

// A triangle of the scaffold that is to be refined. Its first corner is the lexicographically
// smallest, so that all computations are independent of the order of vertices and faces.
struct BadTriangle {
  double ratio;          // circumradius to shortest edge
  double shortest_edge;  // length
  std::array<VertexHandle, 3> corners;
  FaceHandle face;

  auto key() const {
    return std::make_tuple(ratio, corners[0]->point(), corners[1]->point(), corners[2]->point());
  }
  bool operator<(const BadTriangle& other) const { return key() < other.key(); }
  // Returns whether the triangle still exists: its face has the same corners.
  bool is_alive() const {
    return std::ranges::all_of(corners, [&](VertexHandle v) { return face->has_vertex(v); });
  }
};

Vector2 between(const Point& a, const Point& b) { return vector_of(b) - vector_of(a); }

BadTriangle measured(FaceHandle face) {
  std::array<VertexHandle, 3> p = {face->vertex(0), face->vertex(1), face->vertex(2)};
  const auto before = [](VertexHandle a, VertexHandle b) { return a->point() < b->point(); };
  std::rotate(p.begin(), std::min_element(p.begin(), p.end(), before), p.end());
  const Vector2 b = between(p[0]->point(), p[1]->point()),
                c = between(p[0]->point(), p[2]->point());
  std::array<double, 3> lengths = {b.norm(), c.norm(), (c - b).norm()};
  std::sort(lengths.begin(), lengths.end());
  // R = product of the sides / (2 cross(b, c)); rounding may give a needle any area.
  const double ratio = cross(b, c) > 0 ? lengths[1] * lengths[2] / (2 * cross(b, c))
                                       : std::numeric_limits<double>::infinity();
  return {ratio, lengths[0], p, face};
}

Point circumcentre(const std::array<VertexHandle, 3>& p) {
  const Vector2 b = between(p[0]->point(), p[1]->point()),
                c = between(p[0]->point(), p[2]->point());
  const double scale = 0.5 / cross(b, c), bb = b.squaredNorm(), cc = c.squaredNorm();
  return {p[0]->point().x() + scale * (c.y() * bb - b.y() * cc),
          p[0]->point().y() + scale * (b.x() * cc - c.x() * bb)};
}

// Returns whether p is to the right of the edge ab, or so close that it sees the edge at a large
// angle.
bool encroaches(const Point& a, const Point& b, const Point& p) {
  const Vector2 to_a = between(p, a), to_b = between(p, b);
  return CGAL::right_turn(a, b, p) ||
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
  FaceHandle find_room(FaceHandle start, const Point& centre, double clearance);

  std::vector<Point> points_;           // boundary, then frame
  std::vector<Edge> edges_;             // of the boundary
  std::vector<VertexHandle> vertices_;  // by number
  Delaunay delaunay_;
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
  const std::vector<Point> frame = frame_around(points_, margin);
  points_.insert(points_.end(), frame.begin(), frame.end());
  insert_frame();
  find_sides();
  check_sides();
}

// Inserts the boundary. Coinciding points become one vertex. An edge that crosses another one or
// passes through a vertex is missing in the end.
bool ScaffoldBuilder::insert_boundary() {
  std::vector<std::pair<Point, Index>> numbered;
  for (const Edge& edge : edges_) numbered.push_back({points_[edge.from], edge.from});
  delaunay_.insert(numbered.begin(), numbered.end());
  if (delaunay_.number_of_vertices() != points_.size() || delaunay_.dimension() < 2) return false;
  vertices_.resize(points_.size());
  for (const VertexHandle v : delaunay_.finite_vertex_handles()) vertices_[v->info()] = v;
  try {
    for (const Edge& edge : edges_)
      delaunay_.insert_constraint(vertices_[edge.from], vertices_[edge.to]);
  } catch (const Delaunay::Intersection_of_constraints_exception&) {
    return false;
  }
  return std::all_of(edges_.begin(), edges_.end(), [&](const Edge& edge) {
    return delaunay_.is_edge(vertices_[edge.from], vertices_[edge.to]);
  });
}

void ScaffoldBuilder::insert_frame() {
  for (std::size_t v = edges_.size(); v < points_.size(); ++v) {
    vertices_.push_back(delaunay_.insert(points_[v]));
    vertices_.back()->info() = static_cast<Index>(v);
  }
  VertexHandle last = vertices_.back();
  for (std::size_t v = edges_.size(); v < points_.size(); last = vertices_[v++])
    delaunay_.insert_constraint(last, vertices_[v]);
}

// Marks the sides of all faces. The frame is the convex hull; from there the side changes at every
// boundary edge.
void ScaffoldBuilder::find_sides() {
  const VertexHandle infinity = delaunay_.infinite_vertex();
  const FaceHandle outside = infinity->face();
  std::vector<FaceHandle> open = {outside->neighbor(outside->index(infinity))};
  open.back()->info().side = Side::Scaffold;
  while (!open.empty()) {
    const FaceHandle face = open.back();
    open.pop_back();
    const Side here = face->info().side;
    const Side beyond = here == Side::Scaffold ? Side::Image : Side::Scaffold;
    for (int i = 0; i < 3; ++i) {
      const FaceHandle next = face->neighbor(i);
      if (delaunay_.is_infinite(next) || next->info().side != Side::Unknown) continue;
      next->info().side = face->is_constrained(i) ? beyond : here;
      open.push_back(next);
    }
  }
}

void ScaffoldBuilder::check_sides() const {
  for (const Edge& edge : edges_) {
    FaceHandle face;
    int i = 0;
    delaunay_.is_edge(vertices_[edge.from], vertices_[edge.to], face, i);
    const bool on_the_left = face->vertex(Delaunay::ccw(i)) == vertices_[edge.from];
    if (face->info().side != (on_the_left ? Side::Image : Side::Scaffold))
      throw Error(ErrorKind::Infeasible,
                  fmt::format("triangulate_scaffold: loop {} has the image on its right; outer "
                              "boundaries run counterclockwise, holes clockwise",
                              edge.loop));
  }
}

// Returns the face that contains `centre`, searched from `start` through faces whose circumcircles
// contain it. None if it encroaches upon an edge of boundary or frame, or is closer than
// `clearance` to a vertex.
FaceHandle ScaffoldBuilder::find_room(FaceHandle start, const Point& centre, double clearance) {
  const auto in_circle = [&](FaceHandle face) {
    return delaunay_.side_of_oriented_circle(face, centre) == CGAL::ON_POSITIVE_SIDE;
  };
  FaceHandle room;
  if (!in_circle(start)) return room;  // the circumcentre of a needle is rounded
  std::vector<FaceHandle> cavity = {start};
  start->info().visit = ++visit_;
  for (std::size_t k = 0; k < cavity.size(); ++k) {
    const FaceHandle face = cavity[k];
    bool inside = true;
    for (int i = 0; i < 3; ++i) {
      const Point &a = face->vertex(Delaunay::ccw(i))->point(),
                  &b = face->vertex(Delaunay::cw(i))->point();
      if (CGAL::squared_distance(a, centre) < clearance * clearance) return {};
      inside = inside && !CGAL::right_turn(a, b, centre);
      const FaceHandle next = face->neighbor(i);
      if (face->is_constrained(i)) {
        if (encroaches(a, b, centre)) return {};
      } else if (next->info().visit != visit_ && in_circle(next)) {
        next->info().visit = visit_;
        cavity.push_back(next);
      }
    }
    if (inside) room = face;
  }
  return room;
}

void ScaffoldBuilder::refine(double quality) {
  std::priority_queue<BadTriangle> queue;
  const auto add = [&](FaceHandle face) {
    if (face->info().side != Side::Scaffold) return;
    if (const BadTriangle triangle = measured(face); triangle.ratio > quality) queue.push(triangle);
  };
  for (const FaceHandle face : delaunay_.finite_face_handles()) add(face);
  const std::size_t most = points_.size() + to_size(kMinInsertionBound) +
                           to_size(kMaxInsertionsPerEdge) * points_.size();
  while (!queue.empty() && vertices_.size() < most) {
    const BadTriangle triangle = queue.top();
    queue.pop();
    const Point centre = circumcentre(triangle.corners);
    if (!triangle.is_alive() || !std::isfinite(centre.x()) || !std::isfinite(centre.y())) continue;
    const FaceHandle room = find_room(triangle.face, centre, triangle.shortest_edge);
    if (room == FaceHandle()) continue;
    const VertexHandle vertex = delaunay_.insert(centre, room);
    vertex->info() = static_cast<Index>(vertices_.size());
    vertices_.push_back(vertex);
    // All changed faces lie around the new vertex.
    auto around = delaunay_.incident_faces(vertex);
    const auto end = around;
    do around->info().side = Side::Scaffold;
    while (++around != end);
    do add(around);
    while (++around != end);
  }
}

ScaffoldTriangulation ScaffoldBuilder::result() const {
  ScaffoldTriangulation scaffold;
  scaffold.positions.resize(static_cast<Index>(vertices_.size()), 2);
  for (const VertexHandle v : vertices_)
    scaffold.positions.row(v->info()) << v->point().x(), v->point().y();
  std::vector<std::array<Index, 3>> faces;
  for (const FaceHandle face : delaunay_.finite_face_handles()) {
    if (face->info().side != Side::Scaffold) continue;
    std::array<Index, 3> corners = {face->vertex(0)->info(), face->vertex(1)->info(),
                                    face->vertex(2)->info()};
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
