// The library _ceres.so.
#include "ceres_part.h"

#include <utility>

extern "C" __attribute__((visibility("default"))) const majorant::python::CeresPart majorant_part {
  [](const majorant::CeresOptions& options, const majorant::Problem& problem, majorant::Vec y0,
     majorant::RunObserver* observer) {
    return majorant::CeresMinimizer(options).minimize(problem, std::move(y0), observer);
  },
#if MAJORANT_HAS_CHOLMOD
      &majorant::make_cholmod_solver
#else
      nullptr
#endif
};

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
