// A map as a picture of pixels: the layout, or the surface with what the map lays on it.
//
//   write_png("layout.png", file);
//   PngOptions options;
//   options.view = Vector3(1, 0.5, 2);                    // from there: the surface, checkered
//   options.quantity = Quantity::Area;                    // or coloured by its distortion
//   write_png("surface.png", file, options);
//
// Every sample of every pixel (3 by 3) finds the cell it is in and the place there and evaluates
// the Bezier triangle and its Jacobian at it: no straight triangles in between, and heat maps vary
// inside of cells. The page of write_page.h does the same in a browser; with the conventions below
// both show the same.
//
//     * Camera: orthographic. `view` points from the surface to the eye; the y axis is up in the
//       picture (the z axis where `view` is closer than 3 degrees to it). What is seen, layout or
//       surface, is in the middle and as large as it fits with a margin of 2 % of the smaller side.
//     * Light comes from the eye: sRGB values times 0.72 + 0.28 |cos| of its angle with the normal,
//       which is interpolated between those of corners, means of the faces around them by area.
//     * Checkerboard: squares of 1, 2 or 5 times a power of ten uv units, at least a 40th of the
//       layout's larger side, edges on multiples of that.
//     * Image: upright over the unit square of layouts that were made for one (claimed to be
//       normalized, or without claims), over the square around the middle of others that has their
//       larger side; bilinear, and repeated beyond it.
//
// Not for what is to be measured or magnified: write_svg() and write_page() keep curves.
#pragma once

#include <optional>
#include <string>

#include "majorant/parametrization/maps/map_file.h"
#include "majorant/pictures/picture_options.h"

namespace majorant {

struct PngOptions {
  static constexpr int kSmallest = 16, kLargest = 8192;  // pixels on a side

  int width = 1000, height = 800;
  std::optional<Vector3> view = {};       // none: the layout
  std::optional<Quantity> quantity = {};  // none: see image
  // A PNG file that is laid on; none: a checkerboard on a surface, the density (grey where the
  // claims name no energy) on a layout.
  std::optional<std::string> image = {};
  std::optional<ColorRange> color_range = {};  // none: that of the fixed scale
  Alignment alignment = Alignment::Automatic;
};

// Heat maps have a legend below, as SVG's, with the same smallest and largest value, those of the
// whole map. Turned over cells have kFlippedColor. The bytes depend on the map and the options
// alone, not on the number of threads. Throws Error(Invalid) if the map is inconsistent or not
// finite, Error(Unreadable) for an image that is none, Error(Usage) for a size out of range, a view
// that is no direction, a range without the isometry, a density whose energy is not named, and
// where the file cannot be written.
void write_png(const std::string& path, const MapFile& map, const PngOptions& options = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
