#include "majorant/framework/internal/term_derivatives.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>
#include <utility>

#include "majorant/framework/argument_check.h"
#include "majorant/framework/error.h"
#include "majorant/framework/internal/element_visits.h"
#include "majorant/framework/internal/sensitivity_refusal.h"
#include "majorant/framework/parallel.h"
#include "majorant/framework/problem_parts.h"

namespace majorant {
namespace {

// The step of four-point differences of gradients, relative to a parameter. Their error is about
// its fourth power, and their rounding is 1e-16 divided by it.
constexpr double kDifference = 1e-3;
// The points, as multiples of the step, and their coefficients.
constexpr std::pair<double, double> kStencil[] = {
    {1, 8.0 / 12}, {-1, -8.0 / 12}, {2, -1.0 / 12}, {-2, 1.0 / 12}};
// Up to this many parameters that all elements see, each is varied for all elements.
constexpr Index kFewParameters = 64;
// Elements are moved by this part of the unknowns' mean size to find the parameters on which they
// depend: at a minimum their energies may be 0 for all parameters.
constexpr double kDisplacement = 1e-3;
// The elements of a task: some 0.1 ms.
constexpr Index kElementsOfATask = 4096;

// Returns the size of each parameter, for steps: its own, or the mean of all.
Vec sizes_of(const Vec& parameters) {
  const double mean = parameters.size() > 0 ? parameters.cwiseAbs().mean() : 0;
  const double least = mean > 0 ? mean : 1.0;
  return parameters.cwiseAbs().cwiseMax(least);
}

}  // namespace

// Returns the place of a term. Throws InvalidArgument for an id that does not exist.
std::size_t TermDerivatives::place_of(TermId id) const {
  problem_.term(id);
  return static_cast<std::size_t>(id);
}

const TermDerivatives::OfTerm& TermDerivatives::of(TermId id) {
  OfTerm& parts = terms_[place_of(id)];
  if (parts.gradient.size() > 0) return parts;
  const TermState& state = problem_.state(id);
  parts.gradients = element_gradients(problem_, id, x_, state);
  parts.gradient = Vec::Zero(problem_.full_size());
  add(id, parts.gradients, 1,
      state.element_weight.size() > 0 ? state.element_weight : Vec::Ones(parts.gradients.rows()),
      parts.gradient);
  return parts;
}

// Adds, for each element, its local gradients by K numbers (rows of #E by local_size() K) times
// these numbers.
void TermDerivatives::add(TermId id, const RowMatrix& gradients, Index count, const Vec& numbers,
                          Vec& full) const {
  const ElementDofs& dofs = problem_.term(id).element_dofs();
  const Index n = dofs.local_size();
  for (Index e = 0; e < gradients.rows(); ++e)
    for (Index j = 0; j < count; ++j) {
      const double number = numbers[count * e + j];
      if (number == 0) continue;
      for (Index k = 0; k < n; ++k)
        full[unknown_of(dofs, e, k)] += number * gradients(e, n * j + k);
    }
}

// Returns the product with the transpose: K numbers of each element.
Vec TermDerivatives::products(TermId id, const RowMatrix& gradients, Index count,
                              const Vec& ux) const {
  const ElementDofs& dofs = problem_.term(id).element_dofs();
  const Index n = dofs.local_size();
  Vec out(count * gradients.rows());
  parallel_for(static_cast<Index>(gradients.rows()), kElementsOfATask, [&](Index e) {
    for (Index j = 0; j < count; ++j) {
      double sum = 0;
      for (Index k = 0; k < n; ++k) sum += gradients(e, n * j + k) * ux[unknown_of(dofs, e, k)];
      out[count * e + j] = sum;
    }
  });
  return out;
}

void TermDerivatives::add_element_weights(TermId id, const Vec& change, Vec& full) {
  const OfTerm& parts = of(id);
  require_size("Sensitivity: element_weights", change.size(), parts.gradients.rows());
  require_finite("Sensitivity: element_weights", change);
  add(id, parts.gradients, 1, problem_.state(id).weight * change, full);
}

[[noreturn]] void TermDerivatives::refuse_parameters(TermId id) const {
  refuse_sensitivity(
      fmt::format("term '{}' is not finite beside its parameters", problem_.term(id).name()));
}

// Returns the parameters of a term: those of its state, or its initial ones.
Vec TermDerivatives::parameters_of(TermId id) const {
  const Vec& now = problem_.state(id).parameters;
  if (now.size() > 0) return now;
  return problem_.term(id).parameters();
}

// Returns the derivative of the reduced gradient along a change of parameters, by differences.
Vec TermDerivatives::along_parameters(TermId id, const Vec& base, const Vec& change) const {
  const double h = kDifference / change.cwiseAbs().cwiseQuotient(sizes_of(base)).maxCoeff();
  Vec sum = Vec::Zero(problem_.size()), gradient;
  Evaluator evaluator(problem_);
  for (const auto& [multiple, coefficient] : kStencil) {
    evaluator.reset(problem_.with({{id, {.parameters = base + multiple * h * change}}}));
    const double energy = evaluator.gradient(id, y_, gradient);
    if (!std::isfinite(energy) || !gradient.allFinite()) refuse_parameters(id);
    sum += coefficient / h * gradient;
  }
  return sum;
}

void TermDerivatives::add_parameters(TermId id, const Vec& change, Vec& full, Vec& reduced) {
  require_parameters(id, change);
  if (change.isZero(0)) return;
  const OfTerm& parts = terms_[place_of(id)];
  const TermState& state = problem_.state(id);
  if (parts.by_shared.size() > 0) {
    reduced += parts.by_shared * change;
  } else if (parts.by_parameters.size() > 0) {
    const Index own = std::max(problem_.term(id).parameters_per_element(), 1);
    const auto elements = static_cast<Index>(parts.by_parameters.rows());
    Vec numbers(own * elements);
    for (Index e = 0; e < elements; ++e)
      for (Index j = 0; j < own; ++j) {
        const Index k = parts.parameter.empty() ? own * e + j : parts.parameter[to_size(e)];
        numbers[own * e + j] = k < 0 ? 0 : weight_of(state, e) * change[k];
      }
    add(id, parts.by_parameters, own, numbers, full);
  } else {
    reduced += along_parameters(id, parameters_of(id), change);
  }
}

void TermDerivatives::require_parameters(TermId id, const Vec& change) const {
  const EnergyTerm& term = problem_.term(id);
  if (term.parameter_count() == 0 || change.size() != term.parameter_count())
    throw InvalidArgument(fmt::format("Sensitivity: term '{}' takes {} parameters, not {}",
                                      term.name(), term.parameter_count(), change.size()));
  require_finite("Sensitivity: parameters", change);
}

Vec TermDerivatives::by_parameters(TermId id, const Vec& u, const Vec& ux) {
  const EnergyTerm& term = problem_.term(id);
  const Index count = term.parameter_count();
  if (count == 0) return Vec();
  OfTerm& parts = terms_[place_of(id)];
  if (parts.by_parameters.size() == 0 && parts.by_shared.size() == 0)
    differentiate_by_parameters(id, parts);
  if (parts.by_shared.size() > 0) return -(parts.by_shared.transpose() * u);
  const Index own = std::max(term.parameters_per_element(), 1);
  const Vec slopes = products(id, parts.by_parameters, own, ux);
  Vec out = Vec::Zero(count);
  const TermState& state = problem_.state(id);
  for (Index e = 0; e < parts.by_parameters.rows(); ++e)
    for (Index j = 0; j < own; ++j) {
      const Index k = parts.parameter.empty() ? own * e + j : parts.parameter[to_size(e)];
      if (k >= 0) out[k] -= weight_of(state, e) * slopes[own * e + j];
    }
  return out;
}

void TermDerivatives::differentiate_by_parameters(TermId id, OfTerm& parts) {
  const EnergyTerm& term = problem_.term(id);
  const Index count = term.parameter_count(), own = term.parameters_per_element();
  const Vec base = parameters_of(id);
  if (own == 0 && count <= kFewParameters) {
    parts.by_shared.resize(problem_.size(), count);
    for (Index k = 0; k < count; ++k)
      parts.by_shared.col(k) = along_parameters(id, base, Vec::Unit(count, k));
    return;
  }
  const Vec size = kDifference * sizes_of(base);
  if (own == 0) parts.parameter = parameter_of_elements(id, base, size);
  const Index n = term.element_dofs().local_size(), steps = std::max(own, 1);
  parts.by_parameters.resize(term.element_dofs().element_count(), n * steps);
  TermState state = problem_.state(id);
  for (Index j = 0; j < steps; ++j) {
    Vec step = own == 0 ? size : Vec(Vec::Zero(count));
    for (Index k = j; own > 0 && k < count; k += own) step[k] = size[k];
    auto slopes = parts.by_parameters.middleCols(n * j, n);
    slopes.setZero();
    for (const auto& [multiple, coefficient] : kStencil) {
      state.parameters = base + multiple * step;
      slopes += coefficient * element_gradients(problem_, id, x_, state);
    }
    for (Index e = 0; e < slopes.rows(); ++e) {
      const Index k = own > 0 ? own * e + j : parts.parameter[to_size(e)];
      slopes.row(e) *= k < 0 ? 0 : 1 / size[k];
    }
  }
  if (!parts.by_parameters.allFinite()) {
    parts.by_parameters.resize(0, 0);
    refuse_parameters(id);
  }
}

// Returns the one parameter on which each element depends, -1 for none. For each bit, the
// parameters whose numbers have the bit are changed, then all others; the energies that change
// give the bits of the number.
std::vector<Index> TermDerivatives::parameter_of_elements(TermId id, const Vec& base,
                                                          const Vec& size) const {
  const Index elements = problem_.term(id).element_dofs().element_count();
  Vec at;
  const auto energies = [&](const Vec& parameters) {
    TermState state = problem_.state(id);
    state.parameters = parameters;
    return element_values(problem_.with({{id, state}}), id, at);
  };
  const Vec before = displaced(id, at);
  std::vector<Index> seen(to_size(elements), 0);
  std::vector<char> depends(to_size(elements), 0);
  const int bits = std::bit_width(static_cast<unsigned>(base.size() - 1));
  for (int bit = 0; bit < bits; ++bit) {
    Vec with = base, without = base;
    for (Index k = 0; k < base.size(); ++k) ((k >> bit & 1) ? with : without)[k] += size[k];
    const Vec set = energies(with), clear = energies(without);
    for (Index e = 0; e < elements; ++e) {
      const bool by_set = set[e] != before[e], by_clear = clear[e] != before[e];
      if (by_set && by_clear)
        refuse_sensitivity(
            fmt::format("element {} of term '{}' depends on several of {} parameters that all "
                        "elements see; give each element a row of its own",
                        e, problem_.term(id).name(), base.size()));
      depends[to_size(e)] = depends[to_size(e)] || by_set || by_clear;
      if (by_set) seen[to_size(e)] |= Index{1} << bit;
    }
  }
  for (std::size_t e = 0; e < seen.size(); ++e)
    if (!depends[e]) seen[e] = -1;
  return seen;
}

// Returns the energies of the elements at a point near x_ that is in the domain, too.
Vec TermDerivatives::displaced(TermId id, Vec& at) const {
  std::minstd_rand random(1);
  Vec by(x_.size());
  for (double& entry : by) entry = static_cast<double>(random()) / std::minstd_rand::max() - 0.5;
  const double size = x_.norm() / std::sqrt(static_cast<double>(x_.size()));
  for (double step = kDisplacement * (size > 0 ? size : 1.0);; step /= 4) {
    at = x_ + step * by;
    Vec values = element_values(problem_, id, at);
    if (values.allFinite()) return values;
    if (!(step > 0)) refuse_parameters(id);
  }
}

Vec TermDerivatives::by_element_weights(TermId id, const Vec& ux) {
  return -problem_.state(id).weight * products(id, of(id).gradients, 1, ux);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
