// The data of a page (docs/pictures.md): arrays of the map in base64, little endian, and the rest
// as JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "majorant/elements/bernstein_space.h"
#include "majorant/pictures/pictures.h"

namespace majorant {

// The highest degree that a page evaluates, that of all maps.
inline constexpr int kHighestPageDegree = BezierTriangleSpace::kMaxDegree;

// Throws Error(Invalid) if a part of the page does not fit its map.
nlohmann::ordered_json page_data(const MapPage& page);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
