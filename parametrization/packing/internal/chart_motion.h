// A chart turned and moved: its digits rounded, its proof made again.
//
//   const std::optional<MovedChart> there = moved_chart(map, Placement{0, 1, {3, 0}});
//   if (!there) say("cells too small to be anywhere else\n");
#pragma once

#include <optional>

#include "majorant/framework/stop_check.h"
#include "majorant/parametrization/packing/pack.h"

namespace majorant {

struct MovedChart {
  BezierMap map;
  Placement placement;  // as asked for, or turned by 1e-9 radians more where rounding required it
};

// None where det J > 0 could be proven for no way of rounding that was tried: the chart has cells
// that doubles do not resolve at the new place.
std::optional<MovedChart> moved_chart(const BezierMap& chart, const Placement& placement,
                                      const StopCheck& stop = {});

// det J > 0 on every face, proven on the digits as they are.
bool has_positive_determinants(const BezierMap& map, const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
