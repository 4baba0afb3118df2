// Names of the curvature models, as the command line has them.
#pragma once

#include <string_view>

#include "majorant/framework/curvature.h"

namespace majorant {

std::string_view curvature_name(Curvature curvature);  // "projected", "paper-majorizer", ...

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
