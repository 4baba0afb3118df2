// The atlas of a surface: every component is cut open, every chart mapped without overlaps, and all
// charts are packed into one square.
//
//   const RepairedSurface surface = repair(read_mesh(path));
//   RunRecord record;
//   const Atlas atlas = unwrap(surface.mesh, {}, record);
//   for (const Chart& chart : atlas.charts) chart.map->evaluate(0, {1, 0, 0});
//
// Cuts (choose_cuts.h) -> pieces, each a disk or a disk with holes -> one globally injective map a
// piece -> packing (pack.h). Charts are solved in parallel and independently: each is the result of
// parametrize() for its piece alone, whatever the number of threads.
//
// The record's RunObserver is notified of every step of charts of some thousand faces, and of each
// smaller chart when it is done (after_part). One thread notifies at a time; the order of charts is
// arbitrary. Charts that are cut and mapped again form another pass.
//
// Every chart of a finished run has a valid map: if a solve fails, the chart keeps its best valid
// map, possibly its initial one, and its status says so. In a run that was stopped some charts may
// have no map yet: Atlas::unmapped lists them, and the others form a layout.
//
// For the best map of one disk, use parametrize().
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "majorant/certify/moved_layout.h"
#include "majorant/framework/run_record.h"
#include "majorant/maps/bezier_map.h"
#include "majorant/parametrization/atlas/stretch.h"
#include "majorant/parametrization/packing/pack.h"
#include "majorant/parametrization/seams/choose_cuts.h"
#include "majorant/parametrization/seams/congruent_surfaces.h"
#include "majorant/parametrization/solve/parametrize.h"

namespace majorant {

// The initial map that the map of a chart came from.
// * Tutte: tutte_map().
// * Multiresolution: multiresolution_map(), for large charts.
// * Parent: the map of the chart that it was cut from.
// * Unfolded: the faces laid side by side in their own shapes. It serves flat panels between
//  creases, and strips whose Tutte's map led to overlaps.
// * Projected: the chart as seen from one side, where Tutte's map is far from any minimum.
// * Texture: the file's coordinates, rotated and mirrored as they lie.
// * Untangled: the file's coordinates after inverted triangles were repaired.
// * Anew: one of the first five, because the file's coordinates overlap, have no area or could not
//  be untangled.
enum class ChartStart {
  Tutte,
  Multiresolution,
  Parent,
  Unfolded,
  Projected,
  Texture,
  Untangled,
  Anew
};
// "tutte", "multiresolution", "parent", "unfolded", "projected", "texture", "untangled", "anew"
std::string_view start_name(ChartStart start);

struct Chart {
  std::vector<Index> faces;      // of the surface, by face of the map
  std::optional<BezierMap> map;  // always set; model units, injective
  Status status = Status::Failed;
  std::string message;  // why the solve ended
  ChartStart start = ChartStart::Tutte;
  MapMeasures measures;
  Stretch stretch;
  std::vector<Pin> pins;  // vertices of the map's mesh; a chart with pins stays at their targets
  std::vector<TraceEntry> trace;
  // The earlier chart that this one is stacked on. The map of a mirrored chart is positive, as all
  // maps are; its reflection at u = 0 lies on the other chart.
  std::optional<StackPlace> place;
};

// The effect of CutOptions::max_stretch on charts of CutMethod::Automatic and Sharp.
// * Kept: charts are mapped, measured, cut and mapped again until none exceeds the limit. Charts of
//  one face, of faces without an area, or with pins or handles are not cut. Cutting ends when a
//  limit of the run is reached; the default number of iterations is no such limit, a chart that
//  reaches it is cut.
// * Reported: nothing is cut.
enum class StretchLimit { Kept, Reported };

// The fraction of a time limit after which cuts that suffice are accepted as they are; the rest of
// the time is for maps.
inline constexpr double kCuttingShare = 0.4;

// The fraction of the square that charts fill by default (kUsualFill), and the relative growth of
// the length of borders that may be spent on it: kLittleSeam, or kMoreSeam for charts that fill
// less than kLowFill. The reference length is half of that of all borders, which on a closed
// surface is the length of the seams; it is positive also for a sheet, which has no seam. Tuned by
// bench/atlas.py.
inline constexpr double kUsualFill = 0.5, kLittleSeam = 0.15, kLowFill = 0.4, kMoreSeam = 0.6;

// The treatment of the islands of CutMethod::Texture. Mapped: each becomes a chart that is solved.
// Kept: the islands are the charts, in the shapes that they have in the file, all at one scale and
// at degree 1. Pins and handles are not allowed then, and of UnwrapOptions::chart only the energy
// is used.
enum class Islands { Mapped, Kept };

struct UnwrapOptions {
  // The options of every chart: degree, energy and so on. Vertices of pins and handles are those of
  // the surface; cuts avoid them. The injectivity is always Global, and `initial` is ignored. A
  // chart minimizes
  //     mean density + handle_weight * (sum of squared distances of its handles) / its area
  // so that all charts together, weighted by area, minimize the same of the whole surface: a weight
  // means the same in every chart.
  ParametrizationOptions chart = {};
  CutOptions cuts = {};
  StretchLimit limit = StretchLimit::Kept;
  // Charts of Automatic or Sharp cuts whose limit is Kept are divided until there are at least this
  // many. 0: until a division no longer lowers the cost of the layout (docs/atlas.md, "One chart or
  // many"). The result has fewer charts where no more can be divided (Atlas::division).
  Index least_charts = 0;
  // Charts with a larger area of the surface are divided too, where possible, whatever the layout
  // costs then. Model units.
  double max_chart_area = std::numeric_limits<double>::infinity();
  // Charts are then divided until they fill this fraction of the packing's square, at any cost, or
  // less where that is impossible. 0: no division for the sake of the fill. None: until they fill
  // kUsualFill, if that takes little seam (kLittleSeam, kMoreSeam); not with least_charts or a
  // given side. Ignored with Stacking, face_scale and several tiles.
  std::optional<double> least_fill = {};
  // Seconds from the start of the run after which cuts that suffice are not shortened further.
  double cutting_seconds = std::numeric_limits<double>::infinity();
  Islands islands = Islands::Mapped;
  // Applies to packed charts without pins and handles.
  Stacking stacking = Stacking::None;
  // Factors of the size of charts, > 0 and constant within a chart: #F, or empty. Measures are
  // those of the scaled charts.
  Vec face_scale = {};
  std::optional<PackOptions> packing =
      PackOptions();  // none: charts stay where the solver has them
};

// Returns the worse of two statuses, in this order from the best: converged, stalled, a limit of
// iterations, of time, interrupted, infeasible, failed.
Status worse_of(Status a, Status b);

// Times of the stages, seconds.
struct AtlasSeconds {
  double cut = 0;    // the first cuts
  double recut = 0;  // choice and cutting of charts that are cut again or divided
  double map = 0;    // maps of all charts, with those that were cut again
  double pack = 0;
};

// The charts without a map in a run that was stopped.
struct UnmappedCharts {
  std::vector<Index> faces;           // of the surface, ascending
  Index count = 0;                    // of charts
  Status status = Status::Converged;  // TimeLimit or Interrupted if there are any
};

struct Atlas {
  SurfaceCuts cuts;           // of all charts
  std::vector<Chart> charts;  // those with a map, in the order of their first faces
  UnmappedCharts unmapped;
  std::optional<Packing> packing;  // of the maps, which are in place
  // TimeLimit or Interrupted if the run was stopped during packing; charts then have the first
  // arrangement.
  Status packed = Status::Converged;
  AtlasSeconds seconds = {};
  // Why the division of charts ended (least_charts, least_fill). Converged: both are reached, or no
  // further division gains anything. MaxIterations: the bound on packings was reached before the
  // fill.
  Status division = Status::Converged;

