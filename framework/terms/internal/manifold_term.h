// A term of unknowns on manifolds as a term of their coordinates. On a chart that moves its
// parameters are those of the term and, after them, the bases and the origins of all points.
#pragma once

#include <memory>
#include <vector>

#include "majorant/framework/energy_term.h"
#include "majorant/framework/equality_term.h"
#include "majorant/framework/terms/internal/manifold_points.h"

namespace majorant {

// With the first and second derivatives J and R'' of x by the coordinates of an element, its
// Hessian is
//     J^T H J + sum_k (dE/dx_k) R''_k
// of which negative eigenvalues are taken away where the model is projected. Terms that project by
// a rule of their own (Gauss-Newton, say) keep it: J^T P J, and the second summand as far as the
// model is exact.
class ManifoldTerm : public EnergyTerm {
 public:
  // The chart: the first one, or the one for good.
  enum class ChartIs { Moving, Fixed };
  // An equality is one of the coordinates (EqualityTerm).
  static std::shared_ptr<const ManifoldTerm> make(std::shared_ptr<const EnergyTerm> term,
                                                  std::shared_ptr<const ManifoldPoints> points,
                                                  const ManifoldPoints::Chart& chart,
                                                  ChartIs chart_is = ChartIs::Moving);

  std::string_view name() const override { return term_->name(); }
  const ElementDofs& element_dofs() const override { return element_dofs_; }
  bool supports(Curvature curvature) const override { return term_->supports(curvature); }
  RuleId rule_count() const override { return term_->rule_count(); }
  Index parameter_count() const override { return static_cast<Index>(parameters_.size()); }
  Vec parameters() const override { return parameters_; }
  Index parameters_per_element() const override {
    return chart_is_ == ChartIs::Fixed ? term_->parameters_per_element() : 0;
  }
  void values(VecIn y, const ElementBatch& batch, const TermState& state, Workspace& workspace,
              std::span<double> f) const override;
  void local(VecIn y, const ElementBatch& batch, BlendedCurvature curvature, const TermState& state,
             Workspace& workspace, LocalSystem& out) const override;

  // Returns parameters with another chart and the term's parameters of `state`.
  Vec parameters_on(const ManifoldPoints::Chart& chart, const TermState& state) const;
  // The parameters of the term alone, as they are in `state`.
  Vec own_parameters(const TermState& state) const;
  // Returns the term on this chart for good.
  std::shared_ptr<const ManifoldTerm> fixed(const ManifoldPoints::Chart& chart) const {
    return make(term_, points_, chart, ChartIs::Fixed);
  }

 protected:
  ManifoldTerm(std::shared_ptr<const EnergyTerm> term, std::shared_ptr<const ManifoldPoints> points,
               const ManifoldPoints::Chart& chart, ChartIs chart_is);

 private:
  struct Derivatives;
  TermState inner_state(const TermState& state) const;
  // The bases, after which the origins come.
  const double* chart_of(const TermState& state) const;
  // The unknowns of an element, written to x; their derivatives, unless null.
  void move_element(Index element, VecIn y, const double* chart, double* x,
                    Derivatives* derivatives) const;

  std::shared_ptr<const EnergyTerm> term_;
  std::shared_ptr<const ManifoldPoints> points_;
  ChartIs chart_is_;
  Vec chart_;                 // as the term was made with it
  ElementDofs element_dofs_;  // coordinates, of as many as each element has
  // By element: where the points of its unknowns begin in `owners_`, and these; for each of its
  // local unknowns the place of its coordinate, or of the first one of its point.
  std::vector<std::size_t> owner_starts_;
  std::vector<Index> owners_;
  Cells places_;
  Vec parameters_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
