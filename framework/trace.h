// What a run leaves behind, iteration by iteration: the records of its steps, with the degree, what
// the step minimized and which remedy came before it.
//
// Solvers write it through RunRecord (run_record.h); progress lines, reports and CSV files show it.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "majorant/framework/iteration.h"

namespace majorant {

// What an iteration minimizes. Energies of different phases do not compare.
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

struct TraceEntry {
  int degree = 1;
  IterationRecord record;  // record.iteration counts through the whole run
  Phase phase = Phase::Newton;
  std::optional<Remedy> remedy;  // ran just before this iteration
};

}  // namespace majorant
