// A suite of minimization problems that are no maps, for Newton's method on energies of all kinds:
// springs, solids, rods, contact, fits, graphs, control, classical functions and fields.
//
//   for (const SuiteProblem& p : newton_suite()) {
//     const SuiteInstance instance = p.make();
//     for (const Vec& y0 : instance.starts)
//       if (!p.accepts(NewtonMinimizer().minimize(instance.problem, y0, {}))) ...
//   }
//
// table.cpp has the problems; each family's file builds them. Every problem has ten starts: the
// published or natural one, four variations of it, five random ones that are the same everywhere.
// Not for measuring seconds of large problems: each is small.
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
  // The exact Hessian at a minimum is singular beyond that, or nearly.
  bool is_singular = false;

  // Without minima: Failed within kUnboundedSteps; else Converged at one of them.
  bool accepts(const SolveResult& result) const;
  // The accepted minimum that this energy is that of, to kEnergyTolerance, or kSmallEnergy where it
  // is 0; null: none.
  const double* minimum_at(double energy) const;
};

// Steps within which an energy without a minimum has to be found to be one.
inline constexpr int kUnboundedSteps = 60;
inline constexpr double kEnergyTolerance = 1e-5, kSmallEnergy = 1e-9;

// All problems; builds none.
const std::vector<SuiteProblem>& newton_suite();

// ------------------------------------------------------------------ for builders
// Numbers in [-1, 1], the same on every machine.
class Uniform {
 public:
  explicit Uniform(unsigned seed) : state_(0x9e3779b97f4a7c15u * (seed + 1u)) {}
  double operator()();
  Vec vector(Index size);

 private:
  unsigned long long state_;
};

// Row e: unknowns or nodes e, ..., e + columns - 1; `rows` of them.
Cells runs(Index rows, int columns);
// The edges of an n by n grid of squares, rows of n + 1 nodes.
Cells grid_edges(Index n);
// Each of `rows` elements has all of `columns` unknowns.
Cells all_unknowns(Index rows, int columns);

// Wave k (1 to 4) on `size` unknowns: sin(k (i + 1)).
Vec wave(int k, Index size);
// x, x + spread wave k, x + spread times random numbers; x and spread in the full unknowns.
std::vector<Vec> starts_around(const Problem& problem, const Vec& x, const Vec& spread);
std::vector<Vec> starts_around(const Problem& problem, const Vec& x, double spread);
// Makes the starts x and, as variations, x times these four factors: [MGH81] has 10 and 100.
std::vector<Vec> scaled_starts(const Problem& problem, const Vec& x,
                               const std::vector<double>& factors, double spread);
// Makes the starts with these four variations.
std::vector<Vec> starts_of(const Problem& problem, const Vec& x, const std::vector<Vec>& variations,
                           const Vec& spread);

}  // namespace majorant::newton_suite

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
