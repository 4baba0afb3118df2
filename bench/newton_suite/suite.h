// A suite of minimization problems that are not maps, for Newton's method: springs, solids, rods,
// contact, fits, graphs, control, classical functions and fields.
//
//   for (const SuiteProblem& p : newton_suite()) {
//     const SuiteInstance instance = p.make();
//     for (const Vec& y0 : instance.starts)
//       if (!p.accepts(NewtonMinimizer().minimize(instance.problem, y0, {}))) ...
//   }
//
// table.cpp lists the problems, and the file of each family builds them. Every problem has ten
// starts: the published or natural one, four variations of it, and five random ones that are the
// same on every machine. All problems are small; seconds of large problems cannot be measured.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "majorant/framework/minimizer.h"

namespace majorant::newton_suite {

struct SuiteInstance {
  Problem problem;
  std::vector<Vec> starts;  // reduced unknowns
};

struct SuiteProblem {
  std::string name, family;
  std::string source;  // a key of docs/references.md, or "own"
  std::function<SuiteInstance()> make;
  // Energies of the minima that count as solutions, to 12 digits; none: there is no minimum.
  std::vector<double> minima;
  // Directions along which the energy does not change: translations, rotations, scales.
  int nullity = 0;
  // True if the exact Hessian at a minimum is singular, or nearly, along other directions, too.
  bool is_singular = false;

  // Returns whether the result has Converged at a minimum or, without minima, has Failed within
  // kUnboundedSteps.
  bool accepts(const SolveResult& result) const;
  // Returns the accepted minimum with this energy up to kEnergyTolerance, or up to kSmallEnergy if
  // the minimum is 0; null if there is none.
  const double* minimum_at(double energy) const;
};

// Upper bound on the steps until a run detects that its energy has no minimum.
inline constexpr int kUnboundedSteps = 60;
inline constexpr double kEnergyTolerance = 1e-5, kSmallEnergy = 1e-9;

// Returns all problems, without building them.
const std::vector<SuiteProblem>& newton_suite();

// ------------------------------------------------------------------ for builders
// A generator of numbers in [-1, 1], the same on every machine.
class Uniform {
 public:
  explicit Uniform(unsigned seed) : state_(0x9e3779b97f4a7c15u * (seed + 1u)) {}
  double operator()();
  Vec vector(Index size);

 private:
  unsigned long long state_;
};

// Returns `rows` rows of unknowns or nodes: row e has e, ..., e + columns - 1.
Cells runs(Index rows, int columns);
// Returns the edges of an n by n grid of squares, whose rows have n + 1 nodes.
Cells grid_edges(Index n);
// Returns `rows` elements, each with all `columns` unknowns.
Cells all_unknowns(Index rows, int columns);

// Returns wave k (1 to 4) on `size` unknowns: sin(k (i + 1)).
Vec wave(int k, Index size);
// Returns the starts x, x + spread wave k, and x + spread times random numbers, with x and spread
// in full unknowns.
std::vector<Vec> starts_around(const Problem& problem, const Vec& x, const Vec& spread);
std::vector<Vec> starts_around(const Problem& problem, const Vec& x, double spread);
// Returns the start x with x times these four factors as variations; [MGH81] uses 10 and 100.
std::vector<Vec> scaled_starts(const Problem& problem, const Vec& x,
                               const std::vector<double>& factors, double spread);
// Returns the start x with these four variations.
std::vector<Vec> starts_of(const Problem& problem, const Vec& x, const std::vector<Vec>& variations,
                           const Vec& spread);

}  // namespace majorant::newton_suite

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
