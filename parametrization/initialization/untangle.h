// Makes a map injective: moves the control points of a piecewise linear map, under the constraints
// of its specification, until every triangle is positively oriented.
//
//   UntangleResult r = untangle(spec, space, start, record);
//   if (r.inverted.empty()) ...   // r.x is a start for parametrize()
//
// By descend_untangling(). What it reaches is valid, not good: optimize it afterwards. It may fail:
// the constraints may leave no injective map of the given triangulation.
#pragma once

#include "majorant/constraints/untangling_descent.h"
#include "majorant/framework/run_record.h"
#include "majorant/maps/map_problem.h"

namespace majorant {

struct UntangleResult {
  Vec x;                        // 2 numbers per node; satisfies the constraints
  std::vector<Index> inverted;  // elements not proven positive; empty: success
  int iterations = 0;           // Newton steps
};

// spec: seams, pins, boundary; its energy is not looked at; its rest shapes should have the sizes
// that images are to get. space: of degree 1. start: any finite positions, which need not satisfy
// the constraints. first_eps: smaller changes a good start less; 0: kFirstEpsHeld or kFirstEps.
// Ends early when the start_stop() of `record` says so.
UntangleResult untangle(const MapSpecification& spec,
                        const std::shared_ptr<const BezierTriangleSpace>& space, VecIn start,
                        const RunRecord& record, double first_eps = 0);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
