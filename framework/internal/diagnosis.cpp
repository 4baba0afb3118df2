#include "majorant/framework/internal/diagnosis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "majorant/framework/partition.h"
#include "majorant/framework/problem_parts.h"

namespace majorant {
namespace {

// The distances along the negative gradient, relative to the size of the point, at which the energy
// is sampled. At the last one doubles still resolve the change of a linear energy.
constexpr double kProbes[] = {1, 1e4, 1e8, 1e12};

bool counts(const TermState& state, Index e) {
  return state.weight != 0 && (state.element_weight.size() == 0 || state.element_weight[e] != 0);
}

std::string number(double v) { return std::isnan(v) ? "NaN" : fmt::format("{}", v); }

std::string place(std::string_view what, double v, Index element, std::string_view term) {
  return fmt::format("{} is {} in element {} of term '{}'", what, number(v), element, term);
}

// Returns the first entry that is not finite, of `count` values of the element at position p, or
// null.
const double* not_finite(const double* values, std::size_t count, std::size_t p) {
  for (std::size_t k = 0; k < count; ++k)
    if (const double* v = values + k * LocalSystem::stride + p; !std::isfinite(*v)) return v;
  return nullptr;
}

// Names the first of a term's gradients and Hessians at x that is not finite; "" if all are.
std::string not_finite_derivative(const Problem& problem, TermId id, VecIn x) {
  const EnergyTerm& term = problem.term(id);
  const TermState& state = problem.state(id);
  const ColoredBatches& plan = ProblemParts::plan(problem, id);
  const auto n = to_size(term.element_dofs().local_size());
  const Curvature model = *std::find_if(std::begin(kCurvatures), std::end(kCurvatures) - 1,
                                        [&](Curvature c) { return term.supports(c); });
  Workspace kernel, memory;
  LocalSystem local;
  local.value = memory.reserve((1 + n + n * (n + 1) / 2) * to_size(LocalSystem::stride));
  local.gradient = local.value + LocalSystem::stride;
  local.hessian = local.gradient + n * LocalSystem::stride;
  for (Index c = 0; c < plan.batch_count(); ++c) {
    const ElementBatch batch = plan.batch(c);
    term.local(x, batch, model, state, kernel, local);
    for (std::size_t p = 0; p < batch.elements.size(); ++p) {
      if (!counts(state, batch.elements[p])) continue;
      if (const double* v = not_finite(local.gradient, n, p))
        return place("gradient", *v, batch.elements[p], term.name());
      if (const double* v = not_finite(local.hessian, n * (n + 1) / 2, p))
        return place("Hessian", *v, batch.elements[p], term.name());
    }
  }
  return {};
}

// Returns the norm without overflow, also for vectors of 1e154 and more.
double stable_norm(const Partition& partition, VecIn v) {
  if (partition.is_whole()) return v.stableNorm();
  const double largest = partition.max(v.size() > 0 ? v.cwiseAbs().maxCoeff() : 0);
  return largest > 0 ? largest * partition.norm(v / largest) : 0;
}

// Returns the lowest sampled energy if the energy falls along p faster and faster, without an
// objection of a checker.
std::optional<double> falls_forever(Evaluator& evaluator, VecIn y, double energy, const Vec& p) {
  const Partition& partition = partition_of(evaluator.problem());
  const double length = std::max(1.0, stable_norm(partition, y)) / stable_norm(partition, p);
  double before = energy, fallen = 0;
  for (const double probe : kProbes) {
    const Vec there = y + probe * length * p;
    if (!partition.all_finite(there) || evaluator.violation(evaluator.problem().expand(there)))
      return {};
    const double value = evaluator.value(there);
    if (!(before - value > 2 * fallen)) return {};
    fallen = before - value;
    before = value;
    if (!std::isfinite(value)) break;
  }
  return before;
}

// Returns whether a curvature model is all zeros.
bool is_flat(Evaluator& evaluator, VecIn y, Curvature curvature) {
  Vec gradient, hessian;
  evaluator.linearize(y, curvature, gradient, hessian);
  return partition_of(evaluator.problem()).all(hessian.isZero(0));
}

}  // namespace

std::string why_not_finite(const Problem& problem, VecIn x) {
  for (const TermId id : problem.terms()) {
    const std::string_view name = problem.term(id).name();
    const Vec f = element_values(problem, id, x);
    Index first = -1, count = 0, used = 0;
    for (Index e = 0; e < f.size(); ++e) {
      if (!counts(problem.state(id), e)) continue;
      ++used;
      if (std::isfinite(f[e])) continue;
      if (++count == 1 || (std::isnan(f[e]) && !std::isnan(f[first]))) first = e;
    }
    if (count == 0) continue;
    if (count == used && !std::isnan(f[first]) && count > 1)
      return fmt::format("value is infinite, or was NaN, in all {} elements of term '{}'", count,
                         name);
    return fmt::format("{} ({} of {} elements are not finite)",
                       place("value", f[first], first, name), count, used);
  }
  return "the sum of its elements leaves the range of doubles";
}

std::string why_no_direction(Evaluator& evaluator, VecIn y, double energy, Curvature curvature) {
  const Problem& problem = evaluator.problem();
  const Vec x = problem.expand(y);
  for (const TermId id : problem.terms()) {
    const std::string where = not_finite_derivative(problem, id, x);
    if (partition_of(problem).any(!where.empty()))
      return "no finite direction: " + (where.empty() ? "another rank says why" : where);
  }
  if (std::string text = unbounded_along_gradient(evaluator, y, energy); !text.empty()) return text;
  if (!problem.supports(curvature) || !is_flat(evaluator, y, curvature))
    return "no finite direction: no shift makes the Hessian positive definite";
  if (problem.supports(Curvature::Exact) && !is_flat(evaluator, y, Curvature::Exact))
    return "no direction: the energy has no positive curvature here, its Hessian has no positive "
           "eigenvalue";
  return "no direction: the energy has no curvature here, its Hessian is 0";
}

std::string unbounded_along_gradient(Evaluator& evaluator, VecIn y, double energy) {
  Vec gradient;
  evaluator.gradient(y, gradient);
  const Partition& partition = partition_of(evaluator.problem());
  if (partition.all(gradient.isZero(0)) || !partition.all_finite(gradient)) return {};
  const auto value = falls_forever(evaluator, y, energy, -gradient);
  return value ? unbounded_below(*value) + " along its negative gradient" : "";
}

std::string unbounded_below(double energy) {
  return fmt::format("unbounded below: the energy falls to {:.3g}", energy);
}

std::string falls_without_end(double energy, double norm) {
  return fmt::format(
      "unbounded below: the energy falls to {:.3g} while the unknowns grow to {:.3g}", energy,
      norm);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
