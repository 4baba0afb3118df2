// The content of _ceres.so, which the module loads on demand. It exports one symbol,
// `majorant_part`.
#pragma once

#include <memory>

#include "majorant/framework/ceres_minimizer.h"
#include "majorant/framework/cholmod_solver.h"

namespace majorant::python {

struct CeresPart {
  SolveResult (*minimize)(const CeresOptions& options, const Problem& problem, Vec y0,
                          RunObserver* observer);
  std::unique_ptr<LinearSolver> (*make_cholmod_solver)(CholmodOptions options);  // null: not built
};

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
