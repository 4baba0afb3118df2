// What reports and lines say of a quad mesh that was judged.
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

// Nothing: turned quads and distances are unknown, null in reports. So is all but the count where
// the faces make no surface.
enum class QuadsComparedWith { Nothing, Surface };

// NotRequested: whether features are covered is unknown, null in reports.
enum class QuadsFeatures { NotRequested, Requested };

// check: of these quads.
Json quads_section(const PolygonMesh& quads, const QuadCheck& check, QuadsComparedWith surface,
                   QuadsFeatures features);

// Where it is valid what is proven and measured, else what is wrong: one line.
std::string describe(const QuadCheck& check, QuadsComparedWith surface);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
