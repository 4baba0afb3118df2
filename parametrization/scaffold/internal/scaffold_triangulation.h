// The scaffold: a triangulation of the space around a planar image. The image and its scaffold
// together fill a frame; while all their triangles keep a positive area and the frame stands still,
// the image cannot overlap itself ([MC20] Sec. 6).
//
//   Points2 square(4, 2);
//   square << 0, 0, 1, 0, 1, 1, 0, 1;                        // the image is on the left
//   const ScaffoldTriangulation scaffold = triangulate_scaffold({square});
//   scaffold.positions.topRows(4);                           // the square's corners
//   scaffold.faces;                                          // the triangles around it
//   scaffold.positions.row(scaffold.frame[0]);               // (-1, -1): one extent away
//
// The triangulation is constrained Delaunay, made with exact predicates, and refined by
// circumcentres of badly shaped triangles [Rup95] wherever they do not come close to an edge of
// boundary or frame [Che93]. Triangles are small at short boundary edges and grow away from them.
// The result depends on the boundary's points and edges only, not on where a loop starts.
#pragma once

#include <vector>

#include "majorant/framework/types.h"

namespace majorant {

struct ScaffoldOptions {
  // Distance of the frame from the image's bounding box, in larger extents of the box; positive.
  // As kMargin of scaffold.cpp, who sets it.
  double margin = 1.0;
  // Circumradius to shortest edge above which triangles are refined; at least 1. The others have
  // angles of at least arcsin(1 / (2 quality)): 19.5 degrees; a little above the root of 2
  // down to which refinement always ends [Rup95].
  double quality = 1.5;
};

struct ScaffoldTriangulation {
  Points2 positions;         // #V by 2: first the boundary points in the order given, then new ones
  Cells faces;               // #F by 3, counterclockwise; sorted, smallest vertex first
  std::vector<Index> frame;  // vertices of the outer frame, counterclockwise from its lower left
                             // corner: a rectangle with points on its sides
};

// loops: polygons of the image's boundary, each a list of positions (#P by 2, consecutive points
// are joined by straight edges), the image on the left: outer boundaries counterclockwise, holes
// clockwise; there may be several pieces, also inside holes. Points are numbered loop after loop.
// Triangulates everything inside the frame that is not image: the outside up to the frame, the
// insides of holes. The image's boundary edges are never split, so triangles at corners and in
// corridors that are narrow compared to them may stay bad.
// Throws Error(Infeasible) naming the two edges where boundary edges intersect or touch, or naming
// the loop when one has the image on its right; InvalidArgument for no loops, loops with
// fewer than 3 points, positions that are not finite, and options out of range.
ScaffoldTriangulation triangulate_scaffold(const std::vector<Points2>& loops,
                                           const ScaffoldOptions& = {});

// The ring between an old frame (#P by 2, a convex polygon, counterclockwise) and a new one around
// it, `margin` larger extents of the old frame away: for an image that has come close to its frame.
// positions: first the old frame's points in order, then new ones. Throws as triangulate_scaffold.
ScaffoldTriangulation enlarge_frame(const Points2& frame, double margin);

// Returns whether a point of the image (#P by 2: of Bezier triangles, the control points) is
// outside the frame (#P by 2, a convex polygon, counterclockwise) or closer to it than `clearance`
// times the smaller extent of its bounding box.
bool frame_is_tight(const Points2& frame, const Points2& image, double clearance);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
