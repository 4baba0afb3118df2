// Memory of direct solvers that follow each other: as long as a block lasts, what one of them
// leaves is there for the next one.
//
//   const KeptFactorMemory kept;   // until the end of this block, on this thread
//   const Vec values = Vec::Ones(problem.pattern().nonzeros());
//   for (int k = 0; k < 2; ++k) {
//     const auto solver = make_direct_solver();   // the second one in the memory of the first
//     solver->analyze(problem.pattern());
//     solver->factorize(values, 2.0 * problem.size());
//   }
//
// Touching fresh memory costs about as much as the factorization of a mesh's matrix in it. What is
// kept is never more than the largest of what came back, and is gone with the block. Numbers do not
// depend on it.
//
// Not for blocks that go on for long after their last factorization.
#pragma once

#include <memory>

#include "majorant/framework/internal/multifrontal.h"

namespace majorant {

class KeptFactorMemory {
 public:
  // Within another one on the same thread it does nothing.
  KeptFactorMemory();
  ~KeptFactorMemory();  // on the same thread
  KeptFactorMemory(const KeptFactorMemory&) = delete;
  KeptFactorMemory& operator=(const KeptFactorMemory&) = delete;

  // For solvers: what is kept on this thread, which is not kept any more; nothing without a block.
  static FactorMemory take();
  // What a solver leaves: kept where it is larger than what is, and freed without a block.
  static void give(FactorMemory memory);

 private:
  FactorMemory memory_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
