// The claims of a result, majorant_claims, against what is found. Claims describe: none of them
// changes what check_command proves.
#pragma once

#include "majorant/apps/jobs/findings.h"
#include "majorant/certify/map_proof.h"
#include "majorant/io/claims.h"
#include "majorant/maps/measure.h"

namespace majorant {

// A result to be checked. Only refers.
struct CheckedMap {
  const MapFile& file;
  const BezierMap& map;         // faces in the order of the file's cells; uv of the file
  const MapMeasures& measures;  // of measure_as_claimed() (check_map.h)
  const Claims& claims;
  const PolygonMesh* surface;  // what it should be a map of; may be null
  const CutCount& cuts;        // with others than seams, marks and cones are not compared
};

// uv of the file (2 numbers a node) as the run had them, before --align and --normalize.
Vec in_units_of_the_run(VecIn uv, const Claims& claims);

// Energy, degree, pins, boundary, seams and cones, arrays.
void check_claims(const CheckedMap& checked, Findings& findings);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
