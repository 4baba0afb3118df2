// From a plain mesh to a seamless, locally injective map of degree 1: the start of
// `majorant seamless`.
//
//   RunRecord record;
//   SeamlessMap seamless = make_seamless(mesh, {}, record);
//   ParametrizationResult result = parametrize(seamless.map, options, record);
//
// Cross field -> cones -> cut graph -> integration under the seams' constraints -> untangling.
#pragma once

#include <string>
#include <vector>

#include "majorant/parametrization/bezier_map.h"
#include "majorant/parametrization/cross_field.h"
#include "majorant/parametrization/run_record.h"

namespace majorant {

struct SeamlessOptions {
  CrossFieldOptions field;  // where no cones are given
  std::vector<Cone> cones;  // vertices of the mesh; empty: those of the field
};

struct SeamlessMap {
  BezierMap map;       // of the cut surface, locally injective
  Index inverted = 0;  // triangles that integrating the field left inverted
  int untangling_steps = 0;
};

// mesh: connected, closed or bounded, any genus. Throws Error(Invalid) naming the cones at the
// triangles that could not be untangled; Error as cross_field.h has it for cones that cannot be.
SeamlessMap make_seamless(const SurfaceMesh& mesh, const SeamlessOptions& options,
                          const RunRecord& record);

}  // namespace majorant
