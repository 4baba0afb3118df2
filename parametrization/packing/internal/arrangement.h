// Where parcels are put in a square, whoever finds it; and how the smallest square is looked for.
//
//   const auto strip = [&](double width) { return skyline_strip(job, width); };
//   const std::optional<Arrangement> best = smallest_square(job, strip, 24);
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/parametrization/packing/internal/parcel.h"

namespace majorant {

// Turned by `quarters` * 90 degrees about its corner, counterclockwise, then moved such that its
// box is at `low`.
struct Spot {
  int quarters = 0;
  Vector2 low = Vector2::Zero();
};

// p, in a parcel of that size, after its quarter turns.
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

inline Vector2 size_after(const Parcel& parcel, int quarters) {
  return quarters & 1 ? Vector2(parcel.size.y(), parcel.size.x()) : parcel.size;
}

// What every packer is given.
struct PackingJob {
  std::vector<Parcel> parcels;
  // Of those that stay where they are: relative to the corner of the square; else none.
  std::vector<std::optional<Vector2>> fixed;
  double gap = 0;  // of any two, as a part of the square's side
  StopCheck stop;
};

// All parcels between x = 0 and `width` and above y = 0, `height` being the top of the highest, at
// least gap * width apart.
struct Strip {
  std::vector<Spot> spots;
  double height = 0;
};
using StripPacker = std::function<std::optional<Strip>(double width)>;  // none: too narrow

struct Arrangement {
  std::vector<Spot> spots;
  double side = 0;  // of the square; the parcels are gap * side apart
};

// Bisects over the side, `tries` times, after at most some dozen to find one that is large enough;
// packers are not monotonous, so it is a small square, not the smallest. None: no square is large
// enough, because the gaps grow with it.
std::optional<Arrangement> smallest_square(const PackingJob& job, const StripPacker& strip,
                                           int tries);

}  // namespace majorant
