// A seamless map of degree 1 on a lattice of integers, on which its seams hold exactly, so that
// lines can be traced exactly.
//
//   SeamlessLattice lattice(*mesh, map);
//   const LatticePoint p = lattice.corner(12);      // the start of half-edge 12, in its own chart
//   const LatticePoint q = lattice.beyond(12, p);   // the same point in that of its opposite
//
// Every face has its own chart with integer corners. The free unknowns of the seam constraint are
// rounded to the lattice, and all others are integer combinations of them (constraints.h). The
// charts of two faces agree along their edge up to a rotation by a multiple of 90 degrees and an
// integer translation, c = i^k c' + t. On these integers it is proven that every face is positive,
// and that both ends of every edge agree. Around every inner vertex as many of the four axis
// directions lead into its faces as the map has quarter turns there. Edges of the border and of
// features lie along axes.
//
// If there are borders or features, the free unknowns get random offsets of some steps, as large as
// the proof allows. Then lines do not meet corners of the map by symmetry alone.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <vector>

#include "majorant/constraints/constraints.h"
#include "majorant/maps/bezier_map.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/quads/features.h"

namespace majorant {

__extension__ typedef __int128 WideInteger;

struct LatticePoint {
  std::int64_t u = 0, v = 0;
  auto operator<=>(const LatticePoint&) const = default;
};
inline LatticePoint operator+(LatticePoint a, LatticePoint b) { return {a.u + b.u, a.v + b.v}; }
inline LatticePoint operator-(LatticePoint a, LatticePoint b) { return {a.u - b.u, a.v - b.v}; }
inline LatticePoint operator*(std::int64_t s, LatticePoint a) { return {s * a.u, s * a.v}; }
inline WideInteger dot(LatticePoint a, LatticePoint b) {
  return WideInteger{a.u} * b.u + WideInteger{a.v} * b.v;
}
inline WideInteger cross(LatticePoint a, LatticePoint b) {
  return WideInteger{a.u} * b.v - WideInteger{a.v} * b.u;
}
inline int sign(WideInteger x) { return (x > 0) - (x < 0); }
// Returns 1 if c is to the left of the line from a to b, -1 if it is to the right, else 0.
inline int side(LatticePoint a, LatticePoint b, LatticePoint c) {
  return sign(cross(b - a, c - a));
}

// Returns the remainder of any integer number of quarter turns, 0 to 3.
inline int quarter(int turns) { return ((turns % 4) + 4) % 4; }
// Returns i^turns p.
LatticePoint turned(LatticePoint p, int turns);
// Returns the unit vector i^direction.
inline LatticePoint unit_vector(int direction) { return turned({1, 0}, direction); }

class SeamlessLattice {
 public:
  // surface: uncut; a face has at most one edge of the border or of features. map: of degree 1, of
  // the surface cut open along its seams, with the same faces. These edges lie along axes.
  // is_feature: 3 #F, both sides of inner edges; empty: none. The surface must outlive this. Throws
  // Error(Infeasible) if the rounded map is not proven. border_turn: angle of its corners
  // (border.h).
  SeamlessLattice(const SurfaceMesh& surface, const BezierMap& map,
                  std::vector<char> is_feature = {}, double border_turn = kCornerTurn);

  const SurfaceMesh& surface() const { return surface_; }
  double border_turn() const { return border_turn_; }
  // Returns a step of the lattice in model units.
  double unit() const { return unit_; }
  // Returns the sum of angles at a vertex in units of 90 degrees.
  int quarter_turns(Index vertex) const { return quarter_turns_[vertex]; }
  bool is_on_border(Index vertex) const { return surface_.opposite(leaving_[vertex]) < 0; }
  bool is_feature(Index half_edge) const { return !is_feature_.empty() && is_feature_[half_edge]; }
  const std::vector<char>& features() const { return is_feature_; }
  bool is_on_feature(Index vertex) const { return is_feature(leaving_[vertex]); }
  // Returns whether the vertex has other than four quarter turns, or two on the border.
  bool is_cone(Index vertex) const {
    return quarter_turns_[vertex] != (is_on_border(vertex) ? 2 : 4);
  }
  // Returns a half-edge that starts at the vertex, preferably on the border, else on a feature.
  Index leaving(Index vertex) const { return leaving_[vertex]; }
  // Returns the axis direction of an edge of the border or of a feature.
  int direction_of(Index half_edge) const;
  LatticePoint corner(Index half_edge) const { return corners_[half_edge]; }
  // Returns whether a point of a face's chart lies in the face or on its edges.
  bool contains(Index face, LatticePoint p) const;
  // The transition from the chart of a half-edge's face to that of the opposite one: p' = i^-turns
  // (p - t).
  int turns(Index half_edge) const { return turns_[half_edge]; }
  LatticePoint beyond(Index half_edge, LatticePoint p) const;
  int direction_beyond(Index half_edge, int direction) const {
    return quarter(direction - turns_[half_edge]);
  }
  // Returns twice the area of the map, in lattice units.
  WideInteger twice_area() const;

  // Moves a vertex that is no cone by a vector in the chart of its first face, in all charts; on
  // the border and inside of a feature along the line, by by.u. Throws Error(Infeasible) if a face
  // would not stay positive.
  void move(Index vertex, LatticePoint by);

 private:
  bool is_placed(const BezierMap& map, const std::vector<AlignedEdge>& held, int most);
  void place(const BezierMap& map, const std::vector<std::int64_t>& x);
  void count_turns_of_border();
  void prove() const;

  const SurfaceMesh& surface_;
  std::vector<char> is_feature_;  // by half-edge; may be empty
  double border_turn_;
  double unit_ = 1;
  std::vector<LatticePoint> corners_, shift_;  // by half-edge
  std::vector<int> turns_, quarter_turns_;     // by half-edge; by vertex
  std::vector<Index> leaving_;                 // by vertex
};

// Returns the axis directions that leave the corner at the start of a half-edge into its face or
// along the half-edge, counterclockwise, in the half-open angle from this half-edge to the previous
// one.
std::vector<int> leaving_directions(const SeamlessLattice& lattice, Index half_edge);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
