// Whether a map is injective as a whole: the proof from its boundary, for reports and messages.
//
//   const GlobalVerdict verdict = judge_global_injectivity(map, measures, vertex_names);
//   verdict.add_to(report["result"]);
//   findings.require(verdict.finding.empty(), verdict.finding);
#pragma once

#include <functional>
#include <string>

#include "apps/report.h"
#include "majorant/parametrization/global_injectivity.h"

namespace majorant::app {

struct GlobalVerdict {
  Json injective;       // true, false, or null: could not be decided
  Json boundary;        // {"pairs_tested", "contacts", "seconds"}
  std::string finding;  // why not, or why it could not be decided, naming edges and places

  // Sets "globally_injective" and "boundary".
  void add_to(Json& measures_section) const;
};

// Number, in the input, of a vertex of the map's mesh.
using VertexNames = std::function<Index(Index)>;

GlobalVerdict judge_global_injectivity(const BezierMap& map, const MapMeasures& measures,
                                       const VertexNames& input_vertex);

}  // namespace majorant::app
