// What the digits of a file, which are not exactly its doubles (MapFile::uv_rounding: decimals, or
// values where control points are needed), leave of what is known of det J on a cell.
//
//   const Points2 points = file.uv(file.cells.row(12), Eigen::all);
//   const CellPositivity exact = beyond_rounding(file, 12, exact_positivity(points));
#pragma once

#include "majorant/certify/exact_positivity.h"
#include "majorant/parametrization/maps/map_file.h"

namespace majorant {

// How far det J of the map that the digits make may be from that of the doubles, anywhere on the
// cell; 0 where they are the same.
double rounding_of_determinant(const MapFile& file, Index cell);

// What remains of an exact answer for the doubles: itself, or Undecided.
CellPositivity beyond_rounding(const MapFile& file, Index cell, const CellPositivity& exact);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
