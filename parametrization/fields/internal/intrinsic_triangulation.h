// A triangulation of a surface by its vertices, known by edge lengths alone, whose edges can be
// flipped without changing the discrete conformal class; and the way back to the surface's own
// triangles.
//
// An edge that is not Delaunay with the lengths l e^{(u_a + u_b) / 2} gives way to the other
// diagonal of the two triangles there. The new length follows from Ptolemy's theorem, product of
// the diagonals = sum of the products of opposite sides, which holds for all u if it does for one.
// On Delaunay triangulations so related every angle sum can be had that Gauss-Bonnet allows
// [GSC21], [CCSZZ21], while on a fixed one triangles may break.
//
// A flat metric on the flipped triangulation gives every edge of the surface a vector too: the sum
// of the vectors along any path of edges that can be deformed to it without passing a vertex. The
// surface's own triangles then close up and fit their neighbours up to rotation; some may be turned
// over.
//
// Half-edge 3 f + k runs from corner k of triangle f to its next, as in SurfaceMesh; a triangle may
// meet itself, and edges may join a vertex with itself.
#pragma once

#include <array>
#include <vector>

#include "majorant/framework/types.h"
#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// A triangle of which only the sides are known.
struct TriangleShape {
  std::array<double, 3> angle{};      // radians, by corner; 0, 0, pi when broken
  std::array<double, 3> cotangent{};  // of the angles; all 0 when broken
  double log_area = 0;                // -inf when broken
  bool broken = false;                // the triangle inequality does not hold strictly
};
// log_sides[k]: logarithm of the side opposite corner k, finite. Accurate to rounding of the sides
// for needles as well, whatever their size.
TriangleShape triangle_shape(const std::array<double, 3>& log_sides);

class IntrinsicTriangulation {
 public:
  explicit IntrinsicTriangulation(const SurfaceMesh& mesh);

  const Cells& faces() const { return faces_; }  // #F by 3
  Index face_count() const { return static_cast<Index>(faces_.rows()); }
  Index half_edge_count() const { return 3 * face_count(); }
  Index opposite(Index half_edge) const { return opposite_[half_edge]; }

  // 3 #F logarithms of the lengths of all half-edges with log factors u (#V), and the shape of
  // triangle f with such lengths. Both sides of an edge have the same length to rounding.
  Vec log_lengths(const Vec& log_factor) const;
  static TriangleShape shape(const Vec& log_lengths, Index f);
  // Returns whether the triangle inequality fails somewhere with these log factors.
  bool has_broken_triangles(const Vec& log_factor) const;

  // Flips edges until all inside are Delaunay with these log factors (#V); then, but for rounding,
  // no triangle without an edge on the boundary is broken. Returns the number of flips.
  Index make_delaunay(const Vec& log_factor);

  // The vectors (3 #F by 2) of the surface's half-edges, each triangle's in a frame of its own, in
  // the metric with these log factors. Those of a broken triangle are parallel and do not close up.
  Points2 surface_vectors(const Vec& log_factor) const;

 private:
  struct Flip {
    Index here, there;  // both sides of the edge
  };
  double log_length(const Vec& log_factor, Index half_edge) const;
  bool is_delaunay(const Vec& log_lengths, Index half_edge) const;
  void flip(Index half_edge);

  Cells faces_;
  std::vector<Index> opposite_;
  Vec log_lengths_;  // without log factors
  std::vector<Flip> flips_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
