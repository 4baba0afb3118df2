// The parts of a problem that only evaluators and line searches use: the elimination behind x = Z y
// + c, the plan by which each term is evaluated and assembled, the partition (partition.h).
//
//   const Elimination& z = ProblemParts::elimination(problem);
//   const ColoredBatches& plan = ProblemParts::plan(problem, problem.terms().front());
#pragma once

#include "majorant/framework/assembly.h"
#include "majorant/framework/elimination.h"
#include "majorant/framework/internal/colored_batches.h"
#include "majorant/framework/problem.h"

namespace majorant {

struct ProblemParts {
  static const Elimination& elimination(const Problem& problem);
  static const ConstraintRows& rows(const Problem& problem);
  static const ColoredBatches& plan(const Problem& problem, TermId id);
  static const ScatterMap& slots(const Problem& problem, TermId id);
  static const Partition& partition(const Problem& problem);
  static ProblemBuilder builder(std::shared_ptr<const Partition> partition);
};

// Throws InvalidArgument, naming the term, unless the state fits it: finite weights that are not
// negative, lists empty or as long as there are elements, rules that exist.
void require_valid(const EnergyTerm& term, const TermState& state);

// Throws InvalidArgument, beginning with `who`, for a term that does not support the model.
void require_curvature(std::string_view who, const Problem& problem, Curvature curvature);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
