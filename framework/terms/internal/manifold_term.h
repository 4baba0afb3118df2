// A term of unknowns on manifolds as a term of their coordinates. Its parameters are those of the
// term, followed by the bases and the origins of all points.
#pragma once

#include <memory>
#include <vector>

#include "majorant/framework/energy_term.h"
#include "majorant/framework/terms/internal/manifold_points.h"

namespace majorant {

// With the first and second derivatives J and R'' of x by the coordinates of an element, its
// Hessian is
//     J^T H J + sum_k (dE/dx_k) R''_k
// If the model is projected, negative eigenvalues of this sum are removed. Terms with a projection
// of their own, such as Gauss-Newton, keep it: J^T P J, plus the second summand times the exact
// part of the model.
class ManifoldTerm final : public EnergyTerm {
 public:
  ManifoldTerm(std::shared_ptr<const EnergyTerm> term, std::shared_ptr<const ManifoldPoints> points,
               const ManifoldPoints::Chart& chart);

  std::string_view name() const override { return term_->name(); }
  const ElementDofs& element_dofs() const override { return element_dofs_; }
  bool supports(Curvature curvature) const override { return term_->supports(curvature); }
  RuleId rule_count() const override { return term_->rule_count(); }
  Index parameter_count() const override { return static_cast<Index>(parameters_.size()); }
  Vec parameters() const override { return parameters_; }
  void values(VecIn y, const ElementBatch& batch, const TermState& state, Workspace& workspace,
              std::span<double> f) const override;
  void local(VecIn y, const ElementBatch& batch, BlendedCurvature curvature, const TermState& state,
             Workspace& workspace, LocalSystem& out) const override;

  // Returns parameters with another chart and the term's parameters of `state`.
  Vec parameters_on(const ManifoldPoints::Chart& chart, const TermState& state) const;

 private:
  struct Derivatives;
  TermState inner_state(const TermState& state) const;
  // Writes the unknowns of an element to x, and their derivatives unless that is null.
  void move_element(Index element, VecIn y, const double* chart, double* x,
                    Derivatives* derivatives) const;

  std::shared_ptr<const EnergyTerm> term_;
  std::shared_ptr<const ManifoldPoints> points_;
  ElementDofs element_dofs_;  // coordinates, as many as each element has
  // By element: the start of its points in `owners_`, and these points. For each of its local
  // unknowns: the place of its coordinate, or of the first coordinate of its point.
  std::vector<std::size_t> owner_starts_;
  std::vector<Index> owners_;
  Cells places_;
  Vec parameters_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
