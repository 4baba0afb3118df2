#include "majorant/mesh/incremental_delaunay.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "majorant/mesh/exact_predicates.h"

namespace majorant {
namespace {

// The number of points in the first round of insertions, and the growth of rounds.
constexpr std::size_t kFirstRound = 64, kRoundGrowth = 8;

constexpr int next_corner(int corner) { return corner == 2 ? 0 : corner + 1; }
constexpr int previous_corner(int corner) { return corner == 0 ? 2 : corner - 1; }

bool is_before(const Vector2& a, const Vector2& b) {
  return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
}

// A linear congruential generator.
std::uint32_t next_random(std::uint32_t& state) {
  state = state * 1664525 + 1013904223;
  return state >> 16;
}

// Sorts numbers of points along a Hilbert curve, by medians. `axis` comes first; both axes have a
// given direction.
void sort_along_curve(const std::vector<Vector2>& points, std::vector<Index>::iterator first,
                      std::vector<Index>::iterator last, int axis, bool is_up, bool other_is_up) {
  constexpr std::ptrdiff_t kUnsorted = 4;
  if (last - first <= kUnsorted) return;
  const auto halves = [&](auto from, auto to, int along, bool up) {
    const auto middle = from + (to - from) / 2;
    std::nth_element(from, middle, to, [&](Index a, Index b) {
      const double x = points[to_size(a)][along], y = points[to_size(b)][along];
      return up ? x < y : y < x;
    });
    return middle;
  };
  const int other = 1 - axis;
  const auto middle = halves(first, last, axis, is_up);
  const auto low = halves(first, middle, other, other_is_up);
  const auto high = halves(middle, last, other, !other_is_up);
  sort_along_curve(points, first, low, other, other_is_up, is_up);
  sort_along_curve(points, low, middle, axis, is_up, other_is_up);
  sort_along_curve(points, middle, high, axis, is_up, other_is_up);
  sort_along_curve(points, high, last, other, !other_is_up, !is_up);
}

// A biased randomized insertion order [ACR03]: random rounds of growing size, each along a curve.
std::vector<Index> insertion_order(const std::vector<Vector2>& points, Index first) {
  std::vector<Index> order(points.size() - to_size(first));
  std::iota(order.begin(), order.end(), first);
  std::uint32_t state = 1;
  for (std::size_t k = order.size(); k > 1; --k) {
    const std::uint64_t digits = (std::uint64_t{next_random(state)} << 16) | next_random(state);
    std::swap(order[k - 1], order[static_cast<std::size_t>((digits * k) >> 32)]);
  }
  for (std::size_t from = 0, size = kFirstRound; from < order.size(); size *= kRoundGrowth) {
    // A small last round joins the one before it.
    const std::size_t to = from + 2 * size < order.size() ? from + size : order.size();
    sort_along_curve(points, order.begin() + static_cast<std::ptrdiff_t>(from),
                     order.begin() + static_cast<std::ptrdiff_t>(to), 0, true, true);
    from = to;
  }
  return order;
}

// Does in_circle() as if each point were a little higher on the paraboloid than its lexicographic
// predecessors, so that none is on the circle. a, b, c must turn left.
bool is_in_circle(const Vector2& a, const Vector2& b, const Vector2& c, const Vector2& p) {
  if (const int sign = in_circle(a, b, c, p); sign != 0) return sign > 0;
  std::array<const Vector2*, 4> last_first = {&a, &b, &c, &p};
  std::sort(last_first.begin(), last_first.end(),
            [](const Vector2* left, const Vector2* right) { return is_before(*right, *left); });
  for (const Vector2* raised : last_first) {
    if (raised == &p) return false;
    const int sign = raised == &a   ? orientation(p, b, c)
                     : raised == &b ? orientation(a, p, c)
                                    : orientation(a, b, p);
    if (sign != 0) return sign > 0;
  }
  return false;
}

}  // namespace

Index IncrementalDelaunay::add_point(const Vector2& point) {
  points_.push_back(point);
  face_of_.push_back(-1);
  return static_cast<Index>(points_.size()) - 1;
}

std::vector<Index> IncrementalDelaunay::insert(const std::vector<Vector2>& points) {
  const Index first = static_cast<Index>(points_.size());
  points_.insert(points_.end(), points.begin(), points.end());
  face_of_.resize(points_.size(), -1);
  faces_.reserve(2 * points_.size());
  marks_.reserve(2 * points_.size());
  std::vector<Index> vertices(points.size());
  for (const Index v : insertion_order(points_, first))
    vertices[to_size(v - first)] = insert_near(v, recent_);
  return vertices;
}

// Inserts a vertex as long as all points are on one line and there are no faces.
Index IncrementalDelaunay::insert_flat(Index v) {
  const Vector2& p = points_[to_size(v)];
  const auto [place, is_new] = flat_.try_emplace({p.x(), p.y()}, v);
  if (!is_new) return place->second;
  ++vertex_count_;
  if (flat_.size() < 3) return v;
  const Index a = flat_.begin()->second, b = flat_.rbegin()->second;
  Index c = v;
  if (c == a || c == b) c = std::next(flat_.begin())->second;
  const int side = orientation(points_[to_size(a)], points_[to_size(b)], points_[to_size(c)]);
  if (side == 0) return v;
  const std::map<std::pair<double, double>, Index> line = std::move(flat_);
  flat_.clear();
  vertex_count_ = 3;
  if (side > 0)
    start(a, b, c);
  else
    start(b, a, c);
  for (const auto& [position, vertex] : line)
    if (vertex != a && vertex != b && vertex != c) insert_near(vertex, recent_);
  return v;
}

// Makes the first triangle, and a face beyond each of its edges.
void IncrementalDelaunay::start(Index a, Index b, Index c) {
  const Face inside = new_face(), beyond_a = new_face(), beyond_b = new_face(),
             beyond_c = new_face();
  set(inside, a, b, c);
  set(beyond_a, kInfinity, c, b);
  set(beyond_b, kInfinity, a, c);
  set(beyond_c, kInfinity, b, a);
  join(4 * inside, 4 * beyond_a, false);
  join(4 * inside + 1, 4 * beyond_b, false);
  join(4 * inside + 2, 4 * beyond_c, false);
  join(4 * beyond_a + 2, 4 * beyond_b + 1, false);
  join(4 * beyond_b + 2, 4 * beyond_c + 1, false);
  join(4 * beyond_c + 2, 4 * beyond_a + 1, false);
  recent_ = inside;
}

IncrementalDelaunay::Face IncrementalDelaunay::new_face() {
  faces_.emplace_back();
  marks_.emplace_back();
  return static_cast<Face>(faces_.size()) - 1;
}

void IncrementalDelaunay::set(Face f, Index a, Index b, Index c) {
  of(f).vertices = {a, b, c};
  for (const Index v : of(f).vertices) {
    if (v == kInfinity)
      infinite_ = f;
    else
      face_of_[to_size(v)] = f;
  }
}

void IncrementalDelaunay::join(Side a, Side b, bool is_constrained) {
  for (const auto& [side, other] : {std::pair(a, b), std::pair(b, a)}) {
    Triangle& face = of(side >> 2);
    const int corner = side & 3;
    face.across[static_cast<std::size_t>(corner)] = other;
    face.constrained = static_cast<std::uint8_t>((face.constrained & ~(1 << corner)) |
                                                 (static_cast<int>(is_constrained) << corner));
  }
}

void IncrementalDelaunay::constrain(Side side) {
  join(side, of(side >> 2).across[static_cast<std::size_t>(side & 3)], true);
}

bool IncrementalDelaunay::is_finite(Face f) const {
  const auto& v = of(f).vertices;
  return v[0] != kInfinity && v[1] != kInfinity && v[2] != kInfinity;
}

std::vector<IncrementalDelaunay::Face> IncrementalDelaunay::finite_faces() const {
  std::vector<Face> finite;
  finite.reserve(faces_.size());
  for (Face f = 0; f < static_cast<Face>(faces_.size()); ++f)
    if (is_finite(f)) finite.push_back(f);
  return finite;
}

// Returns the sides of edges that end at v, counterclockwise, each as the side opposite to the
// corner after v.
std::vector<IncrementalDelaunay::Side> IncrementalDelaunay::spokes(Index v) const {
  std::vector<Side> sides;
  const Face first = face_of_[to_size(v)];
  Face f = first;
  do {
    const auto& corners = of(f).vertices;
    const int corner = corners[0] == v ? 0 : corners[1] == v ? 1 : 2;
    sides.push_back(4 * f + next_corner(corner));
    f = neighbor(f, next_corner(corner));
  } while (f != first);
  return sides;
}

std::vector<IncrementalDelaunay::Face> IncrementalDelaunay::faces_around(Index v) const {
  std::vector<Face> around;
  for (const Side side : spokes(v)) around.push_back(side >> 2);
  return around;
}

std::optional<std::pair<IncrementalDelaunay::Face, int>> IncrementalDelaunay::find_edge(
    Index a, Index b) const {
  if (is_flat()) return {};
  for (const Side side : spokes(a)) {  // faces a, b, c
    const int opposite = next_corner(side & 3);
    if (vertex(side >> 2, side & 3) == b) return std::pair(side >> 2, opposite);
  }
  return {};
}

// Returns the face that contains p, and the corner whose opposite edge contains p, or 3; or else an
// outer face whose edge p lies beyond. Walks through edges that p lies beyond, in random order,
// since walks among constraints may otherwise run in circles.
std::pair<IncrementalDelaunay::Face, int> IncrementalDelaunay::locate(const Vector2& p,
                                                                      Face start) {
  Face f = start, before = -1;
  if (!is_finite(f)) {
    const auto& v = of(f).vertices;
    f = neighbor(f, v[0] == kInfinity ? 0 : v[1] == kInfinity ? 1 : 2);
  }
  while (true) {
    const Triangle& face = of(f);
    int on = 3;
    bool is_there = true;
    int corner = static_cast<int>(next_random(random_) % 3);
    for (int k = 0; k < 3; ++k, corner = next_corner(corner)) {
      const Face beyond = face.across[static_cast<std::size_t>(corner)] >> 2;
      if (beyond == before) continue;
      const int side =
          orientation(point(face.vertices[static_cast<std::size_t>(next_corner(corner))]),
                      point(face.vertices[static_cast<std::size_t>(previous_corner(corner))]), p);
      if (side < 0) {
        before = f;
        f = beyond;
        is_there = false;
        break;
      }
      // If p is on two edges, it is at the corner that is opposite to neither.
      if (side == 0) on = on == 3 ? corner : 4 + (3 - on - corner);
    }
    if (is_there || !is_finite(f)) return {f, is_there ? on : 3};
  }
}

Index IncrementalDelaunay::insert_near(Index v, Face start) {
  if (is_flat()) return insert_flat(v);
  const auto [face, on] = locate(point(v), start);
  recent_ = face;
  if (on > 3) return vertex(face, on - 4);
  ++vertex_count_;
  if (on == 3)
    split_face(face, v);
  else
    split_edge(4 * face + on, v);
  restore_around(v);
  recent_ = face_of_[to_size(v)];
  return v;
}

void IncrementalDelaunay::split_face(Face f, Index v) {
  const Triangle old = of(f);
  const Face g = new_face(), h = new_face();
  const auto& [a, b, c] = old.vertices;
  const std::array<Face, 3> faces = {f, g, h};
  set(f, v, b, c);
  set(g, v, c, a);
  set(h, v, a, b);
  for (int k = 0; k < 3; ++k) {
    join(4 * faces[static_cast<std::size_t>(k)], old.across[static_cast<std::size_t>(k)],
         (old.constrained >> k) & 1);
    join(4 * faces[static_cast<std::size_t>(k)] + 1,
         4 * faces[static_cast<std::size_t>(next_corner(k))] + 2, false);
  }
  changed_.assign(faces.begin(), faces.end());
}

// Connects both corners opposite to the edge qr, of faces (p, q, r) and (s, r, q), to v on qr.
void IncrementalDelaunay::split_edge(Side side, Index v) {
  const Face f = side >> 2;
  const int i = side & 3;
  const Triangle old = of(f);
  const Side other = old.across[static_cast<std::size_t>(i)];
  const Face g = other >> 2;
  const int j = other & 3;
  const Triangle beyond = of(g);
  const auto at = [](const auto& list, int corner) {
    return list[static_cast<std::size_t>(corner)];
  };
  const Index p = at(old.vertices, i), q = at(old.vertices, next_corner(i)),
              r = at(old.vertices, previous_corner(i)), s = at(beyond.vertices, j);
  const bool is_constrained = (old.constrained >> i) & 1;
  const Face f2 = new_face(), g2 = new_face();
  set(f, v, p, q);
  set(f2, v, r, p);
  set(g, v, s, r);
  set(g2, v, q, s);
  join(4 * f, at(old.across, previous_corner(i)), (old.constrained >> previous_corner(i)) & 1);
  join(4 * f2, at(old.across, next_corner(i)), (old.constrained >> next_corner(i)) & 1);
  join(4 * g, at(beyond.across, previous_corner(j)),
       (beyond.constrained >> previous_corner(j)) & 1);
  join(4 * g2, at(beyond.across, next_corner(j)), (beyond.constrained >> next_corner(j)) & 1);
  join(4 * f + 2, 4 * f2 + 1, false);           // vp
  join(4 * f2 + 2, 4 * g + 1, is_constrained);  // vr
  join(4 * g + 2, 4 * g2 + 1, false);           // vs
  join(4 * g2 + 2, 4 * f + 1, is_constrained);  // vq
  changed_ = {f, f2, g, g2};
}

bool IncrementalDelaunay::circle_holds(const Triangle& f, Index v) const {
  const auto& [a, b, c] = f.vertices;
  if (a == kInfinity) return orientation(point(b), point(c), point(v)) > 0;
  if (b == kInfinity) return orientation(point(c), point(a), point(v)) > 0;
  if (c == kInfinity) return orientation(point(a), point(b), point(v)) > 0;
  return is_in_circle(point(a), point(b), point(c), point(v));
}

// Flips edges opposite to v as long as v is in the circle of a face beyond them.
void IncrementalDelaunay::restore_around(Index v) {
  while (!changed_.empty()) {
    const Face f = changed_.back();
    const Triangle face = of(f);
    const Side other = face.across[0];
    const Face g = other >> 2;
    const std::size_t j = static_cast<std::size_t>(other & 3);
    if ((face.constrained & 1) || !circle_holds(of(g), v)) {
      changed_.pop_back();
      continue;
    }
    // (v, b, c) and (d, c, b) become (v, b, d) and (v, d, c).
    const Triangle beyond = of(g);
    const Index b = face.vertices[1], c = face.vertices[2], d = beyond.vertices[j];
    const auto corner = [&](int step) { return (j + static_cast<std::size_t>(step)) % 3; };
    const Side bd = beyond.across[corner(1)], dc = beyond.across[corner(2)];
    const bool bd_is = (beyond.constrained >> corner(1)) & 1,
               dc_is = (beyond.constrained >> corner(2)) & 1;
    const Side cv = face.across[1];
    const bool cv_is = (face.constrained >> 1) & 1;
    set(f, v, b, d);
    set(g, v, d, c);
    join(4 * f, bd, bd_is);
    join(4 * g, dc, dc_is);
    join(4 * g + 1, cv, cv_is);
    join(4 * f + 1, 4 * g + 2, false);
    changed_.push_back(g);
  }
}

// One side of a constraint that crosses faces: the outer boundary of these faces, from one end of
// the constraint to the other.
struct IncrementalDelaunay::Chain {
  std::vector<Index> vertices;
  // By edge: its side within the crossed faces, the side beyond it, and whether it is constrained.
  std::vector<Side> inner, outer;
  std::vector<char> is_constrained;

