// The constrained Delaunay triangulation of points in the plane: that of CGAL, or, without
// MAJORANT_GPL, that of this library. Both have the same members and the same faces; for four
// points on a circle both decide as incremental_delaunay.h says.
//
//     ConstrainedDelaunay delaunay;
//     const std::vector<Index> v = delaunay.insert(std::vector<Vector2>{{0, 0}, {1, 0}, {1, 1}});
//     if (delaunay.insert_constraint(v[0], v[2])) ...
//     for (const auto face : delaunay.finite_faces()) ...   delaunay.vertex(face, 0)
//
// Vertices are numbered in the order in which their points were inserted. Faces are handles, which
// stay valid; a triangle stays the same until an insertion changes it. Corner i of a face is
// opposite to its edge i, and the corners run counterclockwise.
//
// For .cpp files that are compiled with -frounding-math where CGAL is used; not installed.
#pragma once

#include <concepts>
#include <optional>
#include <utility>
#include <vector>

#include "majorant/framework/types.h"
#ifdef MAJORANT_HAS_CGAL
#include "majorant/mesh/cgal_delaunay.h"
#endif
#include "majorant/mesh/incremental_delaunay.h"

namespace majorant {

// The members of a triangulation `t`; from vertex_count() on they are const.
template <class T>
concept PlaneTriangulation = requires(T& t, const T& c, typename T::Face face, Index vertex, int i,
                                      const Vector2& point, const std::vector<Vector2>& points) {
  // Inserts finite points and returns the vertex of each; coinciding points share one. A vertex has
  // the number of its point, counted through all insertions.
  { t.insert(points) } -> std::same_as<std::vector<Index>>;
  // Inserts one point and returns its vertex. The search begins at the last point, or at the given
  // face. The point must not lie on a constraint.
  { t.insert(point) } -> std::same_as<Index>;
  { t.insert(point, face) } -> std::same_as<Index>;
  // Inserts the segment between two vertices, in pieces if it passes other vertices. Returns false,
  // with some of the pieces inserted, if another constraint crosses or covers a piece. Not for flat
  // triangulations.
  { t.insert_constraint(vertex, vertex) } -> std::same_as<bool>;
  // Returns the marks of a face. They are 0 on new faces and undefined on changed faces.
  { t.mark(face) } -> std::same_as<FaceMark&>;
  { c.mark(face) } -> std::same_as<const FaceMark&>;

  { c.vertex_count() } -> std::same_as<Index>;
  // Returns whether all points are on one line, so that there are no faces.
  { c.is_flat() } -> std::same_as<bool>;
  { c.point(vertex) } -> std::same_as<const Vector2&>;
  // Returns the face to the left of the edge from one vertex to another, and its corner opposite to
  // the edge; none if there is no such edge.
  { c.find_edge(vertex, vertex) } -> std::same_as<std::optional<std::pair<typename T::Face, int>>>;
  { c.finite_faces() } -> std::same_as<std::vector<typename T::Face>>;
  { c.faces_around(vertex) } -> std::same_as<std::vector<typename T::Face>>;
  // Returns an infinite face. There is one beyond each edge of the convex hull; its vertex -1 has
  // no point.
  { c.infinite_face() } -> std::same_as<typename T::Face>;
  { c.is_finite(face) } -> std::same_as<bool>;
  { c.vertex(face, i) } -> std::same_as<Index>;
  { c.neighbor(face, i) } -> std::same_as<typename T::Face>;
  { c.is_constrained(face, i) } -> std::same_as<bool>;
};

#ifdef MAJORANT_HAS_CGAL
using ConstrainedDelaunay = CgalDelaunay;
#else
using ConstrainedDelaunay = IncrementalDelaunay;
#endif
static_assert(PlaneTriangulation<ConstrainedDelaunay>);
static_assert(PlaneTriangulation<IncrementalDelaunay>);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
