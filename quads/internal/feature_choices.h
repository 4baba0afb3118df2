// The sets of features that quads are made with, from all that edges of the requested length can
// follow to none, as a list in the order in which they are tried.
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

// Whether features were given, or are the sharp edges of the surface. Detected features are relaxed
// where they need too many quads.
enum class FeatureSource { Given, Detected };

// When the quads of a choice end the search. WithinCount: unless as many as requested were too few.
// Always; Fallback: always, but it is tried only if no choice before has made quads.
enum class ChoiceAcceptance { WithinCount, Always, Fallback };

struct FeatureChoice {
  std::vector<char> features;  // 3 #F of the surface, or empty: none
  double shortest = 0;         // model units: shorter lines were relaxed
  ChoiceAcceptance acceptance = ChoiceAcceptance::Always;
  std::vector<QuadAttempt> attempts = {};
  // Quantizations with more quads are not placed.
  double max_count = std::numeric_limits<double>::infinity();
};

// features: 3 #F of the mesh, or empty. With L the edge length of the requested count: sharp lines
// down to L / 2, then lines that edges of L, 2 L, 4 L, ... can follow (without_short_lines()), then
// none. Fallbacks, for few quads that lie across teeth and are turned over: more quads that follow
// the teeth's sides, then ever more quads without features.
std::vector<FeatureChoice> feature_choices(const SurfaceMesh& mesh,
                                           const std::vector<char>& features, FeatureSource source,
                                           double requested);

// Returns whether any flag is set.
bool has_any(const std::vector<char>& flags);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
