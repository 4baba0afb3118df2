// Charts whose surfaces are copies of each other: which of them may lie on one place of the layout.
//
//   const auto places = stack_places({mesh, mesh}, Stacking::Equal, {});
//   if (places[1]) map = map_on(map, map, *places[1]);
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "majorant/parametrization/atlas/unwrap.h"

namespace majorant {

// Of every surface the first one that it is a copy of, as it is or (Mirrored) as in a mirror; none
// where it is the first of its kind. Copies have the same triangles, with edges and, once moved
// onto each other, vertices in the same places but for a part of 1e-4 of the size. scale: of every
// surface, or empty; copies have equal ones.
std::vector<std::optional<StackPlace>> stack_places(
    const std::vector<std::shared_ptr<const SurfaceMesh>>& surfaces, Stacking stacking,
    const std::vector<double>& scale);

// The map of the same faces as `map` that lies on `under`, or mirrored at u = 0.
BezierMap map_on(const BezierMap& under, const BezierMap& map, const StackPlace& place);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
