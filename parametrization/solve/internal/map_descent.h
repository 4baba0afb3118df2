// Descents on the problem of one degree: Newton steps that the surroundings follow, and the soft
// start of maps with nearly collapsed triangles.
#pragma once

#include <optional>

#include "majorant/framework/run_record.h"
#include "majorant/parametrization/solve/internal/degree_problem.h"

namespace majorant {

// Rules that end a descent by this decrease of one iteration, be it on a plateau, whatever the next
// one promises, by no number of iterations but the run's.
StoppingRules unlimited_rules(const DegreeSetup& setup, double relative_decrease);
// The documented rules of a run, as its domain needs them.
StoppingRules final_rules(const DegreeProblem& problem);

struct MapDescentResult {
  SolveResult result;       // energy, iterations: the map's own
  double start_energy = 0;  // of the map; that of the result where nothing was begun
};

// Takes Newton steps from the problem's point until the rules say so.
MapDescentResult descend(DegreeProblem& problem, StoppingRules rules, Phase phase,
                         RunRecord& record);

// Descends until one iteration decreases the energy by less than `tolerance`, without remedies.
SolveResult approach(DegreeProblem& problem, double tolerance, Phase phase, RunRecord& record);

// Takes, from a start of enormous energy (a Tutte map with nearly collapsed triangles), steps on
// sum A sqrt(density) by reweighting, until the mean density is moderate. Otherwise the stiff
// triangles' rounding errors drive everything else, and which minimum is reached is chance. Throws
// Stopped.
void take_soft_steps(DegreeProblem& problem, RunRecord& record);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
