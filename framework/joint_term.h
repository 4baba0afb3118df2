// A term that computes many elements in one call, such as a term in an interpreted language, where
// a call costs more than an element. The evaluator passes it many batches at once instead of one.
//
//   const TermId id = problem.terms().front();
//   if (const auto* joint = dynamic_cast<const JointTerm*>(&problem.term(id)))
//     const auto at_x = joint->computed(x, {}, problem.state(id), {});   // values, of no batch
//
// Not for terms in C++, whose batches are computed in parallel on all threads.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "majorant/framework/energy_term.h"

namespace majorant {

class JointTerm {
 public:
  virtual ~JointTerm() = default;
  // Computes these batches at x. Returns a term whose values() and, if a curvature is given,
  // local() return the computed results for each batch, whatever x and state they are called with.
  // A batch is identified by its span of elements, which must outlive the result.
  virtual std::unique_ptr<const EnergyTerm> computed(
      VecIn x, std::span<const ElementBatch> batches, const TermState& state,
      std::optional<BlendedCurvature> curvature) const = 0;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
