// MapFile::claims, parsed for pictures: what is not understood is as if it were not said.
#pragma once

#include <nlohmann/json.hpp>

#include "majorant/io/map_file.h"

namespace majorant {

// An object: empty where there are no claims, or none that can be read. Judging them is for
// `check`.
nlohmann::json claims_of(const MapFile& map);

// The string at a key of an object, empty where there is none.
std::string text_at(const nlohmann::json& object, const char* key);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
