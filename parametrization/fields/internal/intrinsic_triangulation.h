// A triangulation of a surface by its vertices, given by edge lengths alone. Its edges can be
// flipped without changing the discrete conformal class, and a metric on it can be transferred back
// to the surface's own triangles.
//
// An edge that is not Delaunay with the lengths l e^{(u_a + u_b) / 2} is replaced by the other
// diagonal of its two triangles. The new length follows from Ptolemy's theorem, product of the
// diagonals = sum of the products of opposite sides, which holds for all u if it does for one. With
// Delaunay triangulations all angle sums that Gauss-Bonnet allows are possible [GSC21], [CCSZZ21],
// while triangles of a fixed triangulation may break.
//
// A flat metric on the flipped triangulation also gives every edge of the surface a vector: the sum
// of the vectors along any path of edges that can be deformed to it without passing a vertex. The
// surface's own triangles then close up and fit their neighbours up to rotation; some may be
// inverted.
//
// Half-edge 3 f + k runs from corner k of triangle f to its next, as in SurfaceMesh; a triangle may
// meet itself, and edges may join a vertex with itself.
#pragma once

#include <array>
#include <vector>

#include "majorant/framework/types.h"
#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// A triangle given by its side lengths.
struct TriangleShape {
  std::array<double, 3> angle{};      // radians, by corner; 0, 0, pi when broken
  std::array<double, 3> cotangent{};  // of the angles; all 0 when broken
  double log_area = 0;                // -inf when broken
  bool broken = false;                // the triangle inequality does not hold strictly
};
// Returns the shape. log_sides[k]: logarithm of the side opposite corner k, finite. Accurate to
// rounding of the sides, for needles and any size as well.
TriangleShape triangle_shape(const std::array<double, 3>& log_sides);

class IntrinsicTriangulation {
 public:
  explicit IntrinsicTriangulation(const SurfaceMesh& mesh);

  const Cells& faces() const { return faces_; }  // #F by 3
  Index face_count() const { return static_cast<Index>(faces_.rows()); }
  Index half_edge_count() const { return 3 * face_count(); }
  Index opposite(Index half_edge) const { return opposite_[half_edge]; }

  // Returns the 3 #F logarithms of the lengths of all half-edges with log factors u (#V). Both
  // sides of an edge have the same length up to rounding.
  Vec log_lengths(const Vec& log_factor) const;
  // Returns the shape of triangle f with such lengths.
  static TriangleShape shape(const Vec& log_lengths, Index f);
  // Returns whether the triangle inequality fails somewhere with these log factors.
  bool has_broken_triangles(const Vec& log_factor) const;

  // Flips edges until all inside are Delaunay with these log factors (#V). Then, up to rounding, no
  // triangle without an edge on the boundary is broken. Returns the number of flips.
  Index make_delaunay(const Vec& log_factor);

  // Returns the vectors (3 #F by 2) of the surface's half-edges, each triangle's in its own frame,
  // in the metric with these log factors. The vectors of a broken triangle are parallel and do not
  // close up.
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
