#include "majorant/pictures/internal/alignment.h"

#include "majorant/certify/moved_layout.h"
#include "majorant/io/claims.h"
#include "majorant/io/layout_scale.h"
#include "majorant/maps/smallest_rectangle.h"

namespace majorant {
namespace {

// Returns whether the layout was held in place, or this is unknown.
bool is_placed(const MapFile& map) {
  const Claims claims = readable_claims(map.claims);
  const bool is_claimed =
      claims.pins && claims.options && claims.options->handles && claims.seams && claims.boundary;
  return !is_claimed || held_by(claims) != Held::Nothing || *claims.seams ||
         claims.init == ClaimedStart::Planar || map.chart.size() > 0;
}

}  // namespace

Vector2 picture_direction(const MapFile& map, Alignment alignment) {
  if (alignment == Alignment::Never) return {1, 0};
  if (alignment == Alignment::Automatic && is_placed(map)) return {1, 0};
  return layout_direction(map.uv, map.cells);
}

MapFile turned(const MapFile& map, const Vector2& direction) {
  MapFile result = map;
  if (direction != Vector2(1, 0)) result.uv = LayoutMotion{direction}(map.uv);
  return result;
}

Vector2 turned(const Vector2& uv, const Vector2& direction) {
  if (direction == Vector2(1, 0)) return uv;
  const Points2 moved = LayoutMotion{direction}(Points2(uv.transpose()));
  return Vector2(moved.row(0));
}

bool is_for_unit_square(const MapFile& map) {
  return readable_claims(map.claims).normalized || has_assumed_scale(map);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
