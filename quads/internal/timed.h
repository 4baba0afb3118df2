// Measures the duration of a piece of work.
//
//   double seconds = 0;
//   const int sum = timed(seconds, [] { return 1 + 2; });
#pragma once

#include "majorant/framework/stopwatch.h"

namespace majorant {

// Returns work(), and adds its wall-clock time to `sum`.
template <class Work>
auto timed(double& sum, const Work& work) {
  const AddedSeconds time(sum);
  return work();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
