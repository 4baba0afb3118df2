// Energies that overflow at the start (exponentials of a Tutte map) begin where the symmetric
// Dirichlet energy, finite on every injective map, has led at degree 1.
//
//     if (!std::isfinite(energy)) map = enter_domain(setup, domain, map, record, counts);
#pragma once

#include <vector>

#include "majorant/framework/run_record.h"
#include "majorant/parametrization/drive/internal/degree_solver.h"

namespace majorant {

// setup: of the energy asked for; map: of degree 1, normalised. proven: DegreeSolver::proven() is
// added to it. A stop ends it with the best map so far.
BezierMap enter_domain(const DegreeSolver::Setup& setup, MapDomain& domain, const BezierMap& map,
                       RunRecord& record, std::vector<long>& proven);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
