// Proves whether every cell of a mesh is valid, and tests whether their sides agree, as `majorant
// mesh check` does.
//
//  const VolumeCheck check = check_volume_mesh(mesh);
//  check.invalid();                      // cells where det J <= 0 somewhere
//  check.worst(10);                      // the cells with the lowest det J, by their size
//
// Only cells of the largest dimension are checked; the others are their boundary. Triangles and
// quads of a surface in space are checked against the normal of the straight cell; for quads, that
// of the diagonals. det J is then the component of the curved cell's normal along that normal.
//
// Not for maps of surfaces, which have cuts and may overlap: MapProof (certify/map_proof.h).
// Overlaps of cells that share no side are found only if both have the same nodes or places.
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
  double scaled_jacobian = 0;  // the smallest value on a lattice of points
};

// Two cells with a common side on which their nodes are different points.
struct Disagreement {
  CellName first, second;
};

struct VolumeCheck {
  std::vector<CheckedCell> cells;  // in the order of blocks
  std::vector<Disagreement> disagreements;
  std::vector<CellName> crowded;  // cells of sides that have more than two, one for each such side
  // Pairs of cells that lie on the same side of a common side, with det J of one sign: they
  // overlap. For volumes and the plane.
  std::vector<Disagreement> overlapping;
  std::vector<Disagreement> repeated;  // cells with the same nodes, or with nodes at the same
                                       // places
  Index boundary_sides = 0;            // of one cell
  Index periodic_sides = 0;            // of two cells, equal up to a translation
  bool is_surface = false;             // of triangles and quads in space

  Index count(ProofStatus status) const;
  Index invalid() const { return count(ProofStatus::Violated); }
  Index undecided() const { return count(ProofStatus::Undecided); }
  // Returns the number of cells with det J < 0 everywhere: cells that are turned around.
  Index inverted() const;
  // Returns true if no side and no pair of cells is listed above.
  bool sides_fit() const;
  bool is_valid() const;  // sides_fit(), and all cells are proven
  double least_scaled_jacobian() const;
  double mean_scaled_jacobian() const;
  // Returns at most `most` cells: first those that are not proven, then the others, each by the
  // scaled Jacobian.
  std::vector<const CheckedCell*> worst(std::size_t most) const;
};

// Throws Error(Unsupported) for degrees without tables, and if no cell has two dimensions; throws
// Stopped.
VolumeCheck check_volume_mesh(const VolumeMesh& mesh, const StopCheck& stop = {});

// Returns the place of the smallest det J found in a checked cell.
Vector3 place_of(const VolumeMesh& mesh, const CheckedCell& cell);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
