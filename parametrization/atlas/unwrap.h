// From any surface to one layout: every component opened, every chart mapped without overlaps, all
// of them packed into one square.
//
//   const RepairedSurface surface = repair(read_mesh(path));
//   RunRecord record;
//   const Atlas atlas = unwrap(surface.mesh, {}, record);
//   for (const Chart& chart : atlas.charts) chart.map->evaluate(0, {1, 0, 0});
//
// Cuts (choose_cuts.h) -> pieces, each a disk or a disk with holes -> one map a piece, injective as
// a whole -> packing (pack.h). Charts are solved at the same time, and independently: each is what
// parametrize() gives for its piece alone, whatever the number of threads.
//
// The record's RunObserver is told every step of charts of some thousand faces, and of smaller ones
// all of them once they are done (after_part), one thread at a time: they are solved side by side,
// in any order. Where charts are cut and mapped again, that is another pass.
//
// Every chart has a valid map in the end: where a solve does not end with one, the chart keeps the
// best valid map there was, the start if need be, and its status says so. In a run that was stopped
// some charts may have no map yet: Atlas::unmapped has them, and the others are a layout of their
// own.
//
// Not for the best map of one disk: parametrize().
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

// The start that the map of a chart came from. Tutte: tutte_map(). Multiresolution:
// multiresolution_map(), of large charts. Parent: the map of the chart that it was cut from.
// Unfolded: the faces laid side by side in their own shapes (flat panels between creases; strips,
// where Tutte's map led to overlaps). Projected: as it is seen from one side, where Tutte's map is
// far from any minimum. Texture: the file's
// coordinates, turned and mirrored as they lie. Untangled: those, after triangles were turned over.
// Anew: one of the first five, because the file's coordinates overlap or have no area, or could not
// be untangled.
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
  std::optional<BezierMap> map;  // always there; model units, injective
  Status status = Status::Failed;
  std::string message;  // why the solve ended
  ChartStart start = ChartStart::Tutte;
  MapMeasures measures;
  Stretch stretch;
  std::vector<Pin> pins;  // vertices of the map's mesh; with pins it stays where they put it
  std::vector<TraceEntry> trace;
  // Where it lies on an earlier chart. The map of one that is mirrored is positive, as all are: it
  // is that which turned over at u = 0 lies there.
  std::optional<StackPlace> place;
};

// What CutOptions::max_stretch is for maps of CutMethod::Automatic and Sharp. Kept: charts are
// mapped, measured, cut again and mapped anew until each has no more; not those of one face, of
// faces without an area alone or with pins or handles, and not once a limit of the run is reached;
// a thousand iterations are no such limit, but the end of what a chart is worth.
// Reported: nothing is done.
enum class StretchLimit { Kept, Reported };

// The part of a time limit that cuts get at most, before those that suffice are taken as they are;
// the rest is for maps.
inline constexpr double kCuttingShare = 0.4;

// What charts fill of the square unless something else is asked for, if that is to be had for this
// part of their borders more of seams (half of the length of all borders, which is that of the
// seams of a closed surface); where they fill less than kLowFill alone, for that part. Borders are
// counted since a sheet, which has no seam, is divided, too. Tuned by bench/atlas.py.
inline constexpr double kUsualFill = 0.5, kLittleSeam = 0.15, kLowFill = 0.4, kMoreSeam = 0.6;

// What becomes of the islands of CutMethod::Texture. Kept: they are the charts, in the shapes that
// they have in the file, all at one scale; at degree 1, without pins and handles,
// and nothing else of UnwrapOptions::chart is looked at but its energy.
enum class Islands { Mapped, Kept };

