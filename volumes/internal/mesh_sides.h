// The sides of the cells of the largest dimension, grouped by corners, and the nodes on a side in
// an order on which its cells agree.
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

// A side of a cell, with the sorted numbers of its corners; unused ones are the largest number.
struct CellSide {
  using Key = std::array<Index, 4>;
  Key key;
  CellName name;
  int side;  // of ReferenceCell::sides()
};

// Returns the key of a side with these corners.
CellSide::Key side_key(std::span<const Index> corners);

// Returns the sides of all cells of most dimensions, sorted by their keys, then as the cells are.
std::vector<CellSide> sides_of(const VolumeMesh& mesh);

// Calls use(cells of a side), one side after the other.
template <class Use>
void for_each_side(const std::vector<CellSide>& sides, const Use& use) {
  for (auto first = sides.begin(); first != sides.end();) {
    auto last = first;
    while (last != sides.end() && last->key == first->key) ++last;
    use(std::span<const CellSide>(first, last));
    first = last;
  }
}

// The directions in which two cells run around a shared side. Apart: opposite, as for cells on its
// two sides. Together: the same, as for cells on one side of it. Twisted: the corners of a square
// follow each other in other orders.
enum class SideSense { Apart, Together, Twisted };
SideSense sense_of(const VolumeMesh& mesh, const CellSide& a, const CellSide& b);

// Returns true if the nodes of both sides are the same up to a translation that puts the cells next
// to each other. Such a mesh is periodic, and each cell has nodes of its own.
bool are_translated(const VolumeMesh& mesh, const CellSide& a, const CellSide& b);

// A node of a side: its weights on the sorted corners, and its row of the points.
using SideNode = std::pair<std::array<int, 4>, Index>;
// Returns the nodes in the order of their weights.
std::vector<SideNode> nodes_of(const VolumeMesh& mesh, const CellSide& side);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
