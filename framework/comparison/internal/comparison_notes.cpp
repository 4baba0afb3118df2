#include "majorant/framework/comparison/internal/comparison_notes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace majorant {
namespace {

// A gradient this many times as large as that of the other methods gets a note.
constexpr double kLargeGradient = 1e3;
// Smaller gradients, relative to the largest gradient of any run, count as this large: Newton's
// method ends at rounding, methods of first order at the root of their tolerance.
constexpr double kSmallGradient = 1e-8;
// A rise of the energy between two ends that exceeds rounding, relative to the gain of the runs.
constexpr double kRise = 1e-9;
// Minima count as equal if their energies differ by less than this part of the gain.
constexpr double kSameEnergy = 1e-6;
// The places between two ends at which the energy is sampled. They are dense near both ends,
// because the rim of a shallow minimum is close to it.
constexpr double kPlaces[] = {1e-3, 3e-3, 0.01, 0.03, 0.1,  0.2,  0.3,   0.4,  0.5,
                              0.6,  0.7,  0.8,  0.9,  0.97, 0.99, 0.997, 0.999};

constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool has_minimum(const FinishedRun& run) { return run.has_end && run.status == Status::Converged; }

double energy_of(const FinishedRun& run) { return run.run.points.back().energy; }

double largest_gradient(const std::vector<FinishedRun>& runs) {
  double largest = 0;
  for (const FinishedRun& r : runs)
    for (const ComparisonPoint& p : r.run.points)
      if (std::isfinite(p.gradient_norm)) largest = std::max(largest, p.gradient_norm);
  return largest;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void note_gradients(std::vector<FinishedRun>& runs) {
  const double least = kSmallGradient * largest_gradient(runs);
  for (FinishedRun& r : runs) {
    if (!r.has_end) continue;
    std::vector<double> others;
    for (const FinishedRun& other : runs)
      if (&other != &r && other.has_end) others.push_back(other.gradient_norm);
    if (others.empty()) continue;
    const double usual = median(others);
    if (r.gradient_norm > kLargeGradient * std::max(usual, least))
      r.run.notes.push_back(
          fmt::format("stopped with a gradient of {:.1e}, where the others have {:.1e}",
                      r.gradient_norm, usual));
  }
}

void note_saddles(std::vector<FinishedRun>& runs) {
  for (FinishedRun& r : runs)
    if (r.has_end && r.run.definite == Definite::No)
      r.run.notes.push_back("the exact Hessian is indefinite where it ended: no minimum");
}

// Returns the rise of the energy that `run` minimized, on the line from its end to the other end.
double rise_between(const FinishedRun& run, const FinishedRun& other) {
  Evaluator evaluator(run.problem);
  const double ends = std::max(evaluator.value(run.y), evaluator.value(other.y));
  double most = -kInfinity;
  for (const double t : kPlaces)
    most = std::max(most, evaluator.value((1 - t) * run.y + t * other.y));
  return most - ends;
}

// Returns the rise of the energy along the retraction of unknowns that lie on manifolds.
double rise_around(const FinishedRun& run, const FinishedRun& other,
                   const ManifoldProblem& manifolds) {
  double most = -kInfinity;
  for (const double t : kPlaces) {
    Vec y;
    const Problem problem = manifolds.around((1 - t) * run.run.x + t * other.run.x, &y);
    most = std::max(most, Evaluator(problem).value(y));
  }
  return most - std::max(energy_of(run), energy_of(other));
}

}  // namespace

void compare_ends(std::vector<FinishedRun>& runs, const ManifoldProblem* manifolds,
                  bool compares_points) {
  note_saddles(runs);
  note_gradients(runs);
  double least = kInfinity, start = -kInfinity;
  const bool converges = std::any_of(runs.begin(), runs.end(), has_minimum);
  for (const FinishedRun& r : runs) {
    if (!r.has_end || has_minimum(r) != converges) continue;
    least = std::min(least, energy_of(r));
    if (std::isfinite(r.run.points.front().energy))
      start = std::max(start, r.run.points.front().energy);
  }
  if (!std::isfinite(least)) return;
  const double scale = start > least ? start - least : std::abs(least);
  // The first run with the least energy.
  const auto best = std::find_if(runs.begin(), runs.end(), [&](const FinishedRun& r) {
    return r.has_end && has_minimum(r) == converges && energy_of(r) <= least + kSameEnergy * scale;
  });
  for (FinishedRun& r : runs) {
    if (!r.has_end) continue;
    const double distance = (r.run.x - best->run.x).norm();
    if (compares_points) r.run.distance = distance;
    if (&r == &*best || distance == 0 || !has_minimum(r) || !converges) continue;
    const double above = energy_of(r) - energy_of(*best);
    const bool is_same_energy = above <= kSameEnergy * scale;
    if (is_same_energy && !compares_points) continue;
    const double rise = manifolds ? rise_around(r, *best, *manifolds) : rise_between(r, *best);
    if (!(rise > kRise * std::max(scale, std::abs(least)))) {
      if (!is_same_energy && r.run.notes.empty())  // otherwise a note gives the reason
        r.run.notes.push_back(
            fmt::format("ended higher than {} by {:.2e}, and no energy in between is higher than "
                        "both: this is no minimum, or not yet",
                        best->run.method, above));
      continue;
    }
    r.run.notes.push_back(
        is_same_energy
            ? fmt::format("ended at another minimum of the same energy than {}, {:.2e} away",
                          best->run.method, distance)
            : fmt::format("ended at another minimum than {}: energy higher by {:.2e}, {:.2e} away",
                          best->run.method, above, distance));
  }
}

std::vector<std::string> derivative_notes(const Problem& problem, const Vec& y,
                                          const std::string& where) {
  std::vector<std::string> notes;
  const Vec x = problem.expand(y);
  for (const TermId id : problem.terms()) {
    const TermState& state = problem.state(id);
    if (state.weight == 0 || !element_values(problem, id, x).allFinite()) continue;
    const EnergyTerm& term = problem.term(id);
    const DerivativeReport report = check_derivatives(term, x, 1e-5, state);
    // At a minimum of 0, for example, differences do not resolve derivatives and prove nothing.
    std::vector<DerivativeMismatch> wrong = report.mismatches;
    std::erase_if(wrong, [](const DerivativeMismatch& m) {
      return m.block.find("not resolved") != std::string::npos;
    });
    if (wrong.empty()) continue;
    const auto of_gradient = std::find_if(
        wrong.begin(), wrong.end(), [](const auto& m) { return m.block.starts_with("gradient"); });
    const bool is_gradient = of_gradient != wrong.end();
    const DerivativeMismatch& first = is_gradient ? *of_gradient : wrong.front();
    notes.push_back(
        fmt::format("the {} of term '{}' disagrees with finite differences {}: element {}, {} is "
                    "{:.6g}, differences say {:.6g} (wrong, or a kink is there)",
                    is_gradient ? "gradient" : "curvature", term.name(), where, first.element,
                    first.block, first.computed, first.expected));
  }
  return notes;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
