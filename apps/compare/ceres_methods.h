// Solvers of Ceres among the methods of `majorant compare`, from a library that is loaded when one
// of them is to run: none in a build without GPL parts.
#pragma once

#include <vector>

#include "apps/compare/methods.h"

namespace majorant::app {

std::vector<Method> ceres_methods();

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
