// Updates the elimination of a graph that has gained a few edges: order and supernodes stay, and
// the supernodes on the path of an edge touch more positions. For patterns that change a little at
// a time, when a new ordering costs more than its factor saves.
//
//   // Blocks 0, 1, 2 in this order, each a supernode of its own; 1 and 2 are neighbours.
//   const BlockElimination path{{0, 1, 2}, {0, 1, 2, 3}, {0, 1, 3, 4}, {0, 1, 2, 2}};
//   const BlockElimination star = symbolic_update(path, {{0, 1}, {0, 2}});
//   star.structure;   // 0 1 2, 1 2, 2
//
// Removed edges stay as fill: after many changes a new analysis is needed.
#pragma once

#include "majorant/framework/internal/assembly_tree.h"
#include "majorant/framework/internal/block_graph.h"

namespace majorant {

// edges: each joins two different blocks. The result is a postorder again, so supernodes may have
// changed places.
BlockElimination symbolic_update(const BlockElimination& elimination, const BlockEdges& edges);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
