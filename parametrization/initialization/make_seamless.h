// From a plain mesh to a seamless, locally injective map of degree 1: the start of
// `majorant seamless`.
//
//   RunRecord record;
//   const Start start = make_seamless(*mesh, {}, record);
//   ParametrizationResult result = parametrize(start.map, options, record);
//
// Cones, those of a cross field unless they are given -> cut graph through them -> a map with these
// seams: the field integrated, or a conformal metric laid out -> untangling, until every triangle
// is positively oriented and no vertex is covered twice. The map is valid, not good: optimize it.
#pragma once

#include <optional>
#include <vector>

#include "majorant/framework/run_record.h"
#include "majorant/parametrization/fields/cross_field.h"
#include "majorant/parametrization/initialization/start.h"

namespace majorant {

struct SeamlessOptions {
  SeamlessMethod method = SeamlessMethod::Automatic;
  CrossFieldOptions field = {};
  // Vertices of the mesh; all others are regular, an empty list has no cones. Nothing: the field's.
  std::optional<std::vector<Cone>> cones = {};
  int threads = 0;  // as SolveOptions has it
};

// mesh: connected, closed or bounded, any genus. Throws Error(Invalid) naming the cones around
// which triangles could not be untangled, Error(Usage) for Conformal on surfaces of other kinds,
// and as cross_field.h has it for cones that cannot be; Stopped when the record's start_stop() says
// so first.
Start make_seamless(const SurfaceMesh& mesh, const SeamlessOptions& options,
                    const RunRecord& record);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
