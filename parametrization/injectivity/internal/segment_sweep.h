// Are polygons simple and disjoint? By a sweep in exact arithmetic, O(n log n) whatever their shape
// (Shamos and Hoey, [SH76]). Not for curves: those are compared pair by pair.
//
//   SubdivisionBudget budget(1000000);
//   const SweepResult swept = sweep_segments(boundary_loops(map), budget);
//   if (swept.contact == Contact::None) ...   // no two edges have more in common than their vertex
#pragma once

#include "majorant/parametrization/injectivity/internal/boundary_loops.h"
#include "majorant/parametrization/injectivity/internal/curve_contact.h"

namespace majorant {

struct SweepResult {
  // None: proven. Certain: edges a and b meet, one pair of perhaps many; exact as well. Possible:
  // stopped by the budget, of which a pair takes one.
  Contact contact = Contact::None;
  Index a = -1, b = -1;
  long pairs_tested = 0;
};

// Loops without defect() whose curves are all of degree 1.
SweepResult sweep_segments(const BoundaryLoops& loops, SubdivisionBudget& budget);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
