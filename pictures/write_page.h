// A map as a page for a browser: the surface in 3D and the layout side by side, exact, in one file.
//
//   MapPage page;
//   page.title = "creature.obj";
//   page.map = read_map("creature.vtu");
//   page.points = {{.vertex = 12, .target = Vector2(0.5, 0.25), .hold = PagePoint::Hold::Pin}};
//   write_page("creature.html", page);
//
// The page holds the control points and evaluates the Bezier triangles itself, for every pixel: a
// texture, distortion in the words of parametrization/maps/distortion.h on fixed scales, the
// straight map of the same corners, what the mouse points at. It asks nobody for anything: no
// network, no other file. docs/pictures.md says what it shows and what its data look like.
//
// A picture, not data: numbers that others compute with belong into a .vtu.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "majorant/parametrization/maps/map_file.h"
#include "majorant/parametrization/maps/map_observer.h"
#include "majorant/pictures/picture_options.h"

namespace majorant {

// A vertex that was held or pulled: drawn at every copy of it, with a line to its target.
struct PagePoint {
  enum class Hold { Pin, Handle };  // exactly there; pulled there

  Index vertex = 0;  // of the input, as MapFile::input_vertex counts them
  Vector2 target;    // in the units of the map's uv
  Hold hold = Hold::Pin;
};

// A cell of which something is not true.
struct PageFault {
  Index cell = 0;
  std::string text;  // one line: what is wrong with it
};

// The map as it was during the run.
struct PageSnapshot {
  int iteration = 0;
  int degree = 1;  // of the run at that time
  double energy = 0;
  Points2 uv;  // #N by 2, in the numbering, the degree (elevated) and the units of MapPage::map
};

struct MapPage {
  std::string title;  // what is mapped, a file name say
  MapFile map;        // degree 1 to 8; it may be invalid, but must be finite
  std::optional<MapFile> scaffold =
      std::nullopt;  // the space around the image, of the map's degree
  std::vector<PagePoint> points = {};
  std::vector<PageFault> faults = {};  // listed in this order
  // A JSON object: what is known of the map, as in reports. Shown are `status`, `command`,
  // `message`, the numbers of `result` and `distortion`, `proofs` and `findings`, where these are.
  std::string facts = "{}";
  Alignment alignment = Alignment::Automatic;  // of the layout as it is shown
  // What is shown first; none: a checkered texture, or the density where color_range is given.
  std::optional<Quantity> quantity = std::nullopt;
  // Of that quantity; none: the fixed range of its scale.
  std::optional<ColorRange> color_range = std::nullopt;
  // By rising iterations. They are kept in single precision, 8 bytes a control point each.
  std::vector<PageSnapshot> snapshots = {};
};

// Texts may hold any bytes; what is not UTF-8 is shown as U+FFFD. Energy and scale of the layout
// are those of the map's claims. The output depends on nothing but `page`.
// Throws Error(Invalid) if the map is inconsistent, not finite or of a degree above 8, or if
// points, faults or snapshots do not belong to it, Error(Usage) if the file cannot be written or
// the range leaves out the isometry.
void write_page(const std::string& path, const MapPage& page);

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
