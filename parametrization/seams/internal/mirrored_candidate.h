// A symmetric cut of a symmetric surface.
//
//   const CutRequest request{{}, std::vector<char>(mesh->vertex_count(), 0)};
//   const CutProblem problem(*mesh, request, 0.02);
//   AutomaticCut best = routed(problem, {0});
//   if (const std::optional<AutomaticCut> cut = mirrored_cut(problem, best)) best = *cut;
//
// The cheapest of four variants is taken: through either half of the surface, with its own ends or
// with those of both halves (mirrored_cuts.h), each shortened in pairs of ends.
#pragma once

#include <optional>

#include "majorant/parametrization/seams/internal/cut_problem.h"

namespace majorant {

// Returns the symmetric cut. best: a cut whose ends and cones the symmetric one passes. None if the
// surface has no mirror plane, is large or faceted, or has asymmetric costs of edges. Stopped.
std::optional<AutomaticCut> mirrored_cut(const CutProblem& problem, const AutomaticCut& best);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
