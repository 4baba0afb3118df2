// The automatic cut of one connected surface: the shortest seam whose piece stays below a limit of
// the estimated stretch. The rule is that of docs/atlas.md, "Where to cut".
//
//   const CutRequest request{{}, std::vector<char>(mesh->vertex_count(), 0)};
//   const AutomaticCut cut = automatic_cut(*mesh, request, 1.015);
//
// A new reason to cut is a function that proposes a cut, and its row in the list of candidate
// makers (automatic_cut.cpp).
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
  double excess;  // its cost beyond the most that its kind may cost beside the best cut
};

struct CandidateMaker {
  // Proposes a cut in the place of the best one, or none. progress: for the share of its work.
  std::optional<CutCandidate> (*make)(const CutProblem&, const AutomaticCut& best,
                                      const StopCheck& progress);
  // Calls it again while its candidates are taken, CutProblem::rounds() times at most, or once.
  bool is_repeated = false;
  // Leaves out large surfaces, those with one round.
  bool is_for_small_surfaces = false;
  // The share of the whole search on a large surface, which its first call takes.
  double share = 0;
};

// The best cut after each maker, in turn, has proposed what may replace it: candidates without
// excess are taken. Returns the best cut so far once request.enough ends the search. Stopped.
AutomaticCut cheapest(const CutProblem& problem, std::span<const CandidateMaker> makers,
                      AutomaticCut best, const StopCheck& progress = {});

// max_stretch: above 1. Stopped.
AutomaticCut automatic_cut(const SurfaceMesh& mesh, const CutRequest& request, double max_stretch,
                           const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
