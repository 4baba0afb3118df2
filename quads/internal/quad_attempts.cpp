#include "majorant/quads/internal/quad_attempts.h"

#include <algorithm>

namespace majorant {
namespace {

// Factors of the requested count, and a count. Chosen, not tuned.
constexpr double kGrowth = 1.5, kMaxGrowth = 4, kMinGrownCount = 200;
constexpr double kDoubling = 2, kMaxDoubling = 64;
// The limit of doubled counts, up to which an attempt takes seconds.
constexpr double kMaxDoubledCount = 20'000;

double max_growth(double requested) {
  return std::max(kMaxGrowth, kMinGrownCount / std::max(requested, 1.0));
}

}  // namespace

std::vector<QuadAttempt> close_attempts() {
  using enum ArcLengths;
  return {{NonNegative, 1},    {NonNegative, 1.02}, {NonNegative, 0.98},
          {NonNegative, 1.04}, {Positive, 1},       {Positive, 1.03}};
}

std::vector<QuadAttempt> growing_attempts(double requested) {
  std::vector<QuadAttempt> attempts;
  for (double factor = kGrowth; factor <= max_growth(requested); factor *= kGrowth)
    attempts.push_back({ArcLengths::NonNegative, factor, AttemptPurpose::Growing});
  return attempts;
}

std::vector<QuadAttempt> doubling_attempts(double requested, AttemptPurpose purpose) {
  std::vector<QuadAttempt> attempts;
  const double most = max_growth(requested);
  for (double factor = kDoubling * most;
       factor <= kMaxDoubling * most && factor * requested <= kMaxDoubledCount; factor *= kDoubling)
    attempts.push_back({ArcLengths::NonNegative, factor, purpose});
  return attempts;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
