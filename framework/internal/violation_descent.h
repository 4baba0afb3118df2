// Descends to a minimum of the violation of the equalities of a barrier method's run, to find a
// point that meets them or to learn that there is none nearby.
//
//     const LeastViolation least = descend_violation(run, ids, penalty, violation);
//     if (run.went_on() && least.violation > kNoViolation && least.is_minimum)
//       std::cout << "no point nearby meets the equalities";
#pragma once

#include <vector>

#include "majorant/framework/internal/barrier_run.h"

namespace majorant {

// A violation below this, relative to its scale, has the minimum 0.
inline constexpr double kNoViolation = 1e-6;

struct LeastViolation {
  double violation = 0;     // EqualityRows::violation() at the present point of the run
  bool is_minimum = false;  // the point is a minimum of the violation
};

// Descends with a small weight for the energy. run.went_on() then returns whether the run went on.
// At a minimum the gradient of the violation vanishes, except for forces of the barriers, whose
// cost must be a small part of the violation; and it is no saddle. ids: the equalities. penalty: of
// rows whose derivatives have the norm 1. violation: the result without any descent.
LeastViolation descend_violation(BarrierRun& run, const std::vector<TermId>& ids, double penalty,
                                 double violation);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
