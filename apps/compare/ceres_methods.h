// Solvers of Ceres among the methods of `majorant compare`: none in a build without it.
#pragma once

#include <vector>

#include "apps/compare/methods.h"

namespace majorant::app {

std::vector<Method> ceres_methods();

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
