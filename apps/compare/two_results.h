// `majorant compare A.vtu B.vtu -o AB.html -o AB.svg`: shows two results of one surface side by
// side.
#pragma once

#include "apps/compare/compare_request.h"

namespace majorant::app {

// Throws Error(Usage) before any work; returns the exit code.
int compare_results(const CompareRequest& request);

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
