// The initial map of large disks: solved on a mesh of few triangles, then refined vertex by vertex.
//
//   std::optional<Vec> uv = multiresolution_map(*mesh, options.map);
//   if (!uv) uv = tutte_map(*mesh);
//
// Vertices are collapsed onto neighbours until a few hundred triangles are left, and Tutte's map of
// those is optimized. Then the vertices are reinserted in reverse order, each at the place that is
// best for the triangles around it. At levels whose sizes grow by a constant ratio the whole map is
// improved: vertex by vertex, then by Newton steps where the map is compressed, then by Newton
// steps on the whole level.
//
// The caller optimizes on the surface itself. The initial map is usually within 1e-3 of the
// minimum, often within 1e-4, whatever the number of triangles, and costs about three to six
// factorizations on the surface. For small meshes a few steps from Tutte's map cost less.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "majorant/framework/run_record.h"
#include "majorant/framework/stop_check.h"
#include "majorant/maps/map_options.h"
#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// A map of a level that was solved without overlaps.
struct LevelSolution {
  Vec uv;
  double energy = 0;  // mean
};
// Optimizes a level. level: u, v per vertex in options.initial, which has no overlaps. Ends below
// the relative decrease, or when the record does. Returns none if the solve fails.
using LevelSolver = std::function<std::optional<LevelSolution>(
    const std::shared_ptr<const SurfaceMesh>& level, const MapOptions& options, double decrease,
    RunRecord& record)>;

// Returns whether a start is promising; is called with the coarsest level and its map, u, v per
// vertex.
using CoarseTest = std::function<bool(const SurfaceMesh& level, const Vec& uv)>;

// Returns whether multiresolution_map() supports the energy and the boundary. Energies need a
// barrier and must not distinguish single faces (knows_elements()), since coarse surfaces have
// other faces. Sector sums at boundary vertices may not be constrained.
bool suits_multiresolution(const SurfaceMesh& mesh, const MapOptions& options);

// Parameters of multiresolution_map(), for measurements. Figures in comments are from
// bench/multiresolution; fe is the time of one factorization on the surface.
struct MultiresolutionRules {
  // Triangles of the coarsest mesh: 1000 cost 5 fe more at 10,000 faces and give no better start.
  Index coarsest = 400;
  // The ratio of the numbers of vertices of two levels: 2 halves the error of the start at 10,000
  // faces and costs 2.8 fe more.
  double ratio = 4;
  // Newton steps of a vertex when it is reinserted: at 10,000 faces 8 give no better start, and one
  // step gives a hardly worse one.
  int insertion_steps = 4;
  // The neighbours of a vertex are moved if the mean energy of its triangles exceeds this multiple
  // of that of the last level. Without it the error of the start grows by factors of up to 30.
  double high_energy = 2;
  // Upper bound on the rounds of such moves; 12 gain nothing.
  int high_energy_rounds = 6;
  // Newton steps of all vertices, one after the other, when a level is complete: 6 cost 0.35 fe
  // more at 10,000 faces and lower the error by a quarter.
  int sweeps = 4;
  // Compressed parts of a level are relaxed before the whole if the neighbours of at least this
  // fraction of the reinserted vertices were moved. The fraction is 3 % on disks, where relaxing
  // gains nothing, and 9 to 12 % on limbs.
  double compressed_share = 0.05;
  // A vertex is compressed if the mean energy around it exceeds this multiple of the mean over all
  // vertices. A surface with limbs of 10,000 faces takes 16.3 fe with 1.5, 16.9 with 1.3, 18.4 with
  // 2, 26.9 without relaxation.
  double compressed = 1.5;
  // Rings of neighbours that move with the compressed vertices: 2 take 0.7 fe more at 10,000 faces.
  int compressed_rings = 1;
  // Newton steps of the compressed parts: 15 leave twice the error.
  int compressed_steps = 30;
  // The relative decrease of the energy of these parts that ends their relaxation, as `decrease`.
  double compressed_decrease = 1e-4;
  // Newton steps of the whole level per factorization: 6 cost 0.3 fe more at 10,000 faces.
  int factor_steps = 10;
  // Upper bound on these steps on a level; surfaces with long limbs take as many on coarse levels.
  int most_steps = 30;
  // A level is coarse if it has at most this fraction of all triangles. Chosen, not tuned.
  double coarse_part = 1.0 / 8;
  // The relative decrease of a step that ends the coarsest and coarse levels; 1e-7 gains nothing.
  double coarse_decrease = 1e-5;
  // The relative decrease that ends the other levels; the remaining error is below that of the next
  // level's insertion.
  double decrease = 1e-4;
  // The start is given up if the energy drops by more than this from one level to the next that is
  // not coarse, since coarse levels then say nothing about fine ones. Infinite: never.
  double largest_drop = std::numeric_limits<double>::infinity();
};

// The costs of a level, for measurements.
struct LevelRecord {
  Index faces = 0;
  Index high_energy = 0;     // vertices whose neighbours were moved
  Index compressed = 0;      // vertices that were relaxed together before the others
  int compressed_steps = 0;  // Newton steps of these
  int steps = 0;             // of all vertices together
  double energy = 0;         // mean, at the end of the level
  // CPU time of the process.
  double insert_seconds = 0, sweep_seconds = 0, compressed_seconds = 0, solve_seconds = 0;
};
struct MultiresolutionRecord {
  double decimation_seconds = 0;
  std::vector<LevelRecord> levels;  // the coarsest first
};

// Returns u, v per vertex, model units; every face is positive with a margin, and the boundary is
// Tutte's if options.boundary is fixed. The result does not depend on the number of threads. None
// if the surface is too small or unsuited, or doubles are too coarse. Needs a disk, possibly with
// holes. Throws Error as tutte_map(); Stopped, by run.start_stop(). Records the Newton steps of
// whole levels in `run`, those of the coarsest mesh as the highest level; the limit of iterations
// of `run` does not apply to them.
//
// solve_level: for MapInjectivity::Global. Boundary vertices are then reinserted inside the image
// and move only in its solves, so that overlaps arise only by rounding; the caller tests for these.
// Throws InvalidArgument if it is missing.
//
// goes_on: for MapInjectivity::Local; empty: always true. None if it returns false.
std::optional<Vec> multiresolution_map(const SurfaceMesh& mesh, const MapOptions& options,
                                       RunRecord& run, const MultiresolutionRules& rules = {},
                                       MultiresolutionRecord* record = nullptr,
                                       const LevelSolver& solve_level = {},
                                       const CoarseTest& goes_on = {});
// Computes the same without recording steps.
std::optional<Vec> multiresolution_map(const SurfaceMesh& mesh, const MapOptions& options,
                                       const StopCheck& stop = {},
                                       const MultiresolutionRules& rules = {},
                                       MultiresolutionRecord* record = nullptr);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
