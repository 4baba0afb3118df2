#include "suite.h"

#include <algorithm>
#include <cmath>

namespace majorant::newton_suite {
namespace {

constexpr int kRandomStarts = 5;

}  // namespace

const double* SuiteProblem::minimum_at(double energy) const {
  const auto found = std::find_if(minima.begin(), minima.end(), [energy](double minimum) {
    const double tolerance = minimum == 0 ? kSmallEnergy : kEnergyTolerance * std::abs(minimum);
    return std::abs(energy - minimum) <= tolerance;
  });
  return found == minima.end() ? nullptr : &*found;
}

bool SuiteProblem::accepts(const SolveResult& result) const {
  if (minima.empty())
    return result.status == Status::Failed &&
           static_cast<int>(result.iterations.size()) <= kUnboundedSteps;
  return result.status == Status::Converged && minimum_at(result.energy);
}

// Uses SplitMix64.
double Uniform::operator()() {
  unsigned long long z = state_ += 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  z ^= z >> 31;
  return static_cast<double>(z >> 11) * 0x1p-52 - 1;
}

Vec Uniform::vector(Index size) {
  Vec v(size);
  for (double& entry : v) entry = (*this)();
  return v;
}

Cells runs(Index rows, int columns) {
  Cells cells(rows, columns);
  for (Index e = 0; e < rows; ++e)
    for (int k = 0; k < columns; ++k) cells(e, k) = e + k;
  return cells;
}

Cells grid_edges(Index n) {
  Cells cells(2 * n * (n + 1), 2);
  Index e = 0;
  for (Index j = 0; j <= n; ++j)
    for (Index i = 0; i < n; ++i) {
      const Index across = j * (n + 1) + i, up = i * (n + 1) + j;
      cells.row(e++) << across, across + 1;
      cells.row(e++) << up, up + n + 1;
    }
  return cells;
}

Cells all_unknowns(Index rows, int columns) {
  Cells cells(rows, columns);
  for (int k = 0; k < columns; ++k) cells.col(k).setConstant(k);
  return cells;
}

Vec wave(int k, Index size) {
  Vec v(size);
  for (Index i = 0; i < size; ++i)
    v[i] = std::sin(static_cast<double>(k) * static_cast<double>(i + 1));
  return v;
}

std::vector<Vec> starts_of(const Problem& problem, const Vec& x, const std::vector<Vec>& variations,
                           const Vec& spread) {
  std::vector<Vec> starts{problem.reduce(x)};
  for (const Vec& variation : variations) starts.push_back(problem.reduce(variation));
  for (int k = 0; k < kRandomStarts; ++k)
    starts.push_back(problem.reduce(
        x + spread.cwiseProduct(Uniform(static_cast<unsigned>(k)).vector(x.size()))));
  return starts;
}

std::vector<Vec> starts_around(const Problem& problem, const Vec& x, const Vec& spread) {
  std::vector<Vec> variations;
  for (int k = 1; k <= 4; ++k) variations.push_back(x + spread.cwiseProduct(wave(k, x.size())));
  return starts_of(problem, x, variations, spread);
}

std::vector<Vec> starts_around(const Problem& problem, const Vec& x, double spread) {
  return starts_around(problem, x, Vec::Constant(x.size(), spread));
}

std::vector<Vec> scaled_starts(const Problem& problem, const Vec& x,
                               const std::vector<double>& factors, double spread) {
  std::vector<Vec> variations;
  for (const double factor : factors) variations.push_back(factor * x);
  return starts_of(problem, x, variations, Vec::Constant(x.size(), spread));
}

}  // namespace majorant::newton_suite

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
