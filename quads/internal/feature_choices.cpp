#include "majorant/quads/internal/feature_choices.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "majorant/quads/features.h"

namespace majorant {
namespace {

// Lines of half an edge length are kept if that needs at most kMaxSharpFactor times the requested
// count, or at most kMaxSharpCount quads, which are placed quickly.
constexpr double kMaxSharpFactor = 2, kMaxSharpCount = 1000;

std::vector<QuadAttempt> joined(std::vector<QuadAttempt> first,
                                const std::vector<QuadAttempt>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

}  // namespace

bool has_any(const std::vector<char>& flags) {
  return std::count(flags.begin(), flags.end(), 0) < static_cast<std::ptrdiff_t>(flags.size());
}

std::vector<FeatureChoice> feature_choices(const SurfaceMesh& mesh,
                                           const std::vector<char>& features, FeatureSource source,
                                           double requested) {
  const std::vector<QuadAttempt> close = close_attempts(),
                                 any = joined(close, growing_attempts(requested));
  if (!has_any(features))
    return {{.features = {},
             .attempts = joined(any, doubling_attempts(requested, AttemptPurpose::Suggested))}};
  const double length = std::sqrt(mesh.area() / std::max(requested, 1.0));
  const bool is_given = source == FeatureSource::Given;
  std::vector<char> sharp = without_short_lines(mesh, features, length, ShortLines::SharpKept);
  std::vector<FeatureChoice> choices;
  const auto add = [&](std::vector<char> flags, double shortest, ChoiceAcceptance acceptance) {
    if (!choices.empty() && flags == choices.back().features) return;
    const bool is_last = !has_any(flags);
    choices.push_back({.features = std::move(flags),
                       .shortest = shortest,
                       .acceptance = is_last ? ChoiceAcceptance::Always : acceptance,
                       .attempts = is_last || is_given ? any : close});
  };
  add(sharp, length / 2, ChoiceAcceptance::WithinCount);
  choices.front().max_count = std::max(kMaxSharpFactor * requested, kMaxSharpCount);
  for (double shortest = length; has_any(choices.back().features); shortest *= 2)
    add(without_short_lines(mesh, features, shortest), shortest,
        is_given ? ChoiceAcceptance::Always : ChoiceAcceptance::WithinCount);
  std::vector<char> none = choices.back().features;
  if (has_any(sharp))
    choices.push_back({std::move(sharp), length, ChoiceAcceptance::Fallback, any});
  choices.push_back({std::move(none), length, ChoiceAcceptance::Fallback,
                     doubling_attempts(requested, AttemptPurpose::Last)});
  return choices;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
