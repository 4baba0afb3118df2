#include "majorant/framework/terms/quadratic_penalty.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "majorant/framework/error.h"

namespace majorant {

namespace {

std::vector<LinearExpression> expressions(const Constraint& constraint) {
  ConstraintRows rows;
  constraint.append_rows(rows);
  rows.require_ended();
  if (rows.auxiliary_count() > 0)
    throw InvalidArgument("QuadraticPenalty: the constraint has auxiliary unknowns");
  std::vector<LinearExpression> out;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    out.push_back({{}, rows.rhs(r)});
    for (const auto* e = rows.begin(r); e != rows.end(r); ++e)
      out.back().terms.emplace_back(e->unknown, e->coefficient);
  }
  return out;
}

}  // namespace

QuadraticPenalty::QuadraticPenalty(const Constraint& constraint)
    : QuadraticPenalty(expressions(constraint)) {}

QuadraticPenalty::QuadraticPenalty(const std::vector<LinearExpression>& rows) {
  std::size_t longest = 1;
  for (const LinearExpression& row : rows) {
    if (row.terms.empty() || row.terms.size() > kLongestRow)
      throw InvalidArgument("QuadraticPenalty: a row of " + std::to_string(row.terms.size()) +
                            " unknowns; 1 to " + std::to_string(kLongestRow) + " can be");
    for (const auto& [unknown, coefficient] : row.terms)
      if (unknown < 0 || !std::isfinite(coefficient))
        throw InvalidArgument("QuadraticPenalty: unknown " + std::to_string(unknown) +
                              " with coefficient " + std::to_string(coefficient));
    if (!std::isfinite(row.target))
      throw InvalidArgument("QuadraticPenalty: a target is not finite");
    longest = std::max(longest, row.terms.size());
  }
  const auto count = static_cast<Index>(rows.size());
  element_dofs_.nodes.resize(count, static_cast<Index>(longest));
  coefficients_.setZero(count, static_cast<Index>(longest));
  rhs_.resize(count);
  for (Index r = 0; r < count; ++r) {
    const LinearExpression& row = rows[static_cast<std::size_t>(r)];
    element_dofs_.nodes.row(r).setConstant(row.terms.front().first);
    for (std::size_t k = 0; k < row.terms.size(); ++k) {
      element_dofs_.nodes(r, static_cast<Index>(k)) = row.terms[k].first;
      coefficients_(r, static_cast<Index>(k)) = row.terms[k].second;
    }
    rhs_[r] = row.target;
  }
}

double QuadraticPenalty::residual(VecIn x, Index row, const TermState& state) const {
  double sum = -(state.parameters.size() > 0 ? state.parameters : rhs_)[row];
  for (Index k = 0; k < coefficients_.cols(); ++k)
    sum += coefficients_(row, k) * x[element_dofs_.nodes(row, k)];
  return sum;
}

void QuadraticPenalty::values(VecIn x, const ElementBatch& batch, const TermState& state,
                              Workspace&, std::span<double> f) const {
  for (std::size_t p = 0; p < batch.elements.size(); ++p) {
    const double r = residual(x, batch.elements[p], state);
    f[p] = r * r;
  }
}

void QuadraticPenalty::local(VecIn x, const ElementBatch& batch, BlendedCurvature,
                             const TermState& state, Workspace&, LocalSystem& out) const {
  constexpr int stride = LocalSystem::stride;
  const auto columns = static_cast<int>(coefficients_.cols());
  for (std::size_t p = 0; p < batch.elements.size(); ++p) {
    const Index row = batch.elements[p];
    const double r = residual(x, row, state);
    out.value[p] = r * r;
    for (int i = 0, k = 0; i < columns; ++i) {
      out.gradient[static_cast<std::size_t>(i * stride) + p] = 2 * r * coefficients_(row, i);
      if (!out.hessian) continue;
      for (int j = 0; j <= i; ++j, ++k)
        out.hessian[static_cast<std::size_t>(k * stride) + p] =
            2 * coefficients_(row, i) * coefficients_(row, j);
    }
  }
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
