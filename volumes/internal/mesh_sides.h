// The sides of the cells of most dimensions, those of the same corners together, and the nodes on
// a side in an order that all of its cells see alike.
//
//   const VolumeMesh cells = read_volume_mesh("ball.msh");
//   const std::vector<CellSide> sides = sides_of(cells);
//   for_each_side(sides, [&](std::span<const CellSide> cells) { cells.size() == 1; });  // boundary
#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "majorant/volumes/check_volume_mesh.h"
#include "majorant/volumes/volume_mesh.h"

namespace majorant {

// A side of a cell under the sorted numbers of its corners; unused ones are the largest number.
struct CellSide {
  using Key = std::array<Index, 4>;
  Key key;
  CellName name;
  int side;  // of ReferenceCell::sides()
};

// The key of a side with these corners.
CellSide::Key side_key(std::span<const Index> corners);

// Returns the sides of all cells of most dimensions, sorted by their keys, then as the cells are.
std::vector<CellSide> sides_of(const VolumeMesh& mesh);

// use(cells of a side), one side after the other.
template <class Use>
void for_each_side(const std::vector<CellSide>& sides, const Use& use) {
  for (auto first = sides.begin(); first != sides.end();) {
    auto last = first;
    while (last != sides.end() && last->key == first->key) ++last;
    use(std::span<const CellSide>(first, last));
    first = last;
  }
}

// The sense in which two cells run round a side that they share. Apart: the one forwards, the other
// backwards, as cells on its two sides do. Together: both the same way, as cells on one side of it.
// Twisted: the corners of a square follow each other in other orders.
enum class SideSense { Apart, Together, Twisted };
SideSense sense_of(const VolumeMesh& mesh, const CellSide& a, const CellSide& b);

// True where the nodes of the two are the same but for a translation by which the cells come to lie
// next to each other: a mesh that is periodic, with nodes of its own for each cell.
bool are_translated(const VolumeMesh& mesh, const CellSide& a, const CellSide& b);

// A node of a side: its weights on the sorted corners, and its row of the points.
using SideNode = std::pair<std::array<int, 4>, Index>;
// In the order of the weights.
std::vector<SideNode> nodes_of(const VolumeMesh& mesh, const CellSide& side);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
