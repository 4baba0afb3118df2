// Newton's method with CHOLMOD for compare(), for programs that link majorant::cholmod.
//
//   const Comparison all = compare(problem, y0, comparison_methods(cholmod_methods()));
//
// Other solvers are given to newton_method() (methods.h) in the same way. Not for a single solve:
// make_cholmod_solver() (cholmod_solver.h).
#pragma once

#include <vector>

#include "majorant/framework/cholmod_solver.h"
#include "majorant/framework/comparison/methods.h"

namespace majorant {

inline std::vector<ComparisonMethod> cholmod_methods(NewtonOptions base = {}) {
  base.linear_solver = [] { return make_cholmod_solver(); };
  return {newton_method("newton-cholmod", "newton with CHOLMOD", std::move(base))};
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