struct UnwrapOptions {
  // The options of every chart: degree, energy and so on. Vertices of pins and handles are those of
  // the surface, cuts keep off them; the injectivity is always Global, `initial` is not looked at.
  // A chart minimizes
  //     mean density + handle_weight * (sum of squared distances of its handles) / its area
  // so that all charts together, weighted by area, minimize the same of the whole surface: a weight
  // means the same in every chart.
  ParametrizationOptions chart = {};
  CutOptions cuts = {};
  StretchLimit limit = StretchLimit::Kept;
  // Where the limit is kept of Automatic or Sharp cuts, charts are divided until there are so many
  // of them; with 0 where the layout costs less then (docs/atlas.md, "One chart or many"). Fewer
  // where that is not possible (Atlas::division).
  Index least_charts = 0;
  // Charts with more area of the surface are divided as well, those that can be, whatever the
  // layout costs then. Model units.
  double max_chart_area = std::numeric_limits<double>::infinity();
  // Then charts are divided until they fill so much of the packing's square, whatever that costs,
  // or less where that is not possible; 0: for no fill. None: until they fill kUsualFill of it,
  // where that takes little seam (kLittleSeam, kMoreSeam); not with least_charts and a given side.
  // Not looked at with Stacking, face_scale and several tiles.
  std::optional<double> least_fill = {};
  // Seconds from the start of the run after which cuts that suffice are not made shorter.
  double cutting_seconds = std::numeric_limits<double>::infinity();
  Islands islands = Islands::Mapped;
  // Of packed charts without pins and handles.
  Stacking stacking = Stacking::None;
  // #F or empty: charts are so many times as large as they are mapped, one number > 0 for all faces
  // of a chart. Measures are those of the larger ones.
  Vec face_scale = {};
  std::optional<PackOptions> packing =
      PackOptions();  // none: charts stay where the solver has them
};

// The one of two ends that is further from the best: converged, stalled, a limit of steps, of time,
// interrupted, infeasible, failed.
Status worse_of(Status a, Status b);

// Seconds that stages took.
struct AtlasSeconds {
  double cut = 0;    // the first cuts
  double recut = 0;  // which charts are cut again or divided, and how
  double map = 0;    // the maps of all charts, also of those that were cut again
  double pack = 0;
};

// The charts that have no map, since the run was stopped before.
struct UnmappedCharts {
  std::vector<Index> faces;           // of the surface, ascending
  Index count = 0;                    // of charts
  Status status = Status::Converged;  // TimeLimit or Interrupted where there are some
};

struct Atlas {
  SurfaceCuts cuts;           // of all charts
  std::vector<Chart> charts;  // those with a map, in the order of their first faces
  UnmappedCharts unmapped;
  std::optional<Packing> packing;  // of their maps, which are in place
  // TimeLimit or Interrupted where the run was stopped while they were packed: they lie as they
  // were arranged first.
  Status packed = Status::Converged;
  AtlasSeconds seconds = {};
  // Why the division of charts ended (least_charts, least_fill). Converged: there are so many, and
  // they fill so much, or none can be divided that gains anything. MaxIterations: no more layouts
  // are packed on the way to a fill.
  Status division = Status::Converged;

  // Returns whether every chart has a map.
  bool is_complete() const { return unmapped.count == 0; }
  // The worst of the charts, those without a map among them, and of packing: Converged only if all
  // are.
  Status status() const;
  // The message of the first chart that ended so, or of packing; empty where all converged.
  std::string message() const;
  // Mean of the energy over the surface.
  double value() const;
  Stretch stretch() const;
};

// surface: any number of components (repair.h). Throws Error(Usage) as parametrize() for options,
// Error as choose_cuts(), Error(Infeasible) for a chart whose pins cannot be met and for a pin
// or handle with a target whose vertex has several places, on a seam or where sheets were split;
// Stopped before there is a map of any chart.
Atlas unwrap(const std::shared_ptr<const SurfaceMesh>& surface, const UnwrapOptions& options,
             RunRecord& record);

// Returns whether a chart stretches more than options.cuts.max_stretch, limit or not. Charts of
// faces without an area alone do not: no cut would mend what they have.
bool exceeds_stretch(const UnwrapOptions& options, const Chart& chart);
// Why a chart stretches more than options.cuts.max_stretch, where that is a limit that is kept, in
// words; empty where it is not, or the chart does not.
std::string why_stretched(const UnwrapOptions& options, const Chart& chart);

// The maps of its charts, where they are now.
std::vector<BezierMap> maps_of(const Atlas& atlas);

// Moves the maps of all charts at one scale: the packing's square becomes the unit square, without
// a packing the common box of the charts, its larger side 1. Where rounding turns a triangle over,
// lets charts touch or come closer than the packing promises, the next power of two is the size
// instead, but not where the packing has tiles, whose borders are proven, too. None, and the atlas
// as it was, where that does not help. Measures stay those in model units.
std::optional<LayoutMotion> into_unit_square(Atlas& atlas);
// Returns the reason why into_unit_square() gives none, in words of one line without a full stop.
std::string problem_in_unit_square(const Atlas& atlas);

// The larger side of the box around all charts.
double layout_size(const Atlas& atlas);
// border_clearance() of the chart where it lies; none where that is at_most or more.
std::optional<double> clearance(const Chart& chart, double at_most);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
