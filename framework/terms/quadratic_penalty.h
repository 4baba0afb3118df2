// Linear constraints made soft: sum over rows of (a.x - b)^2.
//
//   builder.add(std::make_shared<QuadraticPenalty>(FixedPoints({{12, {0.1, 0.2}}})), 1e3 / area);
//
//   builder.add(std::make_shared<QuadraticPenalty>(std::vector<LinearExpression>{
//       {{{2 * 12, 0.3}, {2 * 13, 0.7}}, 1.5}}), 10);            // 0.3 u_12 + 0.7 u_13 -> 1.5
//
// It takes any Constraint and penalizes its rows instead of eliminating them. Row weights are
// TermState::element_weight. Targets may change between steps: they are TermState::parameters, one
// a row. Rows of n unknowns have dense n by n Hessians, so rows should be short. Not for conditions
// that must hold: large weights slow the solver down and still leave a residual; eliminate instead
// (ProblemBuilder::add(constraint)).
#pragma once

#include <utility>
#include <vector>

#include "majorant/framework/constraint.h"
#include "majorant/framework/energy_term.h"

namespace majorant {

// The sum of coefficient * unknown, which should equal `target`.
struct LinearExpression {
  std::vector<std::pair<Index, double>> terms;  // (unknown, coefficient)
  double target = 0;
};

class QuadraticPenalty final : public EnergyTerm {
 public:
  static constexpr std::size_t kLongestRow = 512;
  // Makes an element of each row. Throws InvalidArgument for a row without unknowns, or with more
  // than kLongestRow.
  explicit QuadraticPenalty(const std::vector<LinearExpression>& rows);
  explicit QuadraticPenalty(const Constraint& constraint);

  std::string_view name() const override { return "quadratic penalty"; }
  const ElementDofs& element_dofs() const override { return element_dofs_; }
  bool supports(Curvature) const override { return true; }  // exact, constant, PSD
  Index parameter_count() const override { return static_cast<Index>(rhs_.size()); }
  Vec parameters() const override { return rhs_; }
  Index parameters_per_element() const override { return 1; }
  void values(VecIn x, const ElementBatch& batch, const TermState& state, Workspace& workspace,
              std::span<double> f) const override;
  void local(VecIn x, const ElementBatch& batch, BlendedCurvature curvature, const TermState& state,
             Workspace& workspace, LocalSystem& out) const override;

 private:
  double residual(VecIn x, Index row, const TermState& state) const;
  ElementDofs element_dofs_;      // short rows repeat an unknown with coefficient 0
  Eigen::MatrixXd coefficients_;  // #rows by longest row
  Vec rhs_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
