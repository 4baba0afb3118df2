// The charts of an atlas as one map file.
//
//   std::vector<MapFile> charts;
//   const MapFile file = joined(charts);
//   write_vtu("bunny.vtu", file);
#pragma once

#include <vector>

#include "majorant/parametrization/maps/map_file.h"

namespace majorant {

// charts: of one degree; each with all of the optional arrays or none, as every other. Points in
// the order of the charts; cells in the order of their input_face, as a mesh of the input's faces
// has them; `chart` says which cell belongs to which. No claims. Throws InvalidArgument for
// different degrees, or none.
MapFile joined(const std::vector<MapFile>& charts);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
