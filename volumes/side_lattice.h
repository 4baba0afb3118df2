// The sides of a cell as straight triangles between points of a lattice, for pictures.
//
//   const CellType type{CellShape::Tetrahedron, 1};
//   const std::vector<double> nodes{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
//   for (const SideLattice& side : side_lattices(type, nodes.data(), 1)) side.points.row(0);
//
// Not for proofs: chords leave curved sides.
#pragma once

#include <array>
#include <vector>

#include "majorant/framework/types.h"
#include "majorant/volumes/volume_mesh.h"

namespace majorant {

struct SideLattice {
  std::vector<int> corners;               // the corners of the cell on this side
  std::vector<std::array<double, 6>> at;  // #P, homogeneous coordinates in the cell
  Points3 points;                         // #P by 3, in space
  // #P by 2, in a regular triangle over the segment from (0, 0) to (1, 0), or the unit square.
  Points2 place;
  Cells triangles;  // #T by 3, positive in `place`
};

// Returns the sides of a three-dimensional cell, or a two-dimensional cell itself; edges have
// `steps` segments, at least 1. nodes: x, y, z of each.
std::vector<SideLattice> side_lattices(const CellType& type, const double* nodes, int steps);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
