#include "majorant/parametrization/global_injectivity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "majorant/constraints/seamless_constraint.h"
#include "majorant/parametrization/box_pairs.h"
#include "majorant/parametrization/curve_piece.h"

namespace majorant {
namespace {

constexpr std::size_t kMaxContacts = 32;  // a few show what is wrong; then the search ends
constexpr double kUnit = 0x1p-53;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

double cross(const Vector2& a, const Vector2& b) { return a.x() * b.y() - a.y() * b.x(); }

struct BoundaryLoop {
  Index first, last;  // curves [first, last) in order, the surface on their left
  Index component;
};

struct Boundary {
  std::vector<Index> half_edge;  // of each curve
  std::vector<PlanarCurve> curves;
  std::vector<Index> next;  // the curve that starts where this one ends
  std::vector<BoundaryLoop> loops;
  Index components = 0;
};

PlanarCurve curve_of(const BezierMap& map, Index half_edge) {
  PlanarCurve curve;
  curve.degree = map.degree();
  std::size_t k = 0;
  for (const Index node : edge_nodes(map.space(), half_edge))
    curve.control_points[k++] = map.control_points().segment<2>(2 * node);
  return curve;
}

std::vector<Index> component_of_faces(const SurfaceMesh& mesh, Index& count) {
  std::vector<Index> component(at(mesh.face_count()), -1), stack;
  for (Index seed = 0; seed < mesh.face_count(); ++seed) {
    if (component[at(seed)] >= 0) continue;
    component[at(seed)] = count;
    stack.push_back(seed);
    while (!stack.empty()) {
      const Index f = stack.back();
      stack.pop_back();
      for (Index h = 3 * f; h < 3 * f + 3; ++h) {
        const Index g = mesh.opposite(h) < 0 ? f : mesh.opposite(h) / 3;
        if (component[at(g)] >= 0) continue;
        component[at(g)] = count;
        stack.push_back(g);
      }
    }
    ++count;
  }
  return component;
}

Boundary boundary_of(const BezierMap& map) {
  const SurfaceMesh& mesh = map.mesh();
  Boundary b;
  const std::vector<Index> component = component_of_faces(mesh, b.components);
  std::vector<Index> leaving(at(mesh.vertex_count()), -1);  // boundary half-edge of each vertex
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    if (mesh.opposite(h) < 0) leaving[at(mesh.from_vertex(h))] = h;
  std::vector<char> seen(at(mesh.vertex_count()), 0);
  for (Index start = 0; start < mesh.vertex_count(); ++start) {
    if (leaving[at(start)] < 0 || seen[at(start)]) continue;
    const auto first = static_cast<Index>(b.curves.size());
    for (Index v = start; !seen[at(v)]; v = mesh.to_vertex(leaving[at(v)])) {
      seen[at(v)] = 1;
      b.half_edge.push_back(leaving[at(v)]);
      b.curves.push_back(curve_of(map, leaving[at(v)]));
      b.next.push_back(static_cast<Index>(b.curves.size()));
    }
    b.next.back() = first;
    b.loops.push_back(
        {first, static_cast<Index>(b.curves.size()), component[at(leaving[at(start)] / 3)]});
  }
  return b;
}

// ---- Contacts ----

class Contacts {
 public:
  Contacts(const Boundary& boundary, GlobalInjectivity& out) : boundary_(boundary), out_(out) {}

  void find() {
    std::vector<Box2> boxes;
    for (std::size_t k = 0; k < boundary_.curves.size(); ++k) {
      const auto curve = static_cast<Index>(k);
      if (!add(curve, curve, contact_with_itself(boundary_.curves[k]))) return;
      boxes.push_back(box_of(boundary_.curves[k]));
    }
    visit_meeting_boxes(boxes, [this](Index i, Index j) { return test(i, j); });
  }

 private:
  static Box2 box_of(const PlanarCurve& curve) {
    Box2 box{curve.front(), curve.front()};
    for (int k = 1; k <= curve.degree; ++k) {
      box.low = box.low.cwiseMin(curve.control_points[static_cast<std::size_t>(k)]);
      box.high = box.high.cwiseMax(curve.control_points[static_cast<std::size_t>(k)]);
    }
    return box;
  }

