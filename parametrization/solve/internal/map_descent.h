// Descents on the problem of one degree: Newton steps that the surroundings follow, and the soft
// start of maps with nearly degenerate triangles.
#pragma once

#include <optional>

#include "majorant/framework/run_record.h"
#include "majorant/parametrization/solve/internal/degree_problem.h"

namespace majorant {

// Returns rules that end a descent at this relative decrease of one iteration, even on a plateau,
// whatever the next one promises. Only the run limits the number of iterations.
StoppingRules unlimited_rules(const DegreeSetup& setup, double relative_decrease);
// Returns the documented stopping rules of a run, adapted to its domain.
StoppingRules final_rules(const DegreeProblem& problem);

struct MapDescentResult {
  SolveResult result;       // energy and iterations are the map's own
  double start_energy = 0;  // of the map; that of the result if no step was tried
};

// Takes Newton steps from the problem's point until the rules end the descent.
MapDescentResult descend(DegreeProblem& problem, StoppingRules rules, Phase phase,
                         RunRecord& record);

// Descends until one iteration decreases the energy by less than `tolerance`, without remedies.
SolveResult approach(DegreeProblem& problem, double tolerance, Phase phase, RunRecord& record);

// Takes steps on sum A sqrt(density) by reweighting until the mean density is moderate, from a
// start of enormous energy (a Tutte map with nearly degenerate triangles). Otherwise the rounding
// errors of stiff triangles dominate, and the minimum that is reached is arbitrary. Throws Stopped.
void take_soft_steps(DegreeProblem& problem, RunRecord& record);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
