// The quantizations that are tried for a requested number of quads, as a list in order.
//
//   std::vector<QuadAttempt> attempts = close_attempts();
//   for (const QuadAttempt& attempt : growing_attempts(4000)) attempts.push_back(attempt);
//   for (const QuadAttempt& attempt : attempts) std::cout << attempt.factor * 4000 << " quads\n";
//
// Zero-length arcs leave the best angles. Other numbers of quads are other meshes, of which one may
// be valid, or be close to the requested count, where the first is not.
#pragma once

#include <vector>

#include "majorant/quads/internal/quantization_search.h"

namespace majorant {

// Close: tried until a valid mesh is within kCountClose of the requested count, or has as few quads
// as there can be. Growing: tried while there is no valid mesh, or one with more quads than this.
// Suggested, Last: tried while there is no valid mesh; Suggested quads are not returned, but their
// number is named in the error message.
enum class AttemptPurpose { Close, Growing, Suggested, Last };

struct QuadAttempt {
  ArcLengths lengths = ArcLengths::NonNegative;
  double factor = 1;  // times the requested number of quads
  AttemptPurpose purpose = AttemptPurpose::Close;
};

// Returns attempts from 2 % fewer to 4 % more quads than requested.
std::vector<QuadAttempt> close_attempts();

// Returns attempts with 1.5, 1.5^2, ... times as many quads, up to kMaxGrowth times or
// kMinGrownCount: few quads turn thin limbs over that are as wide as they are.
std::vector<QuadAttempt> growing_attempts(double requested);

// Returns attempts with twice as many quads as the most of growing_attempts() and on, doubled each
// time, of at most kMaxDoubledCount quads.
std::vector<QuadAttempt> doubling_attempts(double requested, AttemptPurpose purpose);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
