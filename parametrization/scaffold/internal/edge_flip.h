// Flips edges between Bezier triangles: the quadrilateral of two curved triangles gets its other
// diagonal.
//
//   BezierMesh mesh = bezier_mesh(3, space->faces(), space->cells(), x);
//   std::vector<char> is_fixed(mesh.opposite.size(), 0);
//   FlipCounts counts = make_delaunay(mesh, is_fixed);  // counts.performed <= counts.intended
//
// The quadrilateral's 4n outer control points stay as they are, bit by bit; its (n-1)^2 inner ones
// start where they are and are moved until both new triangles are proven injective. Angle sums at
// vertices do not change: where both triangles before and after have det J > 0, sectors add up to
// the same angle modulo 2 pi, and each is below pi. [MC20] Sec. 6.1.
#pragma once

#include <vector>

#include "majorant/maps/bezier_map.h"

namespace majorant {

// Replaces the edge of `half_edge` by the other diagonal of its curved quadrilateral: the 4n outer
// control points stay, the (n-1)^2 inner ones are found by minimizing the moving log-barrier on the
// Bernstein coefficients of both new Jacobians (moving_barrier.h). Returns whether it was done; a
// flip that finds no certified positive values is not performed and leaves the mesh unchanged.
// False also at boundary edges, where the new edge exists already, and where the straight-sided new
// triangles would not be positively oriented.
// `half_edge` and its opposite are the new edge afterwards, turned counterclockwise. With a, b its
// ends and c, d the third corners, h1 = next(h), h2 = next(h1): before h: ab, bc, ca and o: ba, ad,
// db; after h: dc, ca, ad and o: cd, db, bc. The faces around a vertex must be one fan. Throws
// InvalidArgument for a degree outside 1..8 or a half-edge that does not exist.
bool flip_edge(BezierMesh& mesh, Index half_edge);

// Flips edges, other than those with is_fixed[h] (3 #F, both sides; may be empty; the boundary is
// fixed anyway), until the triangulation of the corner points is locally Delaunay; flips of
// quadrilaterals that are not strictly convex are not intended, nor are those of four points on a
// circle up to rounding. An edge whose flip failed is tried again only when its quadrilateral
// changed. The flags follow their edges. Throws InvalidArgument for another size of is_fixed
// or a degree outside 1..8.
FlipCounts make_delaunay(BezierMesh& mesh, std::vector<char>& is_fixed);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
