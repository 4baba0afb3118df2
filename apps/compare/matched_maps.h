// Matches two maps of one surface, cell by cell.
//
//   const MapFile b = matched_to(file, "a.vtu", read_map("b.vtu"), "b.vtu");   // its faces
#pragma once

#include <string>

#include "majorant/maps/map_file.h"

namespace majorant {

// Returns `map` with its cells, and the corners of each cell, in the order of `model`. Cells
// correspond if their corners have the same positions. Degrees and cuts may differ. Throws
// Error(Unsupported), naming both files, if they are maps of different surfaces.
MapFile matched_to(const MapFile& model, const std::string& model_name, const MapFile& map,
                   const std::string& name);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
