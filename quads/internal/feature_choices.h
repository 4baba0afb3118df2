// The sets of features for which quads are tried, in order: from all that edges of the requested
// length can follow, down to none.
//
//   const std::vector<char> features = sharp_edges(*mesh, kCornerTurn);
//   for (const FeatureChoice& choice :
//        feature_choices(*mesh, features, FeatureSource::Detected, 4000))
//     std::cout << choice.attempts.size() << " attempts\n";
#pragma once

#include <limits>
#include <vector>

#include "majorant/mesh/surface_mesh.h"
#include "majorant/quads/internal/quad_attempts.h"

namespace majorant {

// Given: the user's features. Detected: the sharp edges of the surface, which are relaxed if they
// need too many quads.
enum class FeatureSource { Given, Detected };

// When quads of a choice end the search. WithinCount: unless they are too many although the
// requested number was possible. Always: whenever they are valid. Fallback: whenever they are
// valid, but tried only if no earlier choice had valid quads.
enum class ChoiceAcceptance { WithinCount, Always, Fallback };

struct FeatureChoice {
  std::vector<char> features;  // 3 #F of the surface; empty: no features
  double shortest = 0;         // model units; shorter lines are relaxed
  ChoiceAcceptance acceptance = ChoiceAcceptance::Always;
  std::vector<QuadAttempt> attempts = {};
  // The limit of quads; quantizations with more are not placed.
  double max_count = std::numeric_limits<double>::infinity();
};

// Returns the choices. features: 3 #F of the mesh, or empty. With the edge length L of the
// requested count these are: sharp lines of at least L / 2; lines that edges of L, 2 L, 4 L, ...
// can follow (without_short_lines()); no lines. Fallbacks are for few quads that lie across teeth
// and are turned over: more quads that follow the teeth's sides, then ever more quads without
// features.
std::vector<FeatureChoice> feature_choices(const SurfaceMesh& mesh,
                                           const std::vector<char>& features, FeatureSource source,
                                           double requested);

// Returns whether any flag is set.
bool has_any(const std::vector<char>& flags);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
