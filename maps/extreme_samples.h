// The sample points of extremes in reports, legends and pages, which therefore agree.
#pragma once

#include <vector>

#include "majorant/framework/types.h"

namespace majorant {

// Extremes are sampled at the points (i,j,k)/8: 45 points a face. They are for reports only; proofs
// do not rely on them.
inline constexpr int kExtremeSamples = 8;

// Returns barycentric points of one face; one point suffices for affine maps.
inline std::vector<Barycentric> extreme_samples(int degree) {
  if (degree == 1) return {Barycentric::Constant(1.0 / 3)};
  std::vector<Barycentric> points;
  for (int i = 0; i <= kExtremeSamples; ++i)
    for (int j = 0; j <= kExtremeSamples - i; ++j)
      points.push_back(Barycentric(i, j, kExtremeSamples - i - j) / kExtremeSamples);
  return points;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
