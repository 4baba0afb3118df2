// The scaffold: a triangulation of the space around a planar image, up to a frame. The image cannot
// overlap itself as long as all triangles of both keep a positive area and the frame stays fixed
// ([MC20] Sec. 6).
//
//   Points2 square(4, 2);
//   square << 0, 0, 1, 0, 1, 1, 0, 1;                        // the image is on the left
//   const ScaffoldTriangulation scaffold = triangulate_scaffold({square});
//   scaffold.positions.topRows(4);                           // the square's corners
//   scaffold.faces;                                          // the triangles around it
//   scaffold.positions.row(scaffold.frame[0]);               // (-1, -1): one extent away
//
// The triangulation is constrained Delaunay, computed with exact predicates. It is refined by
// circumcentres of badly shaped triangles [Rup95] that are not close to an edge of boundary or
// frame [Che93]. Triangles are small at short boundary edges and grow away from them. The result
// depends on the boundary's points and edges only, not on where a loop starts.
#pragma once

#include <vector>

#include "majorant/framework/types.h"

namespace majorant {

struct ScaffoldOptions {
  // Distance of the frame from the image's bounding box, relative to the larger extent of the box;
  // positive. scaffold.cpp sets it to kMargin.
  double margin = 1.0;
  // Triangles are refined above this ratio of circumradius to shortest edge; at least 1. The others
  // have angles of at least arcsin(1 / (2 quality)): 19.5 degrees. The default is a little above
  // sqrt(2), down to which refinement always terminates [Rup95].
  double quality = 1.5;
};

struct ScaffoldTriangulation {
  Points2 positions;         // #V by 2: the boundary points in the given order, then new ones
  Cells faces;               // #F by 3, counterclockwise; smallest vertex first, sorted
  std::vector<Index> frame;  // vertices of the outer frame, counterclockwise from its lower left
                             // corner: a rectangle with points on its sides
};

// Triangulates everything inside the frame that is not image: the outside up to the frame and the
// insides of holes. The image's boundary edges are never split, so triangles at corners, and in
// corridors narrower than the edges, may stay bad.
//
// loops: polygons of the image's boundary, each a list of positions (#P by 2; consecutive points
// are joined by straight edges). The image lies on the left: outer boundaries run counterclockwise,
// holes clockwise. There may be several pieces, also inside holes. Points are numbered loop after
// loop.
//
// Throws Error(Infeasible) naming the two edges where boundary edges intersect or touch, or naming
// a loop that has the image on its right. Throws InvalidArgument for no loops, loops with fewer
// than 3 points, positions that are not finite, and options out of range.
ScaffoldTriangulation triangulate_scaffold(const std::vector<Points2>& loops,
                                           const ScaffoldOptions& = {});

// Triangulates the ring between an old frame (#P by 2, a convex polygon, counterclockwise) and a
// new one around it, `margin` larger extents of the old frame away. Used when an image has come
// close to its frame. positions: the old frame's points in order, then new ones. Throws the errors
// of triangulate_scaffold().
ScaffoldTriangulation enlarge_frame(const Points2& frame, double margin);

// Returns whether a point of the image lies outside the frame, or closer to it than `clearance`
// times the smaller extent of the frame's bounding box. The frame is a convex polygon,
// counterclockwise. Both are #P by 2. The points of an image of Bezier triangles are its control
// points.
bool frame_is_tight(const Points2& frame, const Points2& image, double clearance);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
