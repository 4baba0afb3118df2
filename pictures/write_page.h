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

#include <optional>
#include <string>
#include <vector>

#include "majorant/parametrization/maps/map_file.h"
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

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
