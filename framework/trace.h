// What a run leaves behind, step by step: a row for each step that was tried, taken or not, with
// the energy that was asked for beside the one that was minimized, and with the time.
//
//   double in_vain = 0;  // seconds of steps that were not taken
//   for (const TraceEntry& row : record.trace())
//     if (row.outcome != StepResult::Outcome::Moved) in_vain += row.record.seconds.sum();
//
// Solvers write it through RunRecord (run_record.h); progress lines, reports and CSV files show it.
// Not for what a step itself knows: that is IterationRecord (iteration.h).
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "majorant/framework/iteration.h"

namespace majorant {

// What an iteration minimizes. Minimized energies of different phases do not compare.
enum class Phase {
  Newton,     // the energy that was asked for
  Entry,      // one that is finite at the start, where the energy asked for is not
  SoftStart,  // sum A sqrt(density), from a start of enormous energy
  Excluded,   // without the elements that block
  Barrier,    // the energy and a part of one whose barrier is strong
};
// "newton", "entry", "soft-start", ... as reports have it.
std::string_view phase_name(Phase phase);

// What is tried when a run is held at the limit of the feasible set, in this order.
enum class Remedy {
  Deepen,         // certificates that bisect deeper
  Refine,         // finer quadrature on the elements that block
  Exclude,        // a few steps without these elements' say
  FollowBarrier,  // steps with a strong barrier of falling weight
};
inline constexpr std::array<Remedy, 4> kRemedies{Remedy::Deepen, Remedy::Refine, Remedy::Exclude,
                                                 Remedy::FollowBarrier};
std::string_view remedy_name(Remedy remedy);  // "deepen", ..., "follow-barrier"

// How often a remedy ran, and by how much the energy fell from the stalls to where the runs after
// it ended; what a run ended without a gain has gained 0.
struct RemedyUse {
  int runs = 0;
  double gained = 0;
};
using RemedyUses = std::array<RemedyUse, kRemedies.size()>;  // as kRemedies

// "moved", "at-minimum", "blocked", ... as reports have it.
std::string_view outcome_name(StepResult::Outcome outcome);

struct TraceEntry {
  int degree = 1;
  // record.iteration counts through the whole run. record.energy: what was minimized, without the
  // part of what surrounds the map.
  IterationRecord record;
  Phase phase = Phase::Newton;
  StepResult::Outcome outcome = StepResult::Outcome::Moved;
  int level = 0;      // of the mesh: 0 is the one asked for, 1 and more are coarser, of a start
  double energy = 0;  // after the step, the one asked for: record.energy in Phase::Newton
  std::optional<Remedy> remedy;  // ran just before this iteration
  double elapsed = 0;            // seconds from the start of the run to the end of the step
  // Of these, since the row before it (in the first one since the start of the run), outside of
  // record.seconds: the start, problems made and analysed, remedies, scaffolds.
  double other_seconds = 0;
};

// Of the mesh asked for: steps that moved the map.
int steps_taken(const std::vector<TraceEntry>& trace);
// Seconds of one factorization and one solve at that degree on the mesh asked for, the median over
// the rows; none where there was no factorization.
std::optional<double> factor_solve_seconds(const std::vector<TraceEntry>& trace, int degree);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
