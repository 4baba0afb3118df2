// Checks of options that hold whatever the surface: the same for one process and for several.
#pragma once

#include "majorant/parametrization/maps/map_options.h"
#include "majorant/parametrization/solve/solve_options.h"

namespace majorant {

// Throws InvalidArgument for options out of range, and for those that exclude each other. extended:
// whether a caller adds to the map (MapExtender).
void require_valid(const MapOptions& asked, const SolveOptions& how, bool extended);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
