// Whether a map is injective as a whole: the proof from its boundary, for reports and messages.
//
//   const GlobalVerdict verdict = judge_global_injectivity(map, measures, vertices_of(file));
//   verdict.add_to(report["result"]);
//   findings.require(verdict.finding.empty(), verdict.finding);
#pragma once

#include <functional>
#include <string>

#include "apps/report.h"
#include "majorant/io/map_file.h"
#include "majorant/parametrization/global_injectivity.h"

namespace majorant::app {

struct GlobalVerdict {
  Json injective;       // true, false, or null: could not be decided
  Json boundary;        // {"pairs_tested", "contacts", "seconds"}
  std::string finding;  // why not, or why it could not be decided, naming edges and places

  // Sets "globally_injective" and "boundary".
  void add_to(Json& measures_section) const;
};

// Number, in the input, of the vertex at corner 0, 1, 2 of a face of the map.
using CornerNames = std::function<Index(Index face, Index corner)>;
// For maps that know their input, and for those whose faces are a file's cells in order (which may
// not know it: then the numbers of points). Only refer.
CornerNames vertices_of(const BezierMap& map);
CornerNames vertices_of(const MapFile& file);

GlobalVerdict judge_global_injectivity(const BezierMap& map, const MapMeasures& measures,
                                       const CornerNames& input_vertex);

}  // namespace majorant::app
