// BarrierMinimizer on the problems of [HS81] (collection.h), from the published starts.
//
// Prints a row per problem. Sizes: unknowns, nonlinear and eliminated linear equalities,
// inequalities, bounds. Energies: the result, the published minimum, and their difference relative
// to max(published, 1). Constraints at the end: the largest equality, relative to the norm of its
// derivative, and the least inequality or distance to a bound. Then iterations, factorizations,
// phases and the status. A problem is solved if it has Converged at the published minimum to
// kEnergyTolerance, or at another of its local minima, which is named. Exit code 1 if a problem is
// not solved.
//
// Sample runs:
//   build/release/bench/hock_schittkowski
//   build/release/bench/hock_schittkowski --only 71,100 --phases
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "collection.h"
#include "majorant/framework/parallel.h"

using namespace majorant;
using namespace majorant::hock_schittkowski;

namespace {

constexpr double kEnergyTolerance = 1e-6;

struct Sums {
  int problems = 0, solved = 0, elsewhere = 0, iterations = 0, factorizations = 0;
  double violation = 0;
};

double difference(double energy, double minimum) {
  return (energy - minimum) / std::max(1.0, std::abs(minimum));
}

void print_phases(const BarrierResult& result) {
  for (const BarrierPhase& p : result.phases)
    fmt::print("    mu {:.1e} E {:.12g} violation {:.1e} iterations {} {}\n", p.mu, p.energy,
               p.violation, p.iterations, status_name(p.status));
}

void run(const CollectionProblem& p, bool phases, Sums& sums) {
  const Instance instance = p.make();
  const BarrierResult result = instance.minimize();
  const Vec x = instance.problem.expand(result.y);
  int factorizations = 0;
  for (const IterationRecord& r : result.iterations) factorizations += r.factorizations;
  const auto is_at = [&](double minimum) {
    return std::abs(difference(result.energy, minimum)) <= kEnergyTolerance;
  };
  const bool converged = result.status == Status::Converged;
  const bool solved = converged && is_at(p.minimum);
  const bool elsewhere =
      !solved && converged && std::any_of(p.local_minima.begin(), p.local_minima.end(), is_at);
  const std::string status =
      solved      ? "solved"
      : elsewhere ? "another local minimum"
                  : fmt::format("**{}**: {}", status_name(result.status), result.message);
  fmt::print(
      "| {} | {} | {} + {} | {} | {} | {:.10g} | {:.10g} | {:.1e} | {:.1e} | {:.1e} | {} | "
      "{} | {} | {} |\n",
      p.number, instance.unknowns, instance.equalities, instance.linear_equalities,
      instance.inequalities, instance.finite_bounds, result.energy, p.minimum,
      difference(result.energy, p.minimum), result.violation, instance.margin(x),
      result.iterations.size(), factorizations, result.phases.size(), status);
  if (phases) print_phases(result);
  std::fflush(stdout);
  ++sums.problems;
  sums.solved += solved;
  sums.elsewhere += elsewhere;
  sums.iterations += static_cast<int>(result.iterations.size());
  sums.factorizations += factorizations;
  sums.violation = std::max(sums.violation, result.violation);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<int> only;
  bool phases = false;
  CLI::App app("BarrierMinimizer on the problems of Hock and Schittkowski");
  app.add_option("--only", only, "numbers of problems")->delimiter(',');
  app.add_flag("--phases", phases, "the phases of each run");
  CLI11_PARSE(app, argc, argv);
  const ThreadCount one(1);
  fmt::print(
      "| problem | unknowns | equalities | inequalities | bounds | E | published | difference "
      "| violation | margin | iterations | factorizations | phases | status |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  Sums sums;
  for (const CollectionProblem& p : collection())
    if (only.empty() || std::find(only.begin(), only.end(), p.number) != only.end()) try {
        run(p, phases, sums);
      } catch (const std::exception& e) {
        fmt::print("| {} | **{}** |\n", p.number, e.what());
        ++sums.problems;
      }
  fmt::print(
      "\n{} problems: {} solved, {} at another local minimum; {} iterations, {} "
      "factorizations, largest violation {:.1e}\n",
      sums.problems, sums.solved, sums.elsewhere, sums.iterations, sums.factorizations,
      sums.violation);
  return sums.solved + sums.elsewhere == sums.problems ? 0 : 1;
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
