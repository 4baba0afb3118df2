// Vertices through which an automatic cut may run, each kind for a reason of its own.
//
//   const CutRequest request{{}, std::vector<char>(mesh->vertex_count(), 0)};
//   const CutProblem problem(*mesh, request, 0.02);
//   const std::vector<Index> cones = field_cones(problem);
//   const AutomaticCut full = routed(problem, cones);
#pragma once

#include <cstddef>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/parametrization/seams/internal/cut_problem.h"

namespace majorant {

// Upper bound on vertices of one kind, except cones of a field: as many as fields have cones.
inline constexpr std::size_t kMaxTerminals = 40;

// Returns the cones of the smoothest cross field, or the vertices of the largest angle defects if
// the surface is too coarse for one. progress: of the field. Stopped.
std::vector<Index> field_cones(const CutProblem& problem, const StopCheck& progress = {});

// Returns the vertices where the weights of edges have a local minimum well below the mean of the
// surface, the smallest first. None without weights.
std::vector<Index> least_weighted_vertices(const CutProblem& problem);

// Returns the vertices of the cut surface where the stress function (flattening_strain.h) has a
// local maximum: a cut that ends there saves most strain. Stopped.
std::vector<Index> compressed_vertices(const CutProblem& problem, const AutomaticCut& cut);

// Returns the ends of a cut and the cones of the problem that it passes, with repetitions.
std::vector<Index> terminals_on(const CutProblem& problem, const AutomaticCut& cut);

// Returns a lower bound on the plain cost of a cut through all of these vertices, in model units.
// Disjoint balls around them reach half as far as the nearest other vertex or the boundary, and a
// cut leads from the centre of each to its border.
double least_cost_through(const CutProblem& problem, const std::vector<Index>& vertices);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
