// Makes a map injective: moves the control points of a piecewise linear map, under the constraints
// of its specification, until every triangle is positively oriented.
//
//   UntangleResult r = untangle(spec, space, start, record);
//   if (r.inverted.empty()) ...   // r.x is a start for parametrize()
//
// It uses descend_untangling(). The result is valid but not optimal, so it should be optimized
// afterwards. It may fail, since the constraints may admit no injective map of the triangulation.
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

// Untangles a map on a space of degree 1. The seams, pins and boundary of `spec` hold, and its
// energy is ignored. Its rest shapes should have the sizes of the images. The start may be any
// finite positions, which need not satisfy the constraints. Smaller values of first_eps change a
// good start less; 0: kFirstEpsHeld or kFirstEps. Ends early if the start_stop() of `record` says
// so.
UntangleResult untangle(const MapSpecification& spec,
                        const std::shared_ptr<const BezierTriangleSpace>& space, VecIn start,
                        const RunRecord& record, double first_eps = 0);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
