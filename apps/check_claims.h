// The claims of a result, majorant_claims, against what is found.
#pragma once

#include <string>

#include "apps/findings.h"
#include "apps/report.h"
#include "majorant/io/map_file.h"

namespace majorant::app {

// A result to be checked. Only refers.
struct CheckedMap {
  const MapFile& file;
  const BezierMap& map;  // faces in the order of the file's cells
  const MapMeasures& measures;
  const Json& claims;          // null when there are none
  const std::string& surface;  // mesh file, may be empty
};

// The claims, null when there are none; undoes the normalization they tell of.
Json read_claims(MapFile& file, Findings& findings);

// Energy, degree, pins, boundary, arrays. Throws Json::exception for claims of the wrong type.
void check_claims(const CheckedMap& checked, Findings& findings);

}  // namespace majorant::app
