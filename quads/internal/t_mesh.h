// The motorcycle graph of a seamless map: the border, the features, and lines along the axes from
// all cones and corners of these, each as far as to the first line in its way [EGKT08]. It cuts the
// surface into patches that are rectangles in the map, with lines that end on their sides: a
// T-mesh.
//
//   SeamlessLattice lattice(*mesh, map);
//   const TMesh t_mesh = trace_t_mesh(lattice, stop);
//   const std::vector<Index> half_arcs = t_mesh.patches[0].sides[0];   // from corner 0 to corner 1
//
// Traced on the integers of the lattice, so every decision is exact: lines have one integer
// coordinate, and where two of them meet both are known. A line that would pass through a vertex,
// or meet another one on an edge, makes the lattice move a vertex by a few steps, and all is traced
// anew. Proven, in integers, for nodes V, arcs E and patches P of the surface M with the map f:
//     every patch p has four corners and opposite sides of equal lengths w_p, h_p,
//     sum_p w_p h_p = area(f(M)),   V - E + P = chi(M).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/quads/internal/seamless_lattice.h"

namespace majorant {

// A line passes a face in this direction; start: where its first point is in the face's chart.
struct LineLeg {
  Index face;
  int direction;
  LatticePoint start;

  LatticePoint at(std::int64_t distance) const { return start + distance * unit_vector(direction); }
};

// Where a line is.
enum class Side { Inside, Border, Feature };

// From a cone or corner to where it ends, on another line or in another of these. On the border,
// the surface on its left, and on a feature, as feature_lines() has it, from one to the next.
struct TraceLine {
  std::vector<LineLeg> legs;  // in order; every point of the line lies in the face of a leg
  std::int64_t length = 0;
  Side side = Side::Inside;
  std::vector<Index> arcs = {};  // from its start
};

struct TNode {
  Index vertex = -1;  // of the surface, of a cone or corner; -1: where a line ends on another
  int turns = 4;      // its angles add up to this many quarter turns
  Side side = Side::Inside;

  bool is_cone() const { return vertex >= 0 && turns != (side == Side::Border ? 2 : 4); }
};

// Half-arc 2 a runs along arc a as its line does, 2 a + 1 against it; on the border that has no
// patch.
struct TArc {
  Index line;
  std::int64_t begin, end;    // distances along the line
  std::array<Index, 2> node;  // there

  std::int64_t length() const { return end - begin; }
};
constexpr Index arc_of(Index half_arc) { return half_arc / 2; }
constexpr Index reversed(Index half_arc) { return half_arc ^ 1; }

// sides[k]: the half-arcs from its corner k to corner k + 1, counterclockwise, the patch on their
// left. width: of sides 0 and 2; height: of 1 and 3.
struct TPatch {
  std::array<std::vector<Index>, 4> sides;
  std::int64_t width = 0, height = 0;
};

struct TMesh {
  std::vector<TNode> nodes;
  std::vector<TArc> arcs;
  std::vector<TraceLine> lines;
  std::vector<TPatch> patches;

  Index from_node(Index half_arc) const { return arcs[arc_of(half_arc)].node[half_arc % 2]; }
  Index to_node(Index half_arc) const { return from_node(reversed(half_arc)); }
  bool is_on_border(Index arc) const { return lines[arcs[arc].line].side == Side::Border; }
  bool is_on_feature(Index arc) const { return lines[arcs[arc].line].side == Side::Feature; }
  bool is_held(Index arc) const { return lines[arcs[arc].line].side != Side::Inside; }
};

// Corners of the border are its cones and where it turns by kCornerTurn (border.h), those of
// features those of feature_lines() and where not two quarter turns are on both sides; a border or
// feature without any, and a closed surface without either, have their first vertex for one.
// Vertices of the lattice may be moved by a few steps. Throws Error(Infeasible) where lines could
// not be traced, or anything above does not hold; Stopped.
TMesh trace_t_mesh(SeamlessLattice& lattice, const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
