#include "majorant/pictures/internal/alignment.h"

#include "majorant/parametrization/maps/internal/principal_axes.h"
#include "majorant/pictures/internal/claims_json.h"

namespace majorant {
namespace {

using nlohmann::json;

// Whether something held the layout where it is, or nothing says that nothing did.
bool is_placed(const MapFile& map) {
  const json claims = claims_of(map);
  const json options = claims.value("options", json::object());
  const bool no_pins = claims.value("pins", json()) == json::array();
  const bool no_handles = options.is_object() && options.value("handles", json()) == "";
  const bool no_seams = claims.value("seams", json()) == false;
  return !(no_pins && no_handles && no_seams) || text_at(claims, "boundary") != "free" ||
         text_at(claims, "init") == "planar" || map.chart.size() > 0;
}

}  // namespace

Vector2 picture_direction(const MapFile& map, Alignment alignment) {
  if (alignment == Alignment::Never) return {1, 0};
  if (alignment == Alignment::Automatic && is_placed(map)) return {1, 0};
  return principal_direction(map.uv, map.cells);
}

MapFile turned(const MapFile& map, const Vector2& direction) {
  MapFile result = map;
  if (direction != Vector2(1, 0)) result.uv = turned_along(map.uv, direction);
  return result;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
