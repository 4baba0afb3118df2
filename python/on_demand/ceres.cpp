// CeresMinimizer and the CHOLMOD solver of the Python module, loaded from _ceres.so.
#include <utility>

#include "ceres_part.h"
#include "loaded_symbol.h"

namespace majorant {
namespace {

const python::CeresPart& ceres_part() {
  static const auto part = python::loaded_symbol<const python::CeresPart*>(
      {"_ceres.so", "Ceres", true}, "majorant_part");
  return *part;
}

}  // namespace

SolveResult CeresMinimizer::minimize(const Problem& problem, Vec y0, RunObserver* observer) const {
  return ceres_part().minimize(options_, problem, std::move(y0), observer);
}

#if MAJORANT_HAS_CHOLMOD
std::unique_ptr<LinearSolver> make_cholmod_solver(CholmodOptions options) {
  return ceres_part().make_cholmod_solver(options);
}
#endif

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
