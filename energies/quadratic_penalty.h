// Linear constraints made soft: sum over rows of (a.x - b)^2.
//
//   builder.add(std::make_shared<QuadraticPenalty>(FixedPoints(handles)), 1e3 / area);
//
// Any Constraint can be given: what it would hold exactly is now pulled at. Row weights are
// TermState::element_weight. Not for what must hold: large weights slow the solver down and still
// leave a residual; eliminate instead (ProblemBuilder::add(constraint)).
#pragma once

#include <vector>

#include "majorant/framework/constraint.h"
#include "majorant/framework/energy_term.h"

namespace majorant {

class QuadraticPenalty final : public EnergyTerm {
 public:
  // One element per row. Throws std::invalid_argument when a row has no unknowns.
  explicit QuadraticPenalty(const Constraint& constraint);

  std::string_view name() const override { return "quadratic penalty"; }
  const Stencils& stencils() const override { return stencils_; }
  bool supports(Curvature) const override { return true; }  // exact, constant, PSD
  void values(VecIn x, const Chunk& chunk, const TermState& state, Workspace& workspace,
              std::span<double> f) const override;
  void local(VecIn x, const Chunk& chunk, Curvature curvature, const TermState& state,
             Workspace& workspace, LocalSystem& out) const override;

 private:
  double residual(VecIn x, Index row) const;
  Stencils stencils_;             // short rows repeat an unknown of theirs, with coefficient 0
  Eigen::MatrixXd coefficients_;  // #rows by longest row
  Vec rhs_;
};

}  // namespace majorant
