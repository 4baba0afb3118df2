#include "majorant/volumes/internal/mesh_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "majorant/framework/error.h"

namespace majorant {

std::string shortest(double x) { return fmt::format("{}", x); }

bool MeshSource::is_moved(const Points3& points, Index point, int axis) const {
  return std::bit_cast<std::uint64_t>(points(point, axis)) !=
         std::bit_cast<std::uint64_t>(original_(point, axis));
}

std::string PlacedCoordinates::coded(double x) const {
  if (coding_ == Coding::Words) return shortest(x);
  std::string bytes(sizeof(x), '\0');
  std::memcpy(bytes.data(), &x, sizeof(x));
  if (coding_ == Coding::SwappedDoubles) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

std::string PlacedCoordinates::with_points(const Points3& points) const {
  struct Change {
    Place place;
    double value;
  };
  std::vector<Change> changes;
  for (Index p = 0; p < points.rows(); ++p)
    for (int axis = 0; axis < 3; ++axis) {
      if (!is_moved(points, p, axis)) continue;
      const Place& place = places_[to_size(3 * p + axis)];
      if (place.size == 0)
        throw Error(ErrorKind::Unsupported,
                    fmt::format("{}: point {} has no coordinate {} there", file_, p + 1, axis + 1));
      changes.push_back({place, points(p, axis)});
    }
  std::sort(changes.begin(), changes.end(),
            [](const Change& a, const Change& b) { return a.place.begin < b.place.begin; });
  std::string out;
  out.reserve(content_.size() + 8 * changes.size());
  std::size_t at = 0;
  for (const auto& [place, value] : changes) {
    out.append(content_, at, place.begin - at);
    out += coded(value);
    at = place.begin + place.size;
  }
  out.append(content_, at);
  return out;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
