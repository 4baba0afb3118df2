// Whether a map is injective as a whole, in reports: the proof from its boundary as JSON.
#pragma once

#include "majorant/parametrization/injectivity/global_injectivity.h"
#include "majorant/results/internal/report.h"

namespace majorant {

// Sets "globally_injective" (true, false, or null: not decided) and "boundary" ({"pairs_tested",
// "pairs_left", "subdivisions", "reason", "contacts"}, edges by vertices of the input). proof: of
// the boundary of `map` or of a map with the same faces.
void add_global_injectivity(Json& measures_section, const BezierMap& map,
                            const MapMeasures& measures, const GlobalInjectivity& proof);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
