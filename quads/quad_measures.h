// The quality measures of a quad mesh, as a table with the keys of its report.
//
//   const QuadCheck check = check_quads(polygons, nullptr);
//   for (const QuadMeasure& measure : quad_measures())
//     std::cout << measure.key << " " << measure.value(polygons, check) << "\n";
//
// A new measure is one more row of the table in the source file, and its key in the schema of
// reports.
#pragma once

#include <span>
#include <string_view>

#include "majorant/mesh/polygon_mesh.h"
#include "majorant/quads/check_quads.h"

namespace majorant {

struct QuadMeasure {
  std::string_view key;  // JSON pointer into the quads' section of a report
  // check: the result of check_quads() for these quads, which are an oriented manifold.
  double (*value)(const PolygonMesh& quads, const QuadCheck& check);
};

std::span<const QuadMeasure> quad_measures();

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
