// Convex combinations that do not shrink. If every vertex is the plain mean of its neighbours, each
// ring of a narrow tube shrinks by a constant factor, and after thirty rings doubles do not
// separate the points any more.
//
//   std::vector<char> held(to_size(mesh->vertex_count()));   // 1: in convex position
//   Vec x = Vec::Zero(2 * mesh->vertex_count());        // u, v; those of held vertices are given
//   x = weighted_tutte(mesh->faces(), held, x, kLeanings.front(), "no such map");
//
// Here a vertex is drawn towards its parent, a neighbour one edge nearer to the boundary:
//
//     x_v = (1 - s) x_parent + s (mean of all neighbours),
//     s = min(1, leaning n / (2 pi depth)),
//
// where n is the number of vertices on its ring: the vertices at the same distance from the
// boundary that are connected by edges between them. A ring of n shrinks by about exp(-2 pi / n) if
// it is the mean of its neighbours. So the narrow rings together now shrink by exp(-leaning), and
// wide rings are not changed.
//
// Any map with positive weights of a disk whose boundary is strictly convex is an embedding
// [Flo03], even with asymmetric weights. Triangles get long and thin, so Tutte's map is preferable
// where it works.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/framework/types.h"

namespace majorant {

// Values to be tried in turn. On closed surfaces with long limbs less a face, the first three leave
// faces without room. Larger values separate siblings, which have one parent, better; smaller ones
// keep narrow rings wider (at 1 the last of 60 rings of 4 has 0.66 of the radius).
inline constexpr std::array<double, 6> kLeanings{1, 4, 8, 12, 16, 24};

// Returns all of x, to the rounding of doubles. faces: #F by 3, of a disk whose boundary is held.
// held: #V. x: 2 #V, read where held. leaning: positive. Throws Error(Infeasible, otherwise) if the
// system cannot be factorized; Stopped.
Vec weighted_tutte(const Cells& faces, const std::vector<char>& held, Vec x, double leaning,
                   const std::string& otherwise, const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
