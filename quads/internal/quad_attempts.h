// The quantizations that are tried for a requested number of quads, in order.
//
//   std::vector<QuadAttempt> attempts = close_attempts();
//   for (const QuadAttempt& attempt : growing_attempts(4000)) attempts.push_back(attempt);
//   for (const QuadAttempt& attempt : attempts) std::cout << attempt.factor * 4000 << " quads\n";
//
// Zero-length arcs give the best angles. Other numbers of quads give other meshes, which may be
// valid, or close to the requested count, where the first is not.
#pragma once

#include <vector>

#include "majorant/quads/internal/quantization_search.h"

namespace majorant {

// Close: tried until a valid mesh is within kCountClose of the requested count, or has the fewest
// possible quads. Growing: tried while there is no valid mesh, or only one with more quads than the
// attempt. Suggested, Last: tried while there is no valid mesh; Suggested quads are not returned,
// but the error message names their number.
enum class AttemptPurpose { Close, Growing, Suggested, Last };

struct QuadAttempt {
  ArcLengths lengths = ArcLengths::NonNegative;
  double factor = 1;  // multiple of the requested number of quads
  AttemptPurpose purpose = AttemptPurpose::Close;
};

// Returns attempts from 2 % fewer to 4 % more quads than requested.
std::vector<QuadAttempt> close_attempts();

// Returns attempts with 1.5, 1.5^2, ... times as many quads, up to kMaxGrowth times the request or
// kMinGrownCount. With few quads, thin limbs as wide as a quad are turned over.
std::vector<QuadAttempt> growing_attempts(double requested);

// Returns attempts with twice the largest number of growing_attempts(), doubled each time, up to
// kMaxDoubledCount quads.
std::vector<QuadAttempt> doubling_attempts(double requested, AttemptPurpose purpose);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
