// What a run is doing, for whoever waits for it.
//
//   std::string_view now;
//   RunRecord record(60, 1000, nullptr, {}, [&](Activity a) { now = activity_name(a); });
//
// Solvers, starts and measurements announce through their RunRecord (run_record.h) what they begin;
// it lasts until the next one is announced, and one may come more than once. Steps are told apart
// (trace.h): they all happen while Solving.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace majorant {

enum class Activity {
  Reading,
  Cutting,   // of a surface that becomes charts
  Starting,  // the first map, on coarser meshes too
  Scaffold,  // the first triangulation of the space around an image
  Solving,
  Measuring,
  Packing,
  Proving,  // that nothing overlaps; of a file, all that is asked of it
  Writing,  // each file proven before it takes its name
};

constexpr std::string_view activity_name(Activity activity) {
  constexpr std::array<std::string_view, 9> kNames{"reading",  "cutting", "start",
                                                   "scaffold", "solving", "measuring",
                                                   "packing",  "proving", "writing"};
  return kNames[static_cast<std::size_t>(activity)];
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
