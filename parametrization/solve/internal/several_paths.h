// Effort::High: several paths to a minimum of the energy, of which the lowest end counts.
//
//   const auto solve = [&](const ParametrizationOptions& of_path, RunRecord& part) {
//     return parametrize(mesh, of_path, part);
//   };
//   ParametrizationResult result = parametrize_on_paths({solve}, options, record);
#pragma once

#include <functional>
#include <vector>

#include "majorant/parametrization/solve/parametrize.h"

namespace majorant {

// Solves from one start, within the limits of the record.
using SolveFromStart =
    std::function<ParametrizationResult(const ParametrizationOptions&, RunRecord&)>;

// Energies of maps have many local minima, some 1e-4 to 1e-3 apart, and the path decides in which
// one a run ends. At degree 1 each start is led to the minimum directly, and by way of the minima
// of other energies. The solve continues from the lowest end at the requested degree; the trace and
// the iterations are those of this last part. Limits apply to each part; a stop ends the search
// with the lowest end so far. solves: one for each start; options.solve.effort is Normal in the
// options that they get. Throws the errors of the first solve.
ParametrizationResult parametrize_on_paths(const std::vector<SolveFromStart>& solves,
                                           const ParametrizationOptions& options,
                                           RunRecord& record);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
