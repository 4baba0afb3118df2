#include "majorant/framework/comparison/compare.h"

#include <fmt/format.h>

#include <fstream>
#include <utility>

#include "majorant/framework/argument_check.h"
#include "majorant/framework/comparison/internal/comparison_notes.h"
#include "majorant/framework/comparison/internal/race.h"
#include "majorant/framework/error.h"
#include "majorant/framework/parallel.h"

namespace majorant {
namespace {

std::string machine() {
  std::string processor = "unknown processor";
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name") && line.find(": ") != std::string::npos) {
      processor = line.substr(line.find(": ") + 2);
      break;
    }
  const int threads = ThreadCount::current();
  return fmt::format("{}, {} thread{}", processor, threads, threads == 1 ? "" : "s");
}

const FinishedRun* least_energy(const std::vector<FinishedRun>& runs) {
  const FinishedRun* best = nullptr;
  for (const FinishedRun& r : runs)
    if (r.has_end && (!best || r.run.points.back().energy < best->run.points.back().energy))
      best = &r;
  return best;
}

// Barriers end too close to their limits for finite differences.
TermChanges without_barriers(const ComparedProblem& compared) {
  TermChanges changes;
  for (const HeldBound& bound : compared.bounds)
    changes.emplace_back(bound.barrier, TermChange{.weight = 0});
  return changes;
}

// y0: the start in the unknowns of race(); start: the start as a point of compared.problem.
Comparison compared(const ComparedProblem& compared, const Vec& y0, const Vec& start,
                    const std::vector<ComparisonMethod>& methods,
                    const ComparisonOptions& options) {
  Comparison all{options.title, machine(), {}, {}, options.measure};
  if (options.checks_derivatives)
    all.notes = derivative_notes(compared.problem, start, "at the start");
  std::vector<FinishedRun> runs;
  for (const ComparisonMethod& method : methods) {
    if (options.stop() != Directive::Continue) break;
    if (options.begin) options.begin(method);
    runs.push_back(race(method, compared, y0, options));
  }
  compare_ends(runs, compared.manifolds.get(), options.compares_points);
  const FinishedRun* best = least_energy(runs);
  if (options.checks_derivatives && all.notes.empty() && best)
    all.notes = derivative_notes(best->problem.with(without_barriers(compared)), best->y,
                                 "where " + best->run.method + " ended");
  for (FinishedRun& finished : runs) all.runs.push_back(std::move(finished.run));
  return all;
}

}  // namespace

Comparison compare(const Problem& problem, const Vec& y0,
                   const std::vector<ComparisonMethod>& methods, const ComparisonOptions& options) {
  if (y0.size() != problem.size())
    throw InvalidArgument(
        fmt::format("compare: y0 has {} unknowns, the problem {}", y0.size(), problem.size()));
  const ComparedProblem one{problem, options.bounds, {}};
  return compared(one, y0, y0, methods, options);
}

Comparison compare(const ManifoldProblem& problem, const Vec& x0,
                   const std::vector<ComparisonMethod>& methods, const ComparisonOptions& options) {
  Vec y0;
  const Problem around = problem.around(x0, &y0);
  const ComparedProblem one{around, {}, std::make_shared<const ManifoldProblem>(problem)};
  if (one.holds() || problem.has_checkers())
    throw Error(
        ErrorKind::Unsupported,
        "compare: bounds, inequalities, equalities and checkers beside unknowns on manifolds "
        "are for minimize() alone");
  return compared(one, x0, y0, methods, options);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
