// Flips edges between Bezier triangles: the quadrilateral of two curved triangles gets its other
// diagonal.
//
//   BezierMesh mesh = bezier_mesh(3, space->faces(), space->cells(), x);
//   std::vector<char> is_fixed(mesh.opposite.size(), 0);
//   FlipCounts counts = make_delaunay(mesh, is_fixed);  // counts.performed <= counts.intended
//
// The quadrilateral's 4n outer control points are unchanged to the bit. Its (n-1)^2 inner ones are
// moved from where they are until both new triangles are proven injective. Angle sums at vertices
// do not change: if all four triangles have det J > 0, sectors add up to the same angle modulo 2
// pi, and each is below pi. [MC20] Sec. 6.1.
#pragma once

#include <vector>

#include "majorant/maps/bezier_map.h"

namespace majorant {

// Replaces the edge of `half_edge` by the other diagonal of its curved quadrilateral. The 4n outer
// control points stay; the (n-1)^2 inner ones minimize the moving log-barrier on the Bernstein
// coefficients of both new Jacobians (moving_barrier.h). Returns whether the flip was performed. A
// flip without certified positive values leaves the mesh unchanged. False also for boundary edges,
// if the new edge exists already, or if the straight-sided new triangles would not be positively
// oriented.
//
// `half_edge` and its opposite are the new edge afterwards, rotated counterclockwise. With a, b its
// ends and c, d the third corners, h1 = next(h), h2 = next(h1): before h: ab, bc, ca and o: ba, ad,
// db; after h: dc, ca, ad and o: cd, db, bc. The faces around a vertex must be one fan. Throws
// InvalidArgument for a degree outside 1..8 or a half-edge out of range.
bool flip_edge(BezierMesh& mesh, Index half_edge);

// Flips edges until the triangulation of the corner points is locally Delaunay. Edges with
// is_fixed[h] (3 #F, both sides; may be empty) and boundary edges stay. Quadrilaterals that are not
// strictly convex, or whose four points lie on a circle up to rounding, are not flipped. An edge
// whose flip failed is tried again only after its quadrilateral has changed. The flags follow their
// edges. Throws InvalidArgument for a wrong size of is_fixed or a degree outside 1..8.
FlipCounts make_delaunay(BezierMesh& mesh, std::vector<char>& is_fixed);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
