// Findings about single cells of a map file: whether det J > 0, and whether the cell is flat on the
// surface.
//
//   const CellPositivity cells = cell_positivity(file, {});
//   if (cells.finding.answer != ProofStatus::Proven) std::cerr << cells.finding.detail << "\n";
#pragma once

#include <vector>

#include "majorant/certify/map_proof.h"

namespace majorant {

struct CellPositivity {
  Finding finding;                  // see MapProof::positive
  std::vector<Index> not_positive;  // inverted or undecided cells
};

// Judges the map of the file's digits (MapFile::uv_rounding). Undecided if stopped.
CellPositivity cell_positivity(const MapFile& file, const StopCheck& stop);

// Returns MapProof::flat. A file with curved cells shows another surface than that of its corners.
Finding flatness_of(const MapFile& file);

// Returns the finding for a question that was open when the run was stopped.
Finding stopped_finding();

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
