// A term that computes many elements in one call: of an interpreted language, say, where a call
// costs more than an element. The evaluator then asks for the elements of some thousand batches at
// once, instead of a batch at a time.
//
//   const TermId id = problem.terms().front();
//   if (const auto* joint = dynamic_cast<const JointTerm*>(&problem.term(id)))
//     const auto at_x = joint->computed(x, {}, problem.state(id), {});   // values, of no batch
//
// Not for terms in C++, whose batches run side by side on all threads.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "majorant/framework/energy_term.h"

namespace majorant {

class JointTerm {
 public:
  virtual ~JointTerm() = default;
  // Computes these batches at x, and returns a term that answers values() for each of them and, of
  // a curvature, local(), by what was computed: whatever x and state it is called with. Batches are
  // known by their spans of elements, which outlive the result.
  virtual std::unique_ptr<const EnergyTerm> computed(
      VecIn x, std::span<const ElementBatch> batches, const TermState& state,
      std::optional<BlendedCurvature> curvature) const = 0;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
