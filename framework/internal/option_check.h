// Checks of minimizers' options. Each throws InvalidArgument with the name of the option.
#pragma once

#include <functional>
#include <memory>
#include <string_view>

#include "majorant/framework/argument_check.h"
#include "majorant/framework/linear_solver.h"
#include "majorant/framework/minimizer.h"
#include "majorant/framework/stepper.h"

namespace majorant {

// Requires least <= value < limit.
void require_in(std::string_view what, double value, double least, double limit);
void require_valid(const LineSearchOptions& options);
void require_valid(const StoppingRules& rules);

// Makes the solver of the options of `who`. Throws if the function is empty or returns null.
std::shared_ptr<LinearSolver> make_solver(std::string_view who, const SolverFactory& linear_solver);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
