// Placements of charts in a square, and the search for the smallest square, for any packer.
//
//   const auto job = packing_job({map}, {AllowedRotations::Any}, 0.01);
//   const auto strip = [&](double width) { return skyline_strip(job, width); };
//   const auto best = smallest_square(job, strip, {.guess = 2, .factor = 1.1, .tries = 4});
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "majorant/parametrization/packing/internal/packing_job.h"

namespace majorant {

// The placement of a chart: rotated by `quarters` * 90 degrees about its corner, counterclockwise,
// then moved such that the lower left corner of its box is `low`.
struct Pose {
  int quarters = 0;
  Vector2 low = Vector2::Zero();
  int tile = 0;
};

// Returns p, a point of a chart of that size, after its quarter turns.
inline Vector2 quarter_turned(const Vector2& p, int quarters, const Vector2& size) {
  switch (quarters & 3) {
    case 0:
      return p;
    case 1:
      return {size.y() - p.y(), p.x()};
    case 2:
      return {size.x() - p.x(), size.y() - p.y()};
    default:
      return {p.y(), size.x() - p.x()};
  }
}

inline Vector2 size_after(const ChartOutline& chart, int quarters) {
  return quarters & 1 ? Vector2(chart.size.y(), chart.size.x()) : chart.size;
}

// Charts between x = 0 and `width` and above y = 0, at least gap * width apart; `height` is the top
// of the highest. With several tiles there is a strip in each, `height` is that of the highest, and
// all but the last are no higher than wide.
struct Strip {
  std::vector<Pose> poses;
  double height = 0;
};
using StripPacker = std::function<std::optional<Strip>(double width)>;  // none: too narrow

struct Placements {
  std::vector<Pose> poses;
  double side = 0;  // of the square; the charts are gap * side apart
};

// Grows or shrinks the square from `guess` by `factor` until one size works and another does not,
// then bisects `tries` times. Packers are not monotonous, so the result is a small square, not
// always the smallest. None: no square is large enough, because the gaps grow with it.
struct SquareSearch {
  double guess;
  double factor;
  int tries;
  double most = std::numeric_limits<double>::infinity();  // larger squares are of no use
};
std::optional<Placements> smallest_square(const PackingJob& job, const StripPacker& strip,
                                          const SquareSearch& search);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
