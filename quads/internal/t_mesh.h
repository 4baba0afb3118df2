// The motorcycle graph of a seamless map: the border, the features, and lines along the axes from
// all cones and corners, each up to the first line in its way [EGKT08]. It cuts the surface into
// patches that are rectangles in the map, with lines that may end on their sides: a T-mesh.
//
//   SeamlessLattice lattice(*mesh, map);
//   const TMesh t_mesh = trace_t_mesh(lattice, stop);
//   const std::vector<Index> half_arcs = t_mesh.patches[0].sides[0];   // from corner 0 to corner 1
//
// Lines are traced on the integers of the lattice, so that every decision is exact: a line has one
// integer coordinate, and where two lines meet both coordinates are known. If a line would pass
// through a vertex, or meet another one on an edge, the lattice moves a vertex by a few steps, and
// all lines are traced again. The following is proven in integers, for nodes V, arcs E and patches
// P of the surface M with the map f:
//     every patch p has four corners and opposite sides of equal lengths w_p, h_p,
//     sum_p w_p h_p = area(f(M)),   V - E + P = chi(M).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/quads/internal/seamless_lattice.h"

namespace majorant {

// A line crosses a face in this direction; start: its first point in the face's chart.
struct LineLeg {
  Index face;
  int direction;
  LatticePoint start;

  LatticePoint at(std::int64_t distance) const { return start + distance * unit_vector(direction); }
};

// The place of a line.
enum class Side { Inside, Border, Feature };

// A line from a cone or corner to its end, on another line or in a cone or corner. Lines of the
// border have the surface on their left; lines of features follow feature_lines(). Both go from one
// cone or corner to the next.
struct TraceLine {
  std::vector<LineLeg> legs;  // in order; every point of the line is in the face of a leg
  std::int64_t length = 0;
  Side side = Side::Inside;
  std::vector<Index> arcs = {};  // from its start
};

struct TNode {
  Index vertex = -1;  // a cone or corner of the surface; -1: the end of a line on another
  int turns = 4;      // sum of its angles in quarter turns
  Side side = Side::Inside;

  bool is_cone() const { return vertex >= 0 && turns != (side == Side::Border ? 2 : 4); }
};

// An arc. Half-arc 2 a runs along arc a in the direction of its line, 2 a + 1 against it; on the
// border 2 a + 1 has no patch.
struct TArc {
  Index line;
  std::int64_t begin, end;    // distances along the line
  std::array<Index, 2> node;  // at begin and end

  std::int64_t length() const { return end - begin; }
};
constexpr Index arc_of(Index half_arc) { return half_arc / 2; }
constexpr Index reversed(Index half_arc) { return half_arc ^ 1; }

// A patch. sides[k]: the half-arcs from corner k to corner k + 1, counterclockwise, with the patch
// on their left. width: of sides 0 and 2; height: of sides 1 and 3.
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

// Traces the T-mesh. Corners of the border are its cones and vertices where it turns by kCornerTurn
// (border.h). Corners of features are those of feature_lines() and vertices without two quarter
// turns on both sides. A border or feature without any corner, and a closed surface without either,
// get their first vertex as corner. Vertices of the lattice may be moved by a few steps. Throws
// Error(Infeasible) if lines could not be traced or a statement above does not hold; Stopped.
TMesh trace_t_mesh(SeamlessLattice& lattice, const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
