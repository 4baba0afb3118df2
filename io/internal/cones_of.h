// The cones of a map with seams, for writers of formats that know them as comments only.
#pragma once

#include <map>

#include "majorant/parametrization/maps/map_file.h"

namespace majorant {

// Quarter turns by vertex of the input, from 0; of vertices that the file knows.
std::map<Index, int> cones_of(const MapFile& map);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
