// The elimination of a graph that has gained a few edges: order and groups stay, the groups that an
// edge passes through touch more. For patterns that change a little at a time, where a new ordering
// costs more than what its factor would save.
//
//   // Blocks 0, 1, 2 in this order, each a group of its own; 1 and 2 are neighbours.
//   const BlockElimination path{{0, 1, 2}, {0, 1, 2, 3}, {0, 1, 3, 4}, {0, 1, 2, 2}};
//   const BlockElimination star = extended_elimination(path, {{0, 1}, {0, 2}});
//   star.touched;   // 0 1 2, 1 2, 2
//
// Edges that have gone stay in it as fill: after many changes a new analysis is due.
#pragma once

#include "majorant/framework/internal/block_graph.h"
#include "majorant/framework/internal/front_tree.h"

namespace majorant {

// edges: of two different blocks each. Groups are in postorder again, so some may have changed
// places.
BlockElimination extended_elimination(const BlockElimination& elimination, const BlockEdges& edges);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
