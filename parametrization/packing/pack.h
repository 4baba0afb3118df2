// Charts side by side in one square, as small as it gets, or in several of one size: none is
// scaled, none overlaps another.
//
//   std::vector<BezierMap> charts{map, map, map};     // as they came out of the solver
//   const Packing packing = pack(charts, {.padding_pixels = 4, .resolution = 1024});
//   std::vector<Vector2> texture;
//   for (const BezierMap& chart : packing.charts)     // in a texture: between 0 and 1
//     texture.push_back((chart.evaluate(0, {1, 0, 0}) - packing.origin) / packing.side);
//
// Every chart is turned until its smallest box lies straight, or, where most of its boundary does
// so in one direction, that boundary; then placed by the outline of its curved image: at rest in
// the holes and bays of others, too. Three ways are taken and the smallest square wins: shelves of
// boxes (a skyline), which any number of charts survives; a raster of outlines; and for few charts
// libnest2d, which slides polygons along each other. What they say is not believed: the distances
// are proven on the digits returned, and det J > 0 again for every chart that was moved.
//
// Not for one chart alone that shall stay as it is; not for charts whose own image overlaps, of
// which nothing is said here (global_injectivity.h).
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "majorant/certify/moved_layout.h"
#include "majorant/framework/stop_check.h"
#include "majorant/maps/bezier_map.h"

namespace majorant {

struct PackOptions {
  // Any two charts are at least padding_pixels / resolution of the square's side apart, and each
  // is as far from its border, so that textures may be repeated.
  // padding_pixels >= 0, resolution, the pixels along the side, > 0. A usual texture, and
  // two levels of its mipmaps that do not bleed; chosen, not tuned.
  double padding_pixels = 4;
  double resolution = 1024;
  // One flag a chart (empty: none): it stays where it is, to the bit. The square's lower left
  // corner is that of their common box, but for the border. Nothing is promised of the distance of
  // two of them.
  std::vector<char> fixed = {};
  // The direction on the surface, as its positions have it, that points upwards in every chart. A
  // chart that it has no direction in, since it lies across, is turned as it fits; one whose
  // smallest faces bear no turn keeps the turn that it has.
  std::optional<Vector3> up = {};
  // Whether charts that lie straight may be turned by quarters so that they fit.
  bool quarter_turns = true;
  // Squares that charts may be spread over, all of one size, side by side as UDIM has them:
  // tile_corner(). From 1 to kMostTiles; more than 1 without fixed charts.
  int tiles = 1;
  // Of the square, its border included, in units of the charts; none: as small as it gets. Without
  // fixed charts.
  std::optional<double> side = {};
  // Quick: shelves of boxes alone where all charts fit, for runs that are to end: some 0.1 s for
  // 10,000 charts, their proofs aside.
  enum class Effort { Smallest, Quick } effort = Effort::Smallest;
};

inline constexpr int kMostTiles = 100;

// Lower left corner of a tile, in sides: ten in a row, tile 0 at the origin.
Vector2 tile_corner(int tile);
// Its number in names of files: 1001 and on.
int udim(int tile);

enum class PackMethod { Skyline, Raster, Nesting };

// "skyline", "raster", "nesting".
std::string_view name_of(PackMethod method);

struct Packing {
  std::vector<BezierMap> charts;         // in the order given; their digits are final
  std::vector<LayoutMotion> placements;  // of each
  Vector2 origin = Vector2::Zero();      // lower left corner of the square, model units
  double side = 0;                       // of the square that contains all control points, border
                                         // included; of each tile
  std::vector<int> tiles;                // of each chart, which is in origin + side *
                                         // (tile_corner(tile) + [0, 1]^2)
  // The square has a size of its own, whatever lies in it: there are tiles, or it was given.
  bool has_tiles = false;
  double border = 0;    // with tiles; proven: no control point is nearer to the border of its tile
  double fill = 0;      // area of the charts / area of the tiles that have some
  double distance = 0;  // proven: of any two charts, not both fixed, at least this
  PackMethod method = PackMethod::Skyline;
};

// The same bits for any number of threads; no clock is asked. charts: each one component with a
// boundary, det J > 0. Throws Error(Unsupported) where the padding leaves no room for that many
// charts, a given side none for the charts, or fixed ones none for what cannot be moved;
// InvalidArgument for options out of range; Stopped.
Packing pack(const std::vector<BezierMap>& charts, const PackOptions& options = {},
             const StopCheck& stop = {});

// Returns the side of the square, its border included, that shelves of boxes of these sizes need:
// an estimate of Packing::side for charts with such boxes, which outlines mostly allow to be
// smaller. Infinity where the padding leaves no room.
double side_of_shelves(const std::vector<Vector2>& boxes, const PackOptions& options = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
