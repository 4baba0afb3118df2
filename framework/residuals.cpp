#include "majorant/framework/residuals.h"

#include <cmath>
#include <string>
#include <vector>

#include "majorant/framework/argument_check.h"
#include "majorant/framework/error.h"
#include "majorant/framework/partition.h"
#include "majorant/framework/problem_parts.h"

namespace majorant {

Residuals residuals_at(const Problem& problem, TermId id, VecIn y) {
  require_size("residuals_at: y", y.size(), problem.size());
  if (partition_of(problem).ranks().count() > 1)
    throw InvalidArgument("residuals_at: the problem is that of several processes");
  const EnergyTerm& term = problem.term(id);
  const auto* squares = dynamic_cast<const ResidualTerm*>(&term);
  if (!squares)
    throw Error(ErrorKind::Unsupported,
                "residuals_at: term '" + std::string(term.name()) + "' is no sum of squares");
  const TermState& state = problem.state(id);
  const ElementDofs& dofs = term.element_dofs();
  const Elimination& z = ProblemParts::elimination(problem);
  const Vec x = problem.expand(y);
  std::vector<double> values;
  std::vector<Eigen::Triplet<double>> entries;
  Vec r;
  RowMatrix J;
  for (Index e = 0; e < dofs.element_count(); ++e) {
    squares->residuals(x, e, state, r, &J);
    const double weight =
        state.element_weight.size() > 0 ? state.weight * state.element_weight[e] : state.weight;
    const double root = std::sqrt(weight);
    for (Index i = 0; i < r.size(); ++i) {
      const auto row = static_cast<Index>(values.size());
      values.push_back(root * r[i]);
      for (Index k = 0; k < dofs.local_size(); ++k)
        for (const auto& entry : z.row(dofs.block * dofs.nodes(e, k / dofs.block) + k % dofs.block))
          entries.emplace_back(row, entry.reduced, root * J(i, k) * entry.coefficient);
    }
  }
  Residuals all;
  all.values = Eigen::Map<const Vec>(values.data(), static_cast<Index>(values.size()));
  all.jacobian.resize(all.values.size(), problem.size());
  all.jacobian.setFromTriplets(entries.begin(), entries.end());
  return all;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