  bool test(Index i, Index j) {
    const PlanarCurve &a = boundary_.curves[at(i)], &b = boundary_.curves[at(j)];
    ++out_.pairs_tested;
    if (boundary_.next[at(i)] == j) return add(i, j, contact_of_neighbours(a, b));
    if (boundary_.next[at(j)] == i) return add(i, j, contact_of_neighbours(b, a));
    return add(i, j, contact_between(a, b));
  }

  // False once there are enough.
  bool add(Index i, Index j, const CurveContact& contact) {
    if (contact.kind == Contact::None) return true;
    const auto [a, b] = std::minmax(boundary_.half_edge[at(i)], boundary_.half_edge[at(j)]);
    out_.contacts.push_back({a, b, contact.where, contact.kind});
    return out_.contacts.size() < kMaxContacts;
  }

  const Boundary& boundary_;
  GlobalInjectivity& out_;
};

// ---- Orientation and nesting ----

double binomial(int n, int k) {
  double value = 1;
  for (int i = 1; i <= k; ++i) value = value * (n - k + i) / i;
  return value;
}

struct Area {
  double value = 0, bound = 0;  // and of its error
  int sign() const { return value > bound ? 1 : value < -bound ? -1 : 0; }
};

// Twice the area inside a loop is the integral of c x c' dt, for Bernstein coefficients a sum of
// c_i x (c_{j+1} - c_j) with the weights C(n,i) C(n-1,j) / (2 C(2n-1,i+j)).
Area area_inside(const Boundary& boundary, const BoundaryLoop& loop) {
  const Vector2 origin = boundary.curves[at(loop.first)].front();
  double sum = 0, size = 0;
  for (Index k = loop.first; k < loop.last; ++k) {
    const PlanarCurve& curve = boundary.curves[at(k)];
    const int n = curve.degree;
    double of_curve = 0;
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j < n; ++j) {
        const auto point = [&](int l) { return curve.control_points[static_cast<std::size_t>(l)]; };
        const Vector2 c = point(i) - origin, d = point(j + 1) - point(j);
        const double weight =
            binomial(n, i) * binomial(n - 1, j) / (2 * binomial(2 * n - 1, i + j));
        of_curve += weight * cross(c, d);
        size += weight * (std::abs(c.x() * d.y()) + std::abs(c.y() * d.x()));
      }
    sum += of_curve;
  }
  // Roundings of a term (10), of the sum over a curve (at most 72) and over the curves.
  const double bound =
      1.01 * kUnit * (100.0 + loop.last - loop.first) * size + std::numeric_limits<double>::min();
  return {sum, bound};
}

// Angle by which a piece turns around the origin, none if that is not found.
std::optional<double> angle_around_origin(const curve_piece::Piece<double>& piece) {
  const auto d = piece.chord();
  for (const curve_piece::Direction<double>& axis :
       {curve_piece::Direction<double>{1, 0}, {0, 1}, {-d.y, d.x}}) {
    const auto range = along(piece, axis);
    if (!(range.low > 0 || range.high < 0)) continue;
    const std::size_t last = piece.at(piece.degree);
    const Vector2 a(piece.x[0], piece.y[0]), b(piece.x[last], piece.y[last]);
    return std::atan2(cross(a, b), a.dot(b));  // in a half-plane: less than pi
  }
  constexpr int kDepth = 60;
  if (piece.depth >= kDepth || !(piece.size() > 4 * piece.largest_error())) return {};
  const auto [first, second] = split(piece);
  const auto one = angle_around_origin(first);
  if (!one) return {};
  const auto two = angle_around_origin(second);
  return two ? std::optional(*one + *two) : std::nullopt;
}

// Sum of the winding numbers around p of the loops of one component, or of all: how often the map
// covers p. None if p may lie on the boundary.
constexpr Index kAll = -1;
std::optional<long> winding(const Boundary& boundary, Index component, const Vector2& p) {
  double angle = 0;
  for (const BoundaryLoop& loop : boundary.loops) {
    if (component != kAll && loop.component != component) continue;
    for (Index k = loop.first; k < loop.last; ++k) {
      const auto part = angle_around_origin({boundary.curves[at(k)], p});
      if (!part) return {};
      angle += *part;
    }
  }
  return std::lround(angle / (2 * std::numbers::pi));
}

struct Finding {
  Injectivity result;
  std::string reason;
};

// A point that is covered several times, near contacts that could not be decided: proves what pairs
// of curves do not show, such as boundaries that cross at their vertices.
Finding find_double_cover(const BezierMap& map, const Boundary& boundary,
                          const std::vector<BoundaryContact>& contacts) {
  constexpr std::size_t kPlaces = 8;  // every point costs a pass over the boundary
  constexpr int kDirections = 6;
  for (std::size_t k = 0; k < std::min(kPlaces, contacts.size()); ++k) {
    const BoundaryContact& contact = contacts[k];
    const PlanarCurve edge = curve_of(map, contact.half_edge_a);
    const double size = (edge.back() - edge.front()).norm();
    for (const double relative : {0x1p-3, 0x1p-8, 0x1p-16, 0x1p-32, 0x1p-42})  // sizes of the edge
      for (int d = 0; d < kDirections; ++d) {
        const double angle = 0.3 + 2 * std::numbers::pi * d / kDirections;
        const Vector2 p =
            contact.where + relative * size * Vector2(std::cos(angle), std::sin(angle));
        const std::optional<long> times = winding(boundary, kAll, p);
        if (times && *times > 1)
          return {Injectivity::Violated,
                  fmt::format("({:.9g}, {:.9g}) is covered {} times", p.x(), p.y(), *times)};
      }
  }
  return {Injectivity::Undecided, ""};
}

// Every component has one counterclockwise loop: these loops, by component.
Finding find_outer_loops(const Boundary& boundary, std::vector<const BoundaryLoop*>& outer) {
  std::vector<Area> total(at(boundary.components));
  outer.assign(at(boundary.components), nullptr);
  for (const BoundaryLoop& loop : boundary.loops) {
    const std::size_t component = at(loop.component);
    const Area area = area_inside(boundary, loop);
    total[component].value += area.value;
    total[component].bound += area.bound + kUnit * std::abs(total[component].value);
    if (area.sign() == 0)
      return {Injectivity::Undecided, "a boundary loop encloses too little area to tell its sense"};
    if (area.sign() < 0) continue;
    if (outer[component])
      return {Injectivity::Violated, "two boundary loops of one component are counterclockwise"};
    outer[component] = &loop;
  }
  for (std::size_t c = 0; c < total.size(); ++c) {
    if (!outer[c])
      return {Injectivity::Violated, "a component has no counterclockwise boundary loop"};
    // Of a map with det J > 0 it is the area covered.
    if (total[c].sign() < 0) return {Injectivity::Violated, "a component is turned over"};
    if (total[c].sign() == 0) return {Injectivity::Undecided, "a component covers hardly any area"};
  }
  return {Injectivity::Proven, ""};
}

Finding check_nesting(const Boundary& boundary) {
  std::vector<const BoundaryLoop*> outer;
  Finding finding = find_outer_loops(boundary, outer);
  for (Index c = 0; c < boundary.components && finding.result == Injectivity::Proven; ++c) {
    const Vector2& p = boundary.curves[at(outer[at(c)]->first)].front();
    for (Index other = 0; other < boundary.components; ++other) {
      if (other == c) continue;
      const std::optional<long> turns = winding(boundary, other, p);
      if (turns && *turns == 0) continue;
      return {turns ? Injectivity::Violated : Injectivity::Undecided,
              fmt::format("one component {} inside another, near ({:.9g}, {:.9g})",
                          turns ? "lies" : "may lie", p.x(), p.y())};
    }
  }
  return finding;
}

}  // namespace

GlobalInjectivity check_boundary(const BezierMap& map) {
  GlobalInjectivity out;
  const Boundary boundary = boundary_of(map);
  if (!map.control_points().allFinite()) {
    out.reason = "control points are not finite";
    return out;
  }
  Contacts(boundary, out).find();
  std::stable_partition(out.contacts.begin(), out.contacts.end(),
                        [](const BoundaryContact& c) { return c.kind == Contact::Certain; });
  if (!out.contacts.empty()) {
    if (out.contacts.front().kind == Contact::Certain) {
      out.result = Injectivity::Violated;
      return out;
    }
    const Finding finding = find_double_cover(map, boundary, out.contacts);
    out.result = finding.result;
    out.reason = finding.reason;
    return out;
  }
  const Finding finding = check_nesting(boundary);
  out.result = finding.result;
  out.reason = finding.reason;
  return out;
}

}  // namespace majorant
