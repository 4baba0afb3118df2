// Several methods on one problem: what `majorant compare` measured. Plain data.
#pragma once

#include <string>
#include <vector>

namespace majorant {

// One iteration of one method. Values that a method does not know are NaN.
struct ComparisonPoint {
  int iteration = 0;     // 0 = the start
  double seconds = 0.0;  // since the method's start
  double energy = 0.0;   // +inf outside the energy's domain
  double gradient_norm = 0.0;
  double step = 0.0;     // accepted by the line search
  double min_det = 0.0;  // smallest det J; <= 0 where a triangle is flipped
};

struct MethodRun {
  std::string method;
  std::string status;                   // as in the report: converged, time_limit, failed...
  std::string message;                  // why, if there is more to say
  std::vector<ComparisonPoint> points;  // in the order of iterations; empty if it never started
};

struct Comparison {
  std::string title;    // mesh, degree, energy
  std::string machine;  // CPU, threads
  std::vector<MethodRun> runs;

  // The smallest finite energy over all runs; +inf if there is none.
  double best_energy() const;
};

// The first point whose energy is at most best + fraction * |best|; nullptr if there is none, or if
// `best` is not finite.
const ComparisonPoint* first_within(const MethodRun& run, double best, double fraction);

// (energy - best) / |best|, or energy - best if best is 0; NaN unless both are finite.
double excess_energy(double energy, double best);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
