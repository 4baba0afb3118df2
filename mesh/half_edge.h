// Half-edges of oriented triangles, as numbers: the words that all code on triangles shares.
//
// Half-edge 3 f + k runs along face f from its corner k to its corner k + 1 (mod 3), the face on
// its left; face and corner are counted from 0.
//
//                c 2                   next(3 f) = 3 f + 1, previous(3 f) = 3 f + 2: around the
//                /\                    *face*, counterclockwise.
//     3 f + 2   /  \   3 f + 1         opposite[3 f] is the half-edge b -> a of the face below,
//              /  f \                  -1 where there is none.
//         a 0 -------- b 1
//               3 f
//
// Around a *vertex* one goes by both: from the half-edge h that leaves it, opposite[previous(h)] is
// the next one that leaves it counterclockwise, next(opposite[h]) clockwise.
//
// Nothing here knows of positions. Of a SurfaceMesh, which has opposites and boundary loops ready,
// ask the mesh.
#pragma once

#include <vector>

#include "majorant/framework/types.h"

namespace majorant {

constexpr Index face_of(Index half_edge) { return half_edge / 3; }
constexpr Index corner_of(Index half_edge) { return half_edge % 3; }  // where it starts

constexpr Index next(Index half_edge) { return half_edge % 3 == 2 ? half_edge - 2 : half_edge + 1; }
constexpr Index previous(Index half_edge) {
  return half_edge % 3 == 0 ? half_edge + 2 : half_edge - 1;
}

// faces: #F by 3 vertices.
inline Index from_vertex(const Cells& faces, Index half_edge) {
  return faces(face_of(half_edge), corner_of(half_edge));
}
inline Index to_vertex(const Cells& faces, Index half_edge) {
  return from_vertex(faces, next(half_edge));
}

// For every half-edge the one of the neighbouring face along the same edge, -1 at the boundary
// (3 #F). faces: #F by 3, consistently oriented. Throws InvalidArgument when an edge has more
// than two faces or two that run the same way. O(n log n).
std::vector<Index> opposite_half_edges(const Cells& faces);

// The boundary as loops of half-edges, each of which starts where the one before it ends, the
// surface on the left. A loop starts at its smallest vertex, loops are ordered by that vertex. One
// fan of faces at every vertex: see find_touching_vertex.
std::vector<std::vector<Index>> boundary_half_edges(const Cells& faces,
                                                    const std::vector<Index>& opposite);

// For every face the number of its connected component (across edges), counted in the order of
// their first faces.
std::vector<Index> face_components(const std::vector<Index>& opposite);

// A vertex where sheets of the surface merely touch, so that its faces are several fans: the
// smallest such vertex, -1 if there is none.
Index find_touching_vertex(const Cells& faces, const std::vector<Index>& opposite);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
