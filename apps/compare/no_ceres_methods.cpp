// What there is of ceres_methods.h and ceres_log.h without Ceres.
#include "apps/compare/ceres_log.h"
#include "apps/compare/ceres_methods.h"

namespace majorant {

void silence_ceres() {}

std::vector<app::Method> app::ceres_methods() { return {}; }

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