  void add(Index v, Side side, const Triangle& face) {
    vertices.push_back(v);
    inner.push_back(side);
    outer.push_back(face.across[static_cast<std::size_t>(side & 3)]);
    is_constrained.push_back((face.constrained >> (side & 3)) & 1);
  }
  void reverse() {
    std::reverse(vertices.begin(), vertices.end());
    std::reverse(inner.begin(), inner.end());
    std::reverse(outer.begin(), outer.end());
    std::reverse(is_constrained.begin(), is_constrained.end());
  }
};

bool IncrementalDelaunay::insert_constraint(Index a, Index b) {
  if (is_flat()) throw std::logic_error("insert_constraint: all points are on one line");
  while (a != b) {
    const std::optional<Index> reached = insert_piece(a, b);
    if (!reached) return false;
    a = *reached;
  }
  return true;
}

// Inserts the part of ab from a to the first vertex on it and returns that vertex; none if another
// constraint crosses or covers that part.
std::optional<Index> IncrementalDelaunay::insert_piece(Index a, Index b) {
  const Vector2 &from = point(a), &to = point(b);
  const auto side_of = [&](Index v) {
    return v == kInfinity ? 0 : orientation(from, to, point(v));
  };
  const std::vector<Side> around = spokes(a);
  int right = side_of(vertex(around[0] >> 2, around[0] & 3));
  for (const Side side : around) {  // faces (a, q, r)
    const Face f = side >> 2;
    const int at_q = side & 3, at_r = next_corner(at_q);
    const Index q = vertex(f, at_q);
    const bool is_on_it =
        q != kInfinity && right == 0 && is_before(from, to) == is_before(from, point(q));
    if (is_on_it) {
      if (is_constrained(f, at_r)) return {};
      constrain(4 * f + at_r);
      return q;
    }
    const int left = side_of(vertex(f, at_r));
    if (right < 0 && left > 0) return cut_through(4 * f + previous_corner(at_q), a, b);
    right = left;
  }
  throw std::logic_error("insert_constraint: no face around a vertex is towards another one");
}

// Does so if ab leaves a through the side `first`. The crossed faces are replaced. On either side
// of ab they fill a polygon, all of whose vertices are visible from ab.
std::optional<Index> IncrementalDelaunay::cut_through(Side first, Index a, Index b) {
  const Vector2 &from = point(a), &to = point(b);
  std::vector<Face> crossed;
  Chain left, right;  // from a
  left.vertices = right.vertices = {a};
  const Face start = first >> 2;
  const int at_a = first & 3;
  right.add(vertex(start, next_corner(at_a)), 4 * start + previous_corner(at_a), of(start));
  left.add(vertex(start, previous_corner(at_a)), 4 * start + next_corner(at_a), of(start));
  crossed.push_back(start);
  Side side = first;
  Index end = b;
  while (true) {
    const Triangle& before = of(side >> 2);
    if ((before.constrained >> (side & 3)) & 1) return {};
    const Side entered = before.across[static_cast<std::size_t>(side & 3)];
    const Face f = entered >> 2;
    const int corner = entered & 3;
    // The face (d, l, r) is entered through lr.
    crossed.push_back(f);
    const Index d = vertex(f, corner);
    const Side left_side = 4 * f + previous_corner(corner),
               right_side = 4 * f + next_corner(corner);
    const int turn = d == b ? 0 : orientation(from, to, point(d));
    if (turn >= 0) left.add(d, left_side, of(f));
    if (turn <= 0) right.add(d, right_side, of(f));
    if (turn == 0) {
      end = d;
      break;
    }
    side = turn > 0 ? right_side : left_side;
  }
  for (const Face f : crossed) of(f).is_crossed = true;
  right.reverse();
  for (Chain* chain : {&left, &right}) match_inner_edges(*chain);
  std::vector<Face> free = crossed;
  const Side on_the_left = fill(left, free), on_the_right = fill(right, free);
  join(on_the_left, on_the_right, true);
  return end;
}

// Edges between two crossed faces occur twice in a chain, nested. Their `outer` becomes -1 minus
// the place of the other occurrence.
void IncrementalDelaunay::match_inner_edges(Chain& chain) const {
  std::vector<std::size_t> open;
  for (std::size_t k = 0; k < chain.outer.size(); ++k) {
    if (!of(chain.outer[k] >> 2).is_crossed) continue;
    if (!open.empty() && chain.inner[open.back()] == chain.outer[k]) {
      chain.outer[k] = -1 - static_cast<Side>(open.back());
      chain.outer[open.back()] = -1 - static_cast<Side>(k);
      open.pop_back();
    } else {
      open.push_back(k);
    }
  }
}

// Triangulates the polygon of a chain and the edge from its first to its last vertex, and returns
// the side of that edge. The circle of the triangle at an edge contains no vertex of the polygon.
IncrementalDelaunay::Side IncrementalDelaunay::fill(Chain& chain, std::vector<Face>& free) {
  constexpr Side kNone = -1;
  struct Part {
    std::size_t from, to;
    Side base;
  };
  Side result = kNone;
  std::fill(chain.inner.begin(), chain.inner.end(), kNone);
  std::vector<Part> parts = {{0, chain.outer.size(), kNone}};
  while (!parts.empty()) {
    const auto [from, to, base] = parts.back();
    parts.pop_back();
    if (to == from + 1) {
      const Side outer = chain.outer[from];
      if (outer >= 0) {
        join(base, outer, chain.is_constrained[from]);
      } else if (const Side other = chain.inner[static_cast<std::size_t>(-1 - outer)]; other >= 0) {
        join(base, other, chain.is_constrained[from]);
      } else {
        chain.inner[from] = base;
      }
      continue;
    }
    const Index a = chain.vertices[from], b = chain.vertices[to];
    std::size_t best = from + 1;
    for (std::size_t k = from + 2; k < to; ++k) {
      const Index c = chain.vertices[best], v = chain.vertices[k];
      if (v != a && v != b && v != c && is_in_circle(point(a), point(b), point(c), point(v)))
        best = k;
    }
    const Face f = free.back();
    free.pop_back();
    of(f).is_crossed = false;
    of(f).constrained = 0;
    marks_[static_cast<std::size_t>(f)] = {};
    set(f, a, b, chain.vertices[best]);
    if (base == kNone)
      result = 4 * f + 2;
    else
      join(base, 4 * f + 2, false);
    parts.push_back({best, to, 4 * f});
    parts.push_back({from, best, 4 * f + 1});
  }
  return result;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
