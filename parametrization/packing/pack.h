// Charts side by side in one square of nearly the least size, or in several squares of one size. No
// chart is scaled, and no two overlap.
//
//   std::vector<BezierMap> charts{map, map, map};     // as they came out of the solver
//   const Packing packing = pack(charts, {.padding_pixels = 4, .resolution = 1024});
//   std::vector<Vector2> texture;
//   for (const BezierMap& chart : packing.charts)     // in a texture: between 0 and 1
//     texture.push_back((chart.evaluate(0, {1, 0, 0}) - packing.origin) / packing.side);
//
// Every chart is rotated until its smallest bounding box is axis-aligned, or, if most of its
// boundary runs along one direction, until that direction is. Then it is placed by the outline of
// its curved image, also into holes and bays of other charts.
//
// Three packers compete and the smallest square wins: shelves of boxes (a skyline), which work for
// any number of charts; a raster of outlines; and for few charts libnest2d, which slides polygons
// along each other. Their results are not trusted: the distances are proven on the digits returned,
// and det J > 0 again for every chart that was moved.
//
// Charts whose own image overlaps are not detected here (global_injectivity.h).
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "majorant/certify/moved_layout.h"
#include "majorant/framework/stop_check.h"
#include "majorant/maps/bezier_map.h"

namespace majorant {

struct PackOptions {
  // Any two charts are at least padding_pixels / resolution of the square's side apart, and each is
  // as far from its border, so that textures may be repeated. padding_pixels >= 0; resolution, the
  // pixels along the side, > 0. The defaults are a usual texture and two mipmap levels without
  // bleeding; chosen, not tuned.
  double padding_pixels = 4;
  double resolution = 1024;
  // Flags of charts that stay where they are, to the bit (empty: none). The square's lower left
  // corner is then that of their common box, less the border. The distance of two fixed charts is
  // not guaranteed.
  std::vector<char> fixed = {};
  // The direction on the surface, in its coordinates, that points upwards in every chart. A chart
  // that lies across it has no such direction and is rotated freely. A chart keeps its rotation if
  // rounding would invert its smallest faces.
  std::optional<Vector3> up = {};
  // True: axis-aligned charts may be rotated by quarter turns.
  bool quarter_turns = true;
  // The number of squares that charts may be spread over, all of one size, side by side as in UDIM:
  // tile_corner(). From 1 to kMaxTiles; more than 1 excludes fixed charts.
  int tiles = 1;
  // The side of the square with its border, in units of the charts; none: as small as possible.
  // Excludes fixed charts.
  std::optional<double> side = {};
  // Quick: shelves of boxes alone, if all charts fit, for runs that are to end: some 0.1 s for
  // 10,000 charts, without their proofs.
  enum class Effort { Smallest, Quick } effort = Effort::Smallest;
};

inline constexpr int kMaxTiles = 100;

// Returns the lower left corner of a tile, in sides: ten in a row, tile 0 at the origin.
Vector2 tile_corner(int tile);
// Returns the tile's number in file names: 1001 and on.
int udim(int tile);

enum class PackMethod { Skyline, Raster, Nesting };

// "skyline", "raster", "nesting".
std::string_view name_of(PackMethod method);

struct Packing {
  std::vector<BezierMap> charts;         // in the input's order; their digits are final
  std::vector<LayoutMotion> placements;  // of each
  Vector2 origin = Vector2::Zero();      // lower left corner of the square, model units
  double side = 0;                       // of the square with its border, or of each tile
  std::vector<int> tiles;  // by chart, in origin + side * (tile_corner(tile) + [0, 1]^2)
  // True if the square has a given size and place: there are tiles, or PackOptions::side.
  bool has_tiles = false;
  double border = 0;    // with tiles; proven: lower bound on distances of control points to it
  double fill = 0;      // area of the charts / area of the tiles that hold some
  double distance = 0;  // proven: lower bound for any two charts that are not both fixed
  PackMethod method = PackMethod::Skyline;
};

// Packs the charts. The result is the same to the bit for any number of threads; no clock is read.
// charts: each one component with a boundary, det J > 0. Throws Error(Unsupported) if the padding
// leaves no room for that many charts, the given side is too small, or fixed charts leave no room
// for those that cannot be moved. Throws InvalidArgument for options out of range; Stopped.
Packing pack(const std::vector<BezierMap>& charts, const PackOptions& options = {},
             const StopCheck& stop = {});

// Returns the side of the square, with its border, that shelves of boxes of these sizes need. It
// estimates Packing::side for charts with such boxes; outlines mostly need less. Infinity if the
// padding leaves no room.
double side_of_shelves(const std::vector<Vector2>& boxes, const PackOptions& options = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
