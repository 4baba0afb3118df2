// Are polygons simple and disjoint? By a sweep in exact arithmetic, O(n log n) whatever their shape
// (Shamos and Hoey, [SH76]). Not for curves: those are compared pair by pair.
//
//   SubdivisionBudget budget(1000000);
//   const SweepResult swept = sweep_segments(boundary_loops(map), budget);
//   if (swept.apart == ProofStatus::Proven) ...  // no two edges meet but in their vertex
#pragma once

#include "majorant/certify/boundary_loops.h"
#include "majorant/certify/internal/curve_contact.h"

namespace majorant {

struct SweepResult {
  // Proven: none do. Violated: edges a and b meet, one of perhaps many pairs; exact. Undecided:
  // stopped by the budget, of which a pair takes one.
  ProofStatus apart = ProofStatus::Proven;
  Index a = -1, b = -1;
  long pairs_tested = 0;
};

// Loops without defect() whose curves are all of degree 1.
SweepResult sweep_segments(const BoundaryLoops& loops, SubdivisionBudget& budget);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
