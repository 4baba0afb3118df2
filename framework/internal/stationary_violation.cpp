#include "majorant/framework/internal/stationary_violation.h"

#include <cmath>

#include "majorant/framework/internal/element_visits.h"
#include "majorant/framework/problem_parts.h"

namespace majorant {

double gradient_part(const Problem& stage, const std::vector<TermId>& violations, const Vec& y) {
  const Vec x = stage.expand(y);
  const Elimination& elimination = ProblemParts::elimination(stage);
  Vec parts = Vec::Zero(stage.size());
  for (const TermId id : violations) {
    const TermState& state = stage.state(id);
    const ElementDofs& dofs = stage.term(id).element_dofs();
    const RowMatrix gradients = element_gradients(stage, id, x, state);
    for (Index e = 0; e < gradients.rows(); ++e) {
      const double weight =
          state.weight * (state.element_weight.size() > 0 ? state.element_weight[e] : 1.0);
      for (Index k = 0; k < gradients.cols(); ++k)
        for (const auto& entry : elimination.row(unknown_of(dofs, e, k)))
          parts[entry.reduced] += std::abs(weight * gradients(e, k) * entry.coefficient);
    }
  }
  Vec gradient;
  Evaluator(stage).gradient(y, gradient);
  const double size = parts.norm();
  return size > 0 ? gradient.norm() / size : 0;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
