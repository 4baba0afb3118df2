// Makes a map injective: moves the control points of a piecewise linear map, under the constraints
// of its specification, until every triangle is positively oriented.
//
//   UntangleResult r = untangle(spec, space, start, record);
//   if (r.inverted.empty()) ... r.x is a start for parametrize() ...
//
// Minimizes the untangling energy (energies/untangling.h) by projected Newton while its eps
// shrinks, after [GKKPRS21]. What it reaches is valid, not good: optimize it afterwards. It may
// fail: the constraints may leave no injective map of the given triangulation.
#pragma once

#include "majorant/parametrization/map_problem.h"
#include "majorant/parametrization/run_record.h"

namespace majorant {

struct UntangleResult {
  Vec x;                        // 2 numbers per node; satisfies the constraints
  std::vector<Index> inverted;  // elements not proven positive; empty: success
  int iterations = 0;           // Newton steps
};

// spec: seams, pins, boundary; its energy is not looked at. space: of degree 1. start: any finite
// positions, which need not satisfy the constraints. Ends early when `record` says so.
UntangleResult untangle(const MapSpecification& spec,
                        const std::shared_ptr<const BezierTriangleSpace>& space, VecIn start,
                        const RunRecord& record);

}  // namespace majorant
