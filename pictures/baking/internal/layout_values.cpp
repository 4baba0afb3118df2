#include "majorant/pictures/baking/internal/layout_values.h"

#include <algorithm>

#include "majorant/pictures/baking/internal/texel_coverage.h"

namespace majorant {
namespace {

// Returns barycentric coordinates of any point of the plane; not finite if the triangle has no
// area.
Barycentric coordinates(const std::array<Vector2, 3>& corner, const Vector2& p) {
  const double doubled = cross(corner[1] - corner[0], corner[2] - corner[0]);
  const double first = cross(corner[1] - p, corner[2] - p) / doubled;
  const double second = cross(corner[2] - p, corner[0] - p) / doubled;
  return {first, second, 1 - first - second};
}

}  // namespace

std::optional<SurfacePlace> LayoutValues::place_at(const Vector2& uv,
                                                   const LayoutPiece* continued) const {
  if (continued == nullptr) {
    const std::vector<Preimage> found = layout_.preimages(uv);
    return found.empty() ? std::nullopt : std::optional(shown(found));
  }
  const Barycentric xi = coordinates(continued->uv, uv);
  if (!xi.allFinite()) return std::nullopt;
  return continuation_.at(pieces_.place(*continued, xi));
}

bool LayoutValues::value_at(const SurfacePlace& place, std::vector<float>& value,
                            ValueScratch& scratch) const {
  const std::optional<CarrierPlace> carrier = place_of_(place, scratch.likely);
  if (!carrier) return false;
  scratch.likely = carrier->face;
  scratch.is_opposed = scratch.is_opposed || carrier->is_opposed;
  values_.at(*carrier, value.data());
  return true;
}

bool LayoutValues::find_value(const TexelGrid& grid, int x, int y, int samples,
                              const SurfacePlace& place, const LayoutPiece* continued,
                              ValueScratch& scratch) const {
  const int n = samples;
  std::vector<float>& sum = scratch.sum;
  std::fill(sum.begin(), sum.end(), 0.0F);
  int known = 0;
  for (int i = 0; (n > 1 || continued != nullptr) && i < n * n; ++i) {
    const double across = (i % n + 0.5) / n, down = (i / n + 0.5) / n;
    const auto sampled = place_at(grid.point(x + across, y + down), continued);
    if (!sampled || !value_at(*sampled, scratch.one, scratch)) continue;
    ++known;
    for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += scratch.one[c];
  }
  if (known == 0) return value_at(place, scratch.value, scratch);
  for (std::size_t c = 0; c < sum.size(); ++c)
    scratch.value[c] = sum[c] / static_cast<float>(known);
  return true;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
