// Remedies for a run that stalls at the boundary of the feasible set. They are tried in the order
// of kRemedies; after one that changes something the run continues.
//
//     Deepen         certificates bisect deeper, since they may be too coarse for a valid map
//     Refine         blocking faces get finer quadrature
//     Exclude        blocking faces lose their weight for a few steps but stay positive
//                    [MC20] Sec. 4.3
//     FollowBarrier  interior points: the energy plus mu times one with a strong barrier, for
//                    falling mu, leads around corners in which a weak barrier, or none, stalls
#pragma once

#include <span>

#include "majorant/framework/run_record.h"
#include "majorant/parametrization/solve/internal/degree_problem.h"

namespace majorant {

// The history of the remedies of a degree.
struct RemedyState {
  // The number of times that remedies were tried, and that the quadrature was refined.
  struct Counts {
    int stalls = 0, refinements = 0;
  };
  Counts counts;
  int running = 0;                // remedies in progress
  bool barrier_followed = false;  // at most once a degree
  RemedyUses uses{};
};

// Descends to the documented stopping rules, and again as long as a remedy resolves a stall or the
// quadrature can be refined.
SolveResult descend_with_remedies(DegreeProblem& problem, RemedyState& state, RunRecord& record);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
