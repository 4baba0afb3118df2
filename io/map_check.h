// Checks the consistency of a MapFile, for readers of files and writers of maps. `check` judges
// injectivity and continuity.
#pragma once

#include <string>

#include "majorant/maps/map_file.h"

namespace majorant {

// Returns one line about a defect: sizes that do not match, point numbers out of range, values that
// are not finite, no cells. Empty for a sound map. Optional arrays may be empty.
std::string map_defect(const MapFile& map);

// For writers. Throws Error(Invalid, "cannot write PATH: ...") unless map_defect(map) is empty.
void require_sound(const std::string& path, const MapFile& map);
// For writers of formats whose faces all have texture coordinates. Throws Error(Unsupported) that
// names other formats unless the map is complete.
void require_complete(const std::string& path, const MapFile& map);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
