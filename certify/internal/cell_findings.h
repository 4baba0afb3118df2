// Findings about the cells of a map file, each by itself: is det J > 0, is it flat on the surface?
//
//   const CellPositivity cells = cell_positivity(file, {});
//   if (cells.finding.answer != ProofStatus::Proven) std::cerr << cells.finding.detail << "\n";
#pragma once

#include <vector>

#include "majorant/certify/map_proof.h"

namespace majorant {

struct CellPositivity {
  Finding finding;                  // as MapProof::positive
  std::vector<Index> not_positive;  // cells, inverted or undecided
};

// Judges what the digits of the file say (MapFile::uv_rounding). Undecided where it is stopped.
CellPositivity cell_positivity(const MapFile& file, const StopCheck& stop);

// Returns what MapProof::flat is. Else the file shows another surface than the one between its
// corners.
Finding flatness_of(const MapFile& file);

// The finding on a question that was not decided when the run was stopped.
Finding stopped_finding();

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
