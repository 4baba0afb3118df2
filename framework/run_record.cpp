#include "majorant/framework/run_record.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace majorant {

std::string_view status_name(Status status) {
  switch (status) {
    case Status::Converged:
      return "converged";
    case Status::MaxIterations:
      return "max_iterations";
    case Status::TimeLimit:
      return "time_limit";
    case Status::Interrupted:
      return "interrupted";
    case Status::Stalled:
      return "stalled";
    case Status::Infeasible:
      return "infeasible";
    case Status::Failed:
      return "failed";
  }
  return "failed";
}

Status stopped_status(Directive why) {
  return why == Directive::TimeLimit ? Status::TimeLimit : Status::Interrupted;
}

double relative_to(double energy, double value) {
  return value / std::max(std::abs(energy), std::numeric_limits<double>::min());
}

std::string_view limit_name(StepLimit limit) {
  switch (limit) {
    case StepLimit::None:
      return "none";
    case StepLimit::Energy:
      return "energy";
    case StepLimit::Domain:
      return "domain";
    case StepLimit::Checker:
      return "checker";
  }
  return "unknown";
}

std::string_view phase_name(Phase phase) {
  switch (phase) {
    case Phase::Newton:
      return "newton";
    case Phase::Entry:
      return "entry";
    case Phase::SoftStart:
      return "soft-start";
    case Phase::Excluded:
      return "excluded";
    case Phase::Barrier:
      return "barrier";
  }
  return "newton";
}

std::string_view remedy_name(Remedy remedy) {
  switch (remedy) {
    case Remedy::Deepen:
      return "deepen";
    case Remedy::Refine:
      return "refine";
    case Remedy::Exclude:
      return "exclude";
    case Remedy::FollowBarrier:
      return "follow-barrier";
  }
  return "deepen";
}

std::string_view outcome_name(StepResult::Outcome outcome) {
  switch (outcome) {
    case StepResult::Outcome::Moved:
      return "moved";
    case StepResult::Outcome::AtMinimum:
      return "at-minimum";
    case StepResult::Outcome::Blocked:
      return "blocked";
    case StepResult::Outcome::NoDecrease:
      return "no-decrease";
    case StepResult::Outcome::Breakdown:
      return "breakdown";
    case StepResult::Outcome::Stopped:
      return "stopped";
  }
  return "moved";
}

int steps_taken(const std::vector<TraceEntry>& trace) {
  return static_cast<int>(std::count_if(trace.begin(), trace.end(), [](const TraceEntry& row) {
    return row.level == 0 && row.outcome == StepResult::Outcome::Moved;
  }));
}

std::optional<double> factor_solve_seconds(const std::vector<TraceEntry>& trace, int degree) {
  std::vector<double> seconds;
  for (const TraceEntry& row : trace) {
    const IterationRecord& r = row.record;
    if (row.level == 0 && row.degree == degree && r.failed_factorizations < r.factorizations)
      seconds.push_back(r.seconds.factorize / r.factorizations + r.seconds.solve);
  }
  if (seconds.empty()) return {};
  const auto middle = seconds.begin() + static_cast<std::ptrdiff_t>(seconds.size() / 2);
  std::nth_element(seconds.begin(), middle, seconds.end());
  return *middle;
}

Directive observed(RunObserver* observer, const IterationRecord& record, const Vec& y) {
  if (!observer) return Directive::Continue;
  TraceEntry row;
  row.record = record;
  row.energy = record.energy;
  return observer->after_step(row, y);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
