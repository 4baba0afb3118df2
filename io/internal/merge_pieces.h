// Pieces of a map that meet in points of the same input vertices, as one map (pvtu.h).
//
//     const MapFile map = merged(pieces, names, "all.pvtu");
#pragma once

#include <string>
#include <vector>

#include "majorant/parametrization/maps/map_file.h"

namespace majorant {

// pieces: at least one; names: theirs, for messages. Throws Error(Unreadable).
MapFile merged(const std::vector<MapFile>& pieces, const std::vector<std::string>& names,
               const std::string& path);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
