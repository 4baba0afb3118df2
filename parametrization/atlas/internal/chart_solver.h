// One chart: a disk, possibly with holes, mapped without overlaps whatever it takes.
//
//   ChartSolver solver(mesh, options, {.texture = TextureStart::Tried});
//   RunRecord record;
//   Chart chart = solver.solve(record);    // chart.map is proven injective
//
// The attempts at a chart, until the image is proven to be free of overlaps and its faces are
// larger than rounding, start from: the file's texture coordinates (untangled if need be), the
// faces side by side where they unfold, the map of what it was cut from, Tutte's map - of large
// charts one in many resolutions, of those that a direction sees from one side alone the projection
// along it, where that is nearer to its minimum - and the faces side by side of any chart. Each is
// first without a scaffold, which most charts do not need and which costs several times as much,
// then with one: that of what it was cut from at once, with the cuts opened, Tutte's last. At the
// end Tutte's map as it is. Overlaps are looked for after the solve: of a free boundary only the
// boundary tells.
//
// The file's texture coordinates of a chart as a start of its map, as good as they can be made.
#pragma once

#include <memory>
#include <optional>

#include "majorant/framework/run_record.h"
#include "majorant/parametrization/atlas/unwrap.h"

namespace majorant {

enum class TextureStart { Tried, Ignored };
// Of charts that lie in the plane unfolded, face by face: Undone, a map without overlaps is found;
// LeftToCuts, such a chart is Failed where its faces overlap, so that it is cut instead.
enum class UnfoldedOverlaps { Undone, LeftToCuts };

// The end of a chart whose start is enormously far from its minimum and does not get nearer.
// Waited: after all the iterations that there are. LeftToCuts: soon, as Stalled, so that it is cut
// instead.
enum class SlowStart { Waited, LeftToCuts };

// Curved, or of unknown shape: Tutte's map is the start; Unfolds: the faces side by side.
enum class ChartShape { Curved, Unfolds };

// The map of what a chart was cut from. Slit: open slits are to become of cuts in it. Whole: the
// chart is a part of it, and that map was good.
enum class ParentMap { Slit, Whole };

struct ChartHints {
  TextureStart texture = TextureStart::Ignored;
  ChartShape shape = ChartShape::Curved;
  UnfoldedOverlaps overlaps = UnfoldedOverlaps::Undone;
  SlowStart slow = SlowStart::Waited;
  // u, v per vertex: the map of the chart that this one was cut from, or no numbers. May overlap.
  Vec parent = {};
  ParentMap parent_map = ParentMap::Slit;
  // Model units: parts of the border that are no neighbours are so far apart in a map that is found
  // without a scaffold.
  double clearance = 0;
};

class SlowStartLimit;

class ChartSolver {
 public:
  // mesh: planar (SurfaceMesh::require_planar). options: vertices are those of the mesh; outlive
  // this.
  ChartSolver(std::shared_ptr<const SurfaceMesh> mesh, const ParametrizationOptions& options,
              ChartHints hints);

  // All but `faces`; without a map where the start_stop() of the record ends it before there is
  // one. Throws Error(Infeasible) where pins cannot be met, Error(Usage) for options.
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
  SlowStartLimit* limit_ = nullptr;  // of solve(); none: no limit
  bool is_done_ = false;
  bool is_overlapping_ = false;  // the last attempt ended at a minimum that overlaps itself
};

struct PreparedTexture {
  Vec uv;  // u, v per vertex; every triangle positively oriented, area that of the surface
  ChartStart start;  // Texture or Untangled
};

// mesh: a chart that its texture coordinates do not cut. Mirrored islands are mirrored back, those
// with triangles turned over are untangled. None where the mesh has no coordinates, they have no
// area, or untangling fails.
std::optional<PreparedTexture> texture_start(const std::shared_ptr<const SurfaceMesh>& mesh,
                                             const RunRecord& record);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
