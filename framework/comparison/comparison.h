// The result of several methods on one problem: one row a method, with every point of its run.
// Plain data.
//
//   const Comparison all = compare(problem, y0);               // compare.h
//   for (const MethodRun& run : all.runs)
//     std::cout << run.method << " " << run.status << " " << run.factorizations << "\n";
//   std::cout << comparison_table(all);                        // comparison_table.h
//
// Not for a single solve, whose numbers are in its SolveResult (minimizer.h).
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "majorant/framework/minimizer.h"

namespace majorant {

// One iteration of one method. Unknown values are NaN.
struct ComparisonPoint {
  int iteration = 0;     // 0 = the start
  double seconds = 0.0;  // since the method's start
  double energy = 0.0;   // +inf outside the energy's domain and the feasible set
  double gradient_norm = 0.0;
  double step = 0.0;                                          // accepted by the line search
  double measure = std::numeric_limits<double>::quiet_NaN();  // Comparison::measure of the point
};

struct MethodRun {
  std::string method;
  std::string status;                        // status_name(), or kNotApplicable, or "failed"
  std::string message;                       // the reason of the status, if there is more to say
  std::vector<ComparisonPoint> points = {};  // in the order of iterations; empty if the run never
                                             // began
  int factorizations = 0;                    // failed ones included
  IterationRecord::Seconds seconds = {};     // by part; NaN if a library uses its own solver
  Vec x = {};                                // the end of the run, full unknowns
  Definite definite = Definite::NotTested;   // the exact Hessian at x
  // |x - x'| with x' of the run with the least energy; NaN if points are not compared.
  double distance = std::numeric_limits<double>::quiet_NaN();
  std::vector<std::string> notes = {};  // sentences on this run

  int iterations() const { return points.empty() ? 0 : points.back().iteration; }
};

// The status of a method that is not for the problem, or not in the program.
inline constexpr const char* kNotApplicable = "not_applicable";

struct Comparison {
  std::string title;    // of the problem
  std::string machine;  // CPU, threads
  std::vector<MethodRun> runs;
  std::vector<std::string> notes = {};  // sentences on the problem
  std::string measure = {};             // the name of ComparisonPoint::measure; empty: none

  // The smallest finite energy over all runs; +inf if there is none.
  double best_energy() const;
};

// Returns the first point whose energy is at most best + fraction * |best|; nullptr if there is
// none, or if `best` is not finite.
const ComparisonPoint* first_within(const MethodRun& run, double best, double fraction);

// Returns (energy - best) / |best|, or energy - best if best is 0; NaN unless both are finite.
double excess_energy(double energy, double best);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
