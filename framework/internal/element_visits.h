// Elements of a term one by one, with their derivatives.
//
//   const TermId id = problem.terms().front();
//   const RowMatrix gradients = element_gradients(problem, id, x, problem.state(id));
#pragma once

#include <cstddef>
#include <vector>

#include "majorant/framework/energy_term.h"
#include "majorant/framework/parallel.h"
#include "majorant/framework/problem.h"

namespace majorant {

// Calls visit(c, e, local, p) for the elements of batches c, on all threads; the element is at
// position p of `local`. visit may write only to memory of the element or the batch.
template <class Plan, class Visit>
void visit_elements(const EnergyTerm& term, const Plan& plan, const Vec& x, const TermState& state,
                    bool with_hessian, const Visit& visit) {
  const auto n = to_size(term.element_dofs().local_size());
  constexpr std::size_t stride = LocalSystem::stride;
  const std::size_t packed = with_hessian ? n * (n + 1) / 2 : 0;
  const int threads = ThreadCount::current();
  std::vector<Workspace> kernels(to_size(threads)), memories(to_size(threads));
  const auto run = [&](Index c, int thread) {
    const ElementBatch batch = plan.batch(c);
    LocalSystem local;
    local.value = memories[to_size(thread)].reserve((1 + n + packed) * stride);
    local.gradient = local.value + stride;
    if (with_hessian) local.hessian = local.gradient + n * stride;
    term.local(x, batch, Curvature::Exact, state, kernels[to_size(thread)], local);
    for (std::size_t p = 0; p < batch.elements.size(); ++p)
      visit(c, batch.elements[p], local, static_cast<int>(p));
  };
  parallel_tasks(plan.batch_count(), run, threads);
}

// Returns the full unknown of local unknown k of element e.
inline Index unknown_of(const ElementDofs& dofs, Index e, Index k) {
  return dofs.block * dofs.nodes(e, k / dofs.block) + k % dofs.block;
}

inline double weight_of(const TermState& state, Index element) {
  return state.element_weight.size() ? state.weight * state.element_weight[element] : state.weight;
}

// Returns the gradients of all elements of a term at x (full unknowns), #E by local_size(), without
// weights, and writes their values to `values` unless it is null.
RowMatrix element_gradients(const Problem& problem, TermId id, const Vec& x, const TermState& state,
                            Vec* values = nullptr);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
