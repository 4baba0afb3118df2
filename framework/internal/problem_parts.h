// What evaluators and line searches need of a problem and nobody else: the elimination behind
// x = Z y + c, and how each term is evaluated and assembled.
//
//   const Elimination& z = ProblemParts::elimination(problem);
//   const ChunkPlan& plan = ProblemParts::plan(problem, problem.terms().front());
#pragma once

#include "majorant/framework/internal/assembly.h"
#include "majorant/framework/internal/chunk_plan.h"
#include "majorant/framework/internal/elimination.h"
#include "majorant/framework/problem.h"

namespace majorant {

struct ProblemParts {
  static const Elimination& elimination(const Problem& problem);
  static const ChunkPlan& plan(const Problem& problem, TermId id);
  static const SlotTable& slots(const Problem& problem, TermId id);
};

}  // namespace majorant
