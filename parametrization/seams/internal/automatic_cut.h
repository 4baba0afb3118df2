// The automatic cut of one connected surface: the shortest seam whose piece stays below a limit of
// the estimated stretch (docs/atlas.md, "Where to cut").
//
//   const CutRequest request{{}, std::vector<char>(mesh->vertex_count(), 0)};
//   const AutomaticCut cut = automatic_cut(*mesh, request, 1.015);
//
// A new reason to cut is a function that proposes a cut, with a row in the list of candidate makers
// (automatic_cut.cpp).
#pragma once

#include <optional>
#include <span>

#include "majorant/framework/stop_check.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/parametrization/seams/internal/cut_problem.h"

namespace majorant {

// A cut that may replace the best one.
struct CutCandidate {
  AutomaticCut cut;
  double excess;  // its cost beyond the bound of its kind relative to the best cut
};

struct CandidateMaker {
  // Proposes a cut in place of the best one, or none. progress: reports the fraction of its work.
  std::optional<CutCandidate> (*make)(const CutProblem&, const AutomaticCut& best,
                                      const StopCheck& progress);
  // True: it is called again while its candidates are accepted, at most CutProblem::rounds() times.
  // False: once.
  bool is_repeated = false;
  // True: skipped on large surfaces, which have one round.
  bool is_for_small_surfaces = false;
  // The fraction of the whole search on a large surface that its first call takes.
  double share = 0;
};

// Returns the best cut after each maker in turn has proposed replacements: candidates without
// excess are accepted. Once request.enough ends the search, returns the best cut so far. Stopped.
AutomaticCut cheapest(const CutProblem& problem, std::span<const CandidateMaker> makers,
                      AutomaticCut best, const StopCheck& progress = {});

// Returns the automatic cut. max_stretch: above 1. Stopped.
AutomaticCut automatic_cut(const SurfaceMesh& mesh, const CutRequest& request, double max_stretch,
                           const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
