// Bounds of the minimum of det J on an element, with a proof of its sign.
//
//   const DeterminantRange range{ProofStatus::Proven, 0.5, 0.6, 1.1, 1.2, {}};
//   range.low;   // det J >= 0.5 everywhere
#pragma once

#include <array>

#include "majorant/elements/element_space.h"

namespace majorant {

struct DeterminantRange {
  // The proof that det J > 0 on all of the cell. Proven: there is a proof. Violated: det J <= 0 at
  // some point. Undecided: the minimum is 0, or nearly, at a point that bisection does not reach,
  // or coordinates are not finite.
  ProofStatus positive = ProofStatus::Undecided;
  double low = 0, high = 0;             // low <= min det J <= high
  double largest_low = 0, largest = 0;  // largest_low <= max det J <= largest
  std::array<double, 6> at{};           // homogeneous coordinates of a point where det J is `high`
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
