// Checks that a MapFile holds together, as readers demand of a file and writers of their input.
// This is bookkeeping only; injectivity and continuity are for `check` to judge.
#pragma once

#include <string>

#include "majorant/maps/map_file.h"

namespace majorant {

// One line that says what is wrong: sizes that do not match, point numbers out of range, values
// that are not finite, no cells. Empty for a sound map. Optional arrays may be empty.
std::string map_defect(const MapFile& map);

// For writers. Throws Error(Invalid, "cannot write PATH: ...") unless map_defect(map) is empty.
void require_sound(const std::string& path, const MapFile& map);
// For writers of formats whose faces all have texture coordinates. Throws Error(Unsupported) with
// the formats that do unless the map is complete.
void require_complete(const std::string& path, const MapFile& map);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
