// The charts of an unwrap in progress, as a value: every step takes one and returns one.
//
//   const UnwrapOptions limits{.least_charts = 3};
//   UnwrapRun run(*mesh, limits, record);
//   ChartSet set = charts_along(choose_cuts(*mesh, {}), run);   // pieces without maps
//   set = solve(std::move(set), run);                           // chart_maps.h
//   set = limit_stretch(std::move(set), run);                   // stretch_limit.h
//   set = divide(std::move(set), run);                          // division.h
//   set = place(std::move(set), run);                           // placement.h
//   set = fill(std::move(set), run);                            // fill.h
//
// Sets are moved, since each holds a map of the whole surface. A function that may throw Stopped
// takes the set by reference and leaves it unchanged, or its caller keeps a copy.
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "majorant/parametrization/atlas/internal/chart_solver.h"
#include "majorant/parametrization/atlas/unwrap.h"

namespace majorant {

using HalfEdgeFlags = std::vector<char>;  // 3 #F of a mesh

// A cut that divides a chart in two, and its cost and gain. Lengths are in model units.
struct Division {
  HalfEdgeFlags cut = {};  // of the chart's mesh; empty where the chart has no division
  double cost = 0;         // cost_of_cuts() of the cut
  double saved_area = 0;   // box of the chart minus the boxes of its parts
  double longest = 0;      // longest side of the parts' boxes
  double price = 0;        // cost per area of the smaller part
};

// A piece of the cut surface and its chart.
struct ChartPiece {
  std::shared_ptr<const SurfaceMesh> mesh;
  std::vector<Index> faces;  // of the surface, by face of the mesh
  ParametrizationOptions options;
  CutPreferences preferences = {};  // on the mesh
  Vec parent = {};                  // u, v per vertex: the map it was cut from, or empty
  ParentMap parent_map = ParentMap::Slit;
  int cut_count = 0;                      // cuts since the piece was created or became a part
  double area_share = 1;                  // fraction of the area of its parent chart
  std::optional<Division> division = {};  // cached
  Chart chart = {};                       // without a map until it is solved
};

struct ChartSet {
  std::vector<ChartPiece> pieces;  // in the order of their first faces, but within limit_stretch()
  SurfaceCuts cuts = {};           // of all pieces
  UnmappedCharts unmapped = {};
  std::optional<Packing> packing = {};  // once placed, of all pieces
  Status packed = Status::Converged;    // Atlas::packed
  Status division = Status::Converged;  // Atlas::division

  bool is_complete() const { return unmapped.count == 0; }
  Status status() const;  // Atlas::status()
};

// The input and the counters of an unwrap. The input outlives the run.
struct UnwrapRun {
  UnwrapRun(const SurfaceMesh& mesh, const UnwrapOptions& unwrap_options, RunRecord& run_record);

  const SurfaceMesh& surface;
  const UnwrapOptions& options;
  RunRecord& record;
  const double clearance;  // ChartHints::clearance of all charts
  AtlasSeconds seconds = {};
  int pass = 1;  // through cutting and solving

  // Returns whether there may be another pass.
  bool may_continue() const;
  // Returns why there may be no other pass.
  Status end() const;
  // Counts a pass and notifies the observer.
  void begin_pass();
};

// Returns the pieces of the cut surface, without maps. Throws Error(Infeasible) if a pin or handle
// with a target has several places; Stopped.
ChartSet charts_along(SurfaceCuts cuts, const UnwrapRun& run);
// Returns a piece without pins and handles. faces: of the surface.
ChartPiece piece_of(std::shared_ptr<const SurfaceMesh> mesh, std::vector<Index> faces,
                    const UnwrapRun& run);

// Returns the numbers of all charts.
std::vector<std::size_t> all_charts(const ChartSet& set);
double face_count(const ChartSet& set, const std::vector<std::size_t>& which);

// Returns the set in the order of the charts' first faces.
ChartSet in_order(ChartSet set);
// Moves the charts without a map of a stopped run to `unmapped`; in a run that goes on, returns the
// set unchanged. Throws Stopped if no chart has a map.
ChartSet without_unmapped(ChartSet set, const UnwrapRun& run);
bool lacks_maps(const ChartSet& set);

// Returns whether charts may be cut to reduce their stretch or to fill the square.
bool may_cut(const UnwrapOptions& options);
// Returns whether the chart exceeds a stretch limit that is kept.
bool is_stretched(const UnwrapOptions& options, const Chart& chart);
// Returns whether the chart has pins or handles.
bool is_held(const ChartPiece& piece);
// Returns whether the chart has enough faces to be divided and is not held.
bool has_room_to_divide(const ChartPiece& piece);
// Returns whether overlaps of the chart's unfolded panels are removed by cutting instead of
// mapping.
bool is_cut_where_it_overlaps(const ChartPiece& piece, const UnwrapOptions& options);
// Returns whether every chart has its own place on one square, at the same scale.
bool has_one_scale(const UnwrapOptions& options);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