  // Returns whether every chart has a map.
  bool is_complete() const { return unmapped.count == 0; }
  // Returns the worst status of the charts, those without a map included, and of packing. Converged
  // only if all are.
  Status status() const;
  // Returns the message of the first chart with that status, or of packing; empty if all converged.
  std::string message() const;
  // Returns the mean of the energy over the surface.
  double value() const;
  Stretch stretch() const;
};

// Computes the atlas. surface: any number of components (repair.h). Throws Error(Usage) as
// parametrize() for options, and the errors of choose_cuts(). Throws Error(Infeasible) if a chart's
// pins cannot be met, or if a pin or handle with a target has several places, on a seam or where
// sheets were split. Throws Stopped before any chart has a map.
Atlas unwrap(const std::shared_ptr<const SurfaceMesh>& surface, const UnwrapOptions& options,
             RunRecord& record);

// Returns whether a chart stretches more than options.cuts.max_stretch, whether that limit is kept
// or not. False for charts that consist of faces without an area: cuts cannot improve them.
bool exceeds_stretch(const UnwrapOptions& options, const Chart& chart);
// Returns why a chart stretches more than options.cuts.max_stretch. Empty if the limit is not kept
// or the chart does not exceed it.
std::string why_stretched(const UnwrapOptions& options, const Chart& chart);

// Returns the current maps of all charts.
std::vector<BezierMap> maps_of(const Atlas& atlas);

// Scales the maps of all charts by one factor so that the packing's square becomes the unit square;
// without a packing, the larger side of the charts' bounding box becomes 1. If rounding inverts a
// triangle or brings charts closer than the packing guarantees, uses the next power of two as the
// size instead, except for tiles, whose borders are proven too. Returns none and leaves the atlas
// unchanged if that does not help. Measures stay in model units.
std::optional<LayoutMotion> into_unit_square(Atlas& atlas);
// Returns why into_unit_square() fails, as one line without a full stop.
std::string problem_in_unit_square(const Atlas& atlas);

// Returns the larger side of the bounding box of all charts.
double layout_size(const Atlas& atlas);
// Returns the border_clearance() of the chart where it lies; none if that is at_most or more.
std::optional<double> clearance(const Chart& chart, double at_most);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
