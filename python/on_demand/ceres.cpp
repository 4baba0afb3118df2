// CeresMinimizer in the Python module: the one of _ceres.so.
#include <utility>

#include "ceres_part.h"
#include "loaded_symbol.h"

namespace majorant {

SolveResult CeresMinimizer::minimize(const Problem& problem, Vec y0, RunObserver* observer) const {
  static const auto part = python::loaded_symbol<const python::CeresPart*>(
      {"_ceres.so", "Ceres", true}, "majorant_part");
  return part->minimize(options_, problem, std::move(y0), observer);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
