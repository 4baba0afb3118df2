// Is every cell of a mesh valid, do their sides agree? What `majorant mesh check` says.
//
//  const VolumeCheck check = check_volume_mesh(mesh);
//  check.invalid();                      // cells where det J <= 0 somewhere
//  check.worst(10);                      // the cells with the lowest det J, by their size
//
// Cells of the most dimensions are checked; those of fewer are their boundary. Triangles and quads
// of a surface in space are checked against the normal of the straight cell: det J there is the
// component of the normal of the curved cell along it, which at quads is that of the diagonals.
//
// Not for maps of surfaces, which have cuts and may overlap: MapProof (certify/map_proof.h).
// Nothing is said of cells that overlap without sharing a side, but where they are the same.
#pragma once

#include <vector>

#include "majorant/volumes/determinant_range.h"
#include "majorant/volumes/volume_mesh.h"

namespace majorant {

struct CellName {
  Index block, cell;
};

struct CheckedCell {
  CellName name{};
  DeterminantRange range;
  double scaled_jacobian = 0;  // least at the points of a lattice
};

// Two cells of one side whose nodes on it are not the same points.
struct Disagreement {
  CellName first, second;
};

struct VolumeCheck {
  std::vector<CheckedCell> cells;  // in the order of blocks
  std::vector<Disagreement> disagreements;
  std::vector<CellName> crowded;  // cells of a side that more than two have, one for each side
  // Cells of a common side that lie on one side of it, both with det J > 0 or both with det J < 0:
  // they overlap. Of volumes and of the plane.
  std::vector<Disagreement> overlapping;
  std::vector<Disagreement> repeated;  // cells with the same nodes, or nodes in the same places
  Index boundary_sides = 0;            // of one cell
  Index periodic_sides = 0;            // of two cells, equal up to a translation
  bool is_surface = false;             // of triangles and quads in space

  Index count(ProofStatus status) const;
  Index invalid() const { return count(ProofStatus::Violated); }
  Index undecided() const { return count(ProofStatus::Undecided); }
  // Cells with det J < 0 at all of their points: turned around.
  Index inverted() const;
  // True where no side and no pair of cells is named above.
  bool sides_fit() const;
  bool is_valid() const;  // that, and all cells are proven
  double least_scaled_jacobian() const;
  double mean_scaled_jacobian() const;
  // At most so many, those that are not proven first, each kind by the scaled Jacobian.
  std::vector<const CheckedCell*> worst(std::size_t most) const;
};

// Throws Error(Unsupported) for degrees without tables and where no cell has two dimensions;
// Stopped.
VolumeCheck check_volume_mesh(const VolumeMesh& mesh, const StopCheck& stop = {});

// Returns the place of the least det J that was found in a checked cell.
Vector3 place_of(const VolumeMesh& mesh, const CheckedCell& cell);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
