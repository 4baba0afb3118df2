// The constrained Delaunay triangulation of points in the plane, by insertion of points and flips
// [Law77]. Signs are exact (exact_predicates.h), so any finite points are valid.
//
//   IncrementalDelaunay delaunay;
//   const std::vector<Index> v = delaunay.insert(std::vector<Vector2>{{0, 0}, {1, 0}, {1, 1}});
//   delaunay.insert_constraint(v[0], v[2]);
//   for (const auto face : delaunay.finite_faces()) delaunay.vertex(face, 0);
//
// constrained_delaunay.h documents the members. The result does not depend on the order of
// insertions, even if four points are on a circle: ties are broken as if each point were a little
// higher on the paraboloid than its lexicographic predecessors [DT11].
//
// It is one class, since insertion, constraints and flips all change the same neighbours of faces.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "majorant/framework/types.h"

namespace majorant {

// The marks of an algorithm on a face; 0 on new faces.
struct FaceMark {
  int region = 0;
  Index visit = 0;
};

class IncrementalDelaunay {
 public:
  using Face = std::int32_t;

  std::vector<Index> insert(const std::vector<Vector2>& points);
  Index insert(const Vector2& point) { return insert_near(add_point(point), recent_); }
  Index insert(const Vector2& point, Face in) { return insert_near(add_point(point), in); }
  bool insert_constraint(Index a, Index b);

  Index vertex_count() const { return vertex_count_; }
  bool is_flat() const { return faces_.empty(); }
  const Vector2& point(Index vertex) const { return points_[to_size(vertex)]; }
  std::optional<std::pair<Face, int>> find_edge(Index a, Index b) const;

  std::vector<Face> finite_faces() const;
  Face infinite_face() const { return infinite_; }
  std::vector<Face> faces_around(Index vertex) const;
  bool is_finite(Face f) const;
  Index vertex(Face f, int i) const { return of(f).vertices[static_cast<std::size_t>(i)]; }
  Face neighbor(Face f, int i) const { return of(f).across[static_cast<std::size_t>(i)] >> 2; }
  bool is_constrained(Face f, int i) const { return (of(f).constrained >> i) & 1; }
  FaceMark& mark(Face f) { return marks_[static_cast<std::size_t>(f)]; }
  const FaceMark& mark(Face f) const { return marks_[static_cast<std::size_t>(f)]; }

 private:
  // A side of a face: 4 times the face plus the number of the opposite corner.
  using Side = std::int32_t;
  struct Triangle {
    std::array<Index, 3> vertices;  // counterclockwise; kInfinity: the half-plane beyond an edge
    std::array<Side, 3> across;     // the same edges, as sides of the neighbours
    std::uint8_t constrained = 0;   // a bit for each edge
    bool is_crossed = false;        // by the constraint that is being inserted
  };
  struct Chain;
  static constexpr Index kInfinity = -1;

  const Triangle& of(Face f) const { return faces_[static_cast<std::size_t>(f)]; }
  Triangle& of(Face f) { return faces_[static_cast<std::size_t>(f)]; }

  Index add_point(const Vector2& point);
  Index insert_near(Index v, Face start);
  Index insert_flat(Index v);
  void start(Index a, Index b, Index c);
  Face new_face();
  void set(Face f, Index a, Index b, Index c);
  void join(Side a, Side b, bool is_constrained);
  void constrain(Side side);
  void split_face(Face f, Index v);
  void split_edge(Side side, Index v);
  void restore_around(Index v);
  bool circle_holds(const Triangle& f, Index v) const;
  std::pair<Face, int> locate(const Vector2& p, Face start);
  std::vector<Side> spokes(Index v) const;
  std::optional<Index> insert_piece(Index a, Index b);
  std::optional<Index> cut_through(Side first, Index a, Index b);
  void match_inner_edges(Chain& chain) const;
  Side fill(Chain& chain, std::vector<Face>& free);

  std::vector<Vector2> points_;
  std::vector<Face> face_of_;  // by vertex, one of the faces around it
  std::vector<Triangle> faces_;
  std::vector<FaceMark> marks_;
  std::vector<Face> changed_;                        // around a new vertex, the vertex first
  std::map<std::pair<double, double>, Index> flat_;  // the vertices, as long as there are no faces
  Index vertex_count_ = 0;
  Face recent_ = 0, infinite_ = 0;
  std::uint32_t random_ = 1;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
