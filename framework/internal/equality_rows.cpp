#include "majorant/framework/internal/equality_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "majorant/framework/equality_term.h"
#include "majorant/framework/internal/element_visits.h"

namespace majorant {
namespace {

// Conjugate gradients end at this part of the first residual, which is the accuracy of solves with
// the factor.
constexpr double kSaddleTolerance = 1e-14;
// The maximum number of their steps. Eigenvalues of the preconditioned matrix lie in (0, 1], near 1
// for large penalties.
constexpr int kMostSaddleSteps = 100;

Index row_count_of(const Problem& problem, TermId id) {
  return problem.term(id).element_dofs().element_count();
}

Vec parameters_of(const Problem& problem, TermId id) {
  const Vec& now = problem.state(id).parameters;
  return now.size() > 0 ? now : problem.term(id).parameters();
}

}  // namespace

std::vector<TermId> equality_terms(const Problem& problem) {
  std::vector<TermId> ids;
  for (const TermId id : problem.terms())
    if (dynamic_cast<const EqualityTerm*>(&problem.term(id))) ids.push_back(id);
  return ids;
}

EqualityState equality_state(const Problem& problem, const std::vector<TermId>& ids) {
  Index count = 0;
  for (const TermId id : ids) count += row_count_of(problem, id);
  EqualityState state{Vec(count), Vec(count)};
  Index row = 0;
  for (const TermId id : ids) {
    const Vec parameters = parameters_of(problem, id);
    for (Index e = 0; e < row_count_of(problem, id); ++e, ++row) {
      state.multipliers[row] = parameters[2 * e];
      state.penalties[row] = parameters[2 * e + 1];
    }
  }
  return state;
}

TermChanges equality_changes(const Problem& problem, const std::vector<TermId>& ids,
                             const EqualityState& state) {
  TermChanges changes;
  Index row = 0;
  for (const TermId id : ids) {
    Vec parameters = parameters_of(problem, id);
    for (Index e = 0; e < row_count_of(problem, id); ++e, ++row) {
      parameters[2 * e] = state.multipliers[row];
      parameters[2 * e + 1] = state.penalties[row];
    }
    changes.emplace_back(id, TermChange{.parameters = std::move(parameters)});
  }
  return changes;
}

std::vector<Vec> by_equality(const Problem& problem, const std::vector<TermId>& ids,
                             const Vec& rows) {
  std::vector<Vec> parts;
  Index first = 0;
  for (const TermId id : ids) {
    parts.emplace_back(rows.segment(first, row_count_of(problem, id)));
    first += row_count_of(problem, id);
  }
  return parts;
}

std::string place_of(const EnergyTerm& term, Index element) {
  const ElementDofs& dofs = term.element_dofs();
  if (dofs.local_size() == 1) return fmt::format("unknown {}", dofs.nodes(element, 0));
  return fmt::format("element {}, which begins with unknown {}", element,
                     dofs.block * dofs.nodes(element, 0));
}

EqualityRows::EqualityRows(const Problem& problem, std::vector<TermId> ids, const Vec& x)
    : problem_(problem), ids_(std::move(ids)) {
  Index count = 0;
  for (const TermId id : ids_) count += row_count_of(problem_, id);
  values_.resize(count);
  norms_.resize(count);
  Index first = 0;
  for (const TermId id : ids_) {
    const Index elements = row_count_of(problem_, id);
    TermState shows_g;
    shows_g.parameters = parameters_of(problem_, id);
    shows_g.parameters.head(2 * elements) = Eigen::Vector2d(1, 0).replicate(elements, 1);
    Vec values;
    gradients_.push_back(element_gradients(problem_, id, x, shows_g, &values));
    values_.segment(first, elements) = values;
    norms_.segment(first, elements) = gradients_.back().rowwise().norm();
    first += elements;
  }
  scales_ = norms_.cwiseMax(1.0);
}

double EqualityRows::violation(Index* row) const {
  double largest = 0;
  for (Index e = 0; e < count(); ++e) {
    const double amount = std::abs(values_[e]) / scales_[e];
    if (amount <= largest) continue;  // NaN is larger
    largest = amount;
    if (row) *row = e;
  }
  return largest;
}

std::string EqualityRows::name(Index row) const {
  for (const TermId id : ids_) {
    if (row < row_count_of(problem_, id))
      return fmt::format("'{}' at {}", problem_.term(id).name(), place_of(problem_.term(id), row));
    row -= row_count_of(problem_, id);
  }
  return {};
}

template <class Visit>
void EqualityRows::visit(const Visit& visit) const {
  Index row = 0;
  for (std::size_t t = 0; t < ids_.size(); ++t) {
    const ElementDofs& dofs = problem_.term(ids_[t]).element_dofs();
    for (Index e = 0; e < gradients_[t].rows(); ++e, ++row)
      for (Index k = 0; k < gradients_[t].cols(); ++k)
        visit(row, unknown_of(dofs, e, k), gradients_[t](e, k));
  }
}

Vec EqualityRows::times(const Vec& dx) const {
  Vec out = Vec::Zero(count());
  visit([&](Index row, Index unknown, double a) { out[row] += a * dx[unknown]; });
  return out;
}

Vec EqualityRows::transposed_times(const Vec& q) const {
  Vec out = Vec::Zero(problem_.full_size());
  visit([&](Index row, Index unknown, double a) { out[unknown] += a * q[row]; });
  return out;
}

Vec EqualityRows::diagonal_of_squares(const Vec& weights) const {
  Vec out = Vec::Zero(problem_.full_size());
  visit([&](Index row, Index unknown, double a) { out[unknown] += weights[row] * a * a; });
  return out;
}

SaddlePoint solve_with_equalities(const std::function<Vec(const Vec& b)>& solve,
                                  const Elimination& elimination, const EqualityRows& rows,
                                  const Vec& penalties, const Vec& r, const Vec& s) {
  const auto transposed = [&](const Vec& q) {
    Vec out;
    elimination.restrict_gradient(rows.transposed_times(q), out);
    return out;
  };
  const auto times = [&](const Vec& p) {
    Vec dx;
    elimination.expand_direction(p, dx);
    return rows.times(dx);
  };
  SaddlePoint at;
  at.p = solve(r + transposed(penalties.cwiseProduct(s)));
  at.q = Vec::Zero(rows.count());
  Vec residual = times(at.p) - s;
  const auto size = [&] { return std::sqrt(residual.dot(penalties.cwiseProduct(residual))); };
  const double first = size();
  Vec scaled = penalties.cwiseProduct(residual), d = scaled;
  double product = residual.dot(scaled);
  for (int k = 0; k < kMostSaddleSteps && size() > kSaddleTolerance * first; ++k) {
    const Vec p = solve(transposed(d));
    const Vec along = times(p);
    const double curvature = d.dot(along);
    if (!(curvature > 0)) break;
    const double step = product / curvature;
    at.q += step * d;
    at.p -= step * p;
    residual -= step * along;
    scaled = penalties.cwiseProduct(residual);
    const double next = residual.dot(scaled);
    d = scaled + next / product * d;
    product = next;
  }
  at.residual = first > 0 ? size() / first : 0;
  return at;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
