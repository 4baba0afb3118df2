// The maps that a run goes through, every few iterations, for the page that shows them.
//
//   Film film(5, options.map.degree);
//   options.solve.watch = film.watcher();
//   RunRecord record;
//   const ParametrizationResult result = parametrize(mesh, options, record);
//   MapPage page;
//   page.map = to_map_file(*result.map);
//   page.snapshots = film.frames(
//       {*result.map, last_iteration(record.trace()), result.value_quadrature});
//
// Memory is bounded: frames are counted as the page holds them, 8 bytes a control point at the
// degree of the result. When one more would not fit, every second one goes, and from then on only
// every second one is taken. The start, iteration 0, is always one of them.
#pragma once

#include <cstddef>
#include <vector>

#include "majorant/parametrization/maps/map_observer.h"
#include "majorant/pictures/write_page.h"

namespace majorant {

class Film {
 public:
  // Of all frames: 46 of 10,000 cubic triangles.
  static constexpr std::size_t kMostBytes = std::size_t{1} << 24;

  struct Frame {
    BezierMap map;
    int iteration = 0;
    double energy = 0;
  };

  // every: iterations from frame to frame, at least 1. degree: of the result.
  Film(int every, int degree, std::size_t most_bytes = kMostBytes)
      : every_(every), degree_(degree), most_bytes_(most_bytes) {}

  // For SolveOptions::watch; the film outlives it.
  MapObserver watcher();
  int every() const { return every_; }  // now
  // How many frames() gives for a result of that iteration.
  std::size_t count(int last_iteration) const;
  // The frames and, as the last one, the result, elevated to its degree, by rising iterations.
  std::vector<PageSnapshot> frames(const Frame& result) const;

 private:
  static bool is_before(const Frame& frame, int last_iteration);
  void take(const TraceEntry& row, const MapView& at);

  int every_, degree_;
  std::size_t most_bytes_, frame_bytes_ = 0;
  std::vector<Frame> frames_;
};

// Of the last row, 0 where there is none.
int last_iteration(const std::vector<TraceEntry>& trace);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
