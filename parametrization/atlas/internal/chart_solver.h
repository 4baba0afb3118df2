// The solver of one chart, a disk possibly with holes: tries initial maps in turn until one leads
// to a map without overlaps.
//
//   ChartSolver solver(mesh, options, {.texture = TextureStart::Tried});
//   RunRecord record;
//   Chart chart = solver.solve(record);    // chart.map is proven injective
//
// Attempts go on until the image is proven free of overlaps and every face survives rounding. They
// start from, in this order:
// * the file's texture coordinates, untangled if need be;
// * the faces side by side, if they unfold into the plane;
// * the map of the chart that this one was cut from;
// * Tutte's map, replaced by a multiresolution map for large charts, or by a projection if all
//  faces are seen from one side and the projection is nearer to the minimum;
// * the faces side by side, for any chart.
//
// Each start is tried first without a scaffold, which most charts do not need and which costs
// several times as much, then with one. The parent's map, with its slits opened, gets a scaffold at
// once; Tutte's map gets it last. The last resort is Tutte's map itself. Overlaps are detected
// after the solve: a map with a free boundary is injective if its boundary is simple.
#pragma once

#include <memory>
#include <optional>

#include "majorant/framework/run_record.h"
#include "majorant/parametrization/atlas/unwrap.h"

namespace majorant {

// The use of the file's texture coordinates as a start of a chart.
enum class TextureStart { Tried, Ignored };
// The treatment of charts that unfold into the plane but whose faces overlap there. Undone: a map
// without overlaps is computed. LeftToCuts: the chart is Failed, so that it is cut instead.
enum class UnfoldedOverlaps { Undone, LeftToCuts };

// The treatment of a chart whose start is very far from its minimum and gets no nearer. Waited: all
// iterations are used. LeftToCuts: the solve ends soon as Stalled, so that the chart is cut
// instead.
enum class SlowStart { Waited, LeftToCuts };

// The shape of a chart. Curved, or unknown: it starts from Tutte's map. Unfolds: from the faces
// side by side.
enum class ChartShape { Curved, Unfolds };

// The role of the map that a chart was cut from. Slit: its cuts are to be opened as slits in that
// map. Whole: the chart is a part of it, and that map was good.
enum class ParentMap { Slit, Whole };

struct ChartHints {
  TextureStart texture = TextureStart::Ignored;
  ChartShape shape = ChartShape::Curved;
  UnfoldedOverlaps overlaps = UnfoldedOverlaps::Undone;
  SlowStart slow = SlowStart::Waited;
  // u, v per vertex: the map of the chart that this one was cut from, or empty. It may overlap.
  Vec parent = {};
  ParentMap parent_map = ParentMap::Slit;
  // Model units: the smallest distance of non-neighbouring parts of the border in a map that is
  // accepted without a scaffold.
  double clearance = 0;
};

class SlowStartLimit;

class ChartSolver {
 public:
  // mesh: planar (SurfaceMesh::require_planar). options: refer to vertices of the mesh and outlive
  // this object.
  ChartSolver(std::shared_ptr<const SurfaceMesh> mesh, const ParametrizationOptions& options,
              ChartHints hints);

  // Returns the chart without its `faces`. It has no map if the start_stop() of the record ends the
  // solve before there is one. Throws Error(Infeasible) if pins cannot be met, Error(Usage) for
  // options.
  Chart solve(RunRecord& record);

 private:
  void try_texture(RunRecord& record);
  void try_parent(RunRecord& record);
  void try_tutte(RunRecord& record);
  bool try_many_resolutions(MapInjectivity injectivity, RunRecord& record);
  bool try_unfolded(RunRecord& record);
  bool overlaps_unfolded() const;
  bool attempt(const Vec& start, MapInjectivity injectivity, RunRecord& record);
  void keep_start(const RunRecord& record);
  Chart solve_within_limits(RunRecord& record);
  void name_start(ChartStart start);
  void to_area_of_surface();
  const Vec& tutte(const RunRecord& record);
  std::optional<Vec> projection(const RunRecord& record);

  std::shared_ptr<const SurfaceMesh> mesh_;
  const ParametrizationOptions& options_;
  const ChartHints hints_;
  std::optional<Vec> tutte_;
  Chart chart_;
  SlowStartLimit* limit_ = nullptr;  // of solve(); null: no limit
  bool is_done_ = false;
  bool is_overlapping_ = false;  // the last attempt ended at a minimum that overlaps itself
};

struct PreparedTexture {
  Vec uv;  // u, v per vertex; every triangle positively oriented, area that of the surface
  ChartStart start;  // Texture or Untangled
};

// Returns the texture coordinates of a chart as a start. mesh: not cut by its texture coordinates.
// Mirrored islands are reflected, islands with inverted triangles untangled. None if the mesh has
// no coordinates, they have no area, or untangling fails.
std::optional<PreparedTexture> texture_start(const std::shared_ptr<const SurfaceMesh>& mesh,
                                             const RunRecord& record);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
