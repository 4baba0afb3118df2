// The last step of a run: its map is measured and proven, and what fails its proof becomes a failed
// result.
//
//     result.map = start.in_model_units(map);
//     prove_result(result, options, sharing, record);
#pragma once

#include "majorant/parametrization/solve/run_sharing.h"

namespace majorant {

// Measures result.map and sets the status by its proofs: of local injectivity, and of no overlaps
// under MapInjectivity::Global. Under Triangles::Flipped it then improves the triangles of a proven
// map and measures the improved one. A result that failed in the solver but is proven counts as
// stalled.
void prove_result(ParametrizationResult& result, const ParametrizationOptions& options,
                  const RunSharing& sharing, RunRecord& record);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
