// Report sections and summaries of a judged quad mesh.
//
//   const QuadCheck check = check_quads(polygons, mesh.get());
//   const Json section =
//       quads_section(polygons, check, QuadsComparedWith::Surface, QuadsFeatures::NotRequested);
//   std::cout << describe(check, QuadsComparedWith::Surface) << "\n";
#pragma once

#include <string>

#include "majorant/apps/jobs/report.h"
#include "majorant/quads/check_quads.h"

namespace majorant {

// Nothing: turned quads and distances are unknown, null in reports. If the faces form no surface,
// all values except the count are null.
enum class QuadsComparedWith { Nothing, Surface };

// NotRequested: whether features are covered is unknown, null in reports.
enum class QuadsFeatures { NotRequested, Requested };

// check: the judgement of these quads.
Json quads_section(const PolygonMesh& quads, const QuadCheck& check, QuadsComparedWith surface,
                   QuadsFeatures features);

// Returns one line: the proven and measured facts if the mesh is valid, else its faults.
std::string describe(const QuadCheck& check, QuadsComparedWith surface);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
