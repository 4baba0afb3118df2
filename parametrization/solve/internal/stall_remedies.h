// Remedies for a run that is held at the limit of the feasible set. They are tried in the order of
// kRemedies; after one that changes something the run goes on.
//
//     Deepen         certificates bisect deeper: they may be too coarse, the map not too close to
//                    degenerate
//     Refine         blocking faces get finer quadrature
//     Exclude        blocking faces lose their weight for a few steps, not their positivity [MC20]
//                    Sec. 4.3
//     FollowBarrier  interior points: the energy plus mu times one whose barrier is strong, for
//                    falling mu, leads around corners that a weak barrier, or none, ran into
#pragma once

#include <span>

#include "majorant/framework/run_record.h"
#include "majorant/parametrization/solve/internal/degree_problem.h"

namespace majorant {

// What the remedies of a degree have done so far.
struct RemedyState {
  // The number of times that remedies were tried, and that the quadrature was refined.
  struct Counts {
    int stalls = 0, refinements = 0;
  };
  Counts counts;
  int running = 0;                // remedies that are taking steps
  bool barrier_followed = false;  // once a degree
  RemedyUses uses{};
};

// Descends to the documented stopping rules, again as long as a stall can be left by a remedy or
// the quadrature be refined.
SolveResult descend_with_remedies(DegreeProblem& problem, RemedyState& state, RunRecord& record);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
