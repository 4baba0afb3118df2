// The data of a page, as docs/web_page.md describes them: the map's arrays in base64, little
// endian, and the rest in words.
#pragma once

#include <nlohmann/json.hpp>

#include "majorant/elements/bernstein_space.h"
#include "majorant/pictures/pictures.h"

namespace majorant {

// The highest degree a page evaluates: the highest there are maps of.
inline constexpr int kHighestPageDegree = BezierTriangleSpace::kMaxDegree;

// Throws Error(Invalid) that says what of the page does not fit its map.
nlohmann::ordered_json page_data(const MapPage& page);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
