// Convex combinations that do not shrink: where every vertex is the plain mean of its neighbours,
// the rings of a narrow tube shrink by a constant factor each, and after thirty of them nothing is
// left that doubles can tell apart.
//
//   std::vector<char> held(to_size(mesh->vertex_count()));   // 1: in convex position
//   Vec x = Vec::Zero(2 * mesh->vertex_count());        // u, v; those of held vertices are given
//   x = weighted_tutte(mesh->faces(), held, x, kLeanings.front(), "no such map");
//
// Here a vertex leans towards its parent, a neighbour one edge nearer to the boundary:
//
//     x_v = (1 - s) x_parent + s (mean of all neighbours),
//     s = min(1, leaning n / (2 pi depth)),
//
// n being the number of vertices on its ring: those as far from the boundary that edges between
// such vertices connect. As a ring of n shrinks by about exp(-2 pi / n) where it is the mean of its
// neighbours, the narrow ones together now shrink by exp(-leaning), and where rings are wide
// nothing changes. Any map with positive weights of a disk whose boundary is strictly convex is an
// embedding [Flo03], whatever the symmetry of its weights. Not for surfaces that Tutte's map
// serves: triangles get long and thin.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/framework/types.h"

namespace majorant {

// To be tried one after the other; on closed surfaces with long limbs less a face, the
// first three leave faces without room; more leaves siblings, which lean to one parent, more room,
// less keeps narrow rings wide (at 1 the last of 60 rings of 4 has 0.66 of the radius).
inline constexpr std::array<double, 6> kLeanings{1, 4, 8, 12, 16, 24};

// faces: #F by 3, of a disk whose boundary is held. held: #V. x: 2 #V, read where held. Returns all
// of x, to the rounding of doubles. leaning: positive. Throws Error(Infeasible, otherwise) when the
// system cannot be factorized; Stopped.
Vec weighted_tutte(const Cells& faces, const std::vector<char>& held, Vec x, double leaning,
                   const std::string& otherwise, const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
