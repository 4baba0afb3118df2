// Watches a map on its way: called with the start, in a row of its own whose iteration is that of
// the row before it (0 at first), and after every row of the trace. Starts that are pulled to their
// pins are seen, too; what is answered then does not count.
//
//   options.solve.watch = [](const TraceEntry& row, const MapView& at) {
//     if (row.record.iteration == 10) map = at.in_model_units();
//     return row.energy < 4.1 ? Directive::Interrupt : Directive::Continue;
//   };
//
// Not for what needs no map: RunRecord tells rows of the trace and activities (run_record.h), a
// Minimizer its iterations (minimizer.h).
#pragma once

#include <functional>
#include <memory>

#include "majorant/framework/run_record.h"
#include "majorant/parametrization/maps/bezier_map.h"

namespace majorant {

// The state of a run; valid during the call.
struct MapView {
  const std::shared_ptr<const BezierTriangleSpace>& space;  // of the row's degree
  VecIn x;  // control points as they are minimized: MapExtension::scale() * (u, v)
  std::function<BezierMap()> in_model_units;  // costs what it takes to copy the map
};

// Anything but Continue ends the run with that status and the best map so far.
using MapObserver = std::function<Directive(const TraceEntry& row, const MapView& at)>;

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
