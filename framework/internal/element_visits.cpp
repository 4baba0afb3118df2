#include "majorant/framework/internal/element_visits.h"

#include "majorant/framework/problem_parts.h"

namespace majorant {

RowMatrix element_gradients(const Problem& problem, TermId id, const Vec& x, const TermState& state,
                            Vec* values) {
  const EnergyTerm& term = problem.term(id);
  const Index n = term.element_dofs().local_size();
  RowMatrix all(term.element_dofs().element_count(), n);
  if (values) values->resize(all.rows());
  visit_elements(term, ProblemParts::plan(problem, id), x, state, false,
                 [&](Index, Index e, const LocalSystem& local, int p) {
                   if (values) (*values)[e] = local.value[p];
                   for (Index k = 0; k < n; ++k)
                     all(e, k) = local.gradient[to_size(k) * LocalSystem::stride + to_size(p)];
                 });
  return all;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
