// The start of large disks: solved where the surface has few triangles, refined vertex by vertex.
//
//   std::optional<Vec> uv = multiresolution_map(*mesh, options.map);
//   if (!uv) uv = tutte_map(*mesh);
//
// Vertices are moved onto neighbours until a few hundred triangles are left; Tutte's map of those
// is optimized; then the vertices come back in reverse order, each at the place that is best for
// the triangles around it. At sizes that grow by a constant ratio the whole map is improved, vertex
// by vertex and by steps of Newton's method, first where the map is compressed, then on the whole
// mesh of that size. The last size, the surface itself, is left to the caller: what it gets is
// usually within 1e-3 of the minimum, often within 1e-4, whatever the number of triangles, and
// costs about what three to six factorizations on the surface do. Not for small meshes, where a few
// steps from Tutte's map cost less.
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

// The whole map of a level, solved so that it stays free of overlaps.
struct LevelSolution {
  Vec uv;
  double energy = 0;  // mean
};
// level: u, v per vertex in asked.initial, which has no overlaps. Ends below the relative decrease,
// or when the record does. None where nothing comes of it.
using LevelSolver = std::function<std::optional<LevelSolution>(
    const std::shared_ptr<const SurfaceMesh>& level, const MapOptions& asked, double decrease,
    RunRecord& record)>;

// Returns whether a start is worth going on with: asked with the coarsest level and its map, u, v
// per vertex.
using CoarseTest = std::function<bool(const SurfaceMesh& level, const Vec& uv)>;

// Returns whether the energy and the boundary that are asked for are ones that
// multiresolution_map() knows: energies with a barrier that do not know single faces
// (knows_elements()), since coarse surfaces have others; sector sums at boundary vertices may not
// be held.
bool suits_multiresolution(const SurfaceMesh& mesh, const MapOptions& asked);

// How multiresolution_map() works. Nobody but measurements changes this.
struct MultiresolutionRules {
  // Triangles of the coarsest mesh: 1000 cost 5 fe more at 10,000 faces and start no closer
  // (bench/multiresolution, as the figures below).
  Index coarsest = 400;
  // The ratio of the numbers of vertices of two levels: 2 halves the error of the start at 10,000
  // faces and costs 2.8 fe more.
  double ratio = 4;
  // Newton steps of a vertex when it comes back: 8 start no closer, one step hardly worse, at
  // 10,000 faces.
  int insertion_steps = 4;
  // The ratio of the mean energy of a vertex' triangles to that of the last level above which its
  // neighbours give way: without, maps start up to 30 times as far off.
  double high_energy = 2;
  // Times that they do: 12 gain nothing.
  int high_energy_rounds = 6;
  // Newton steps of all vertices, one after the other, when a level is complete: 6 cost 0.35 fe
  // more at 10,000 faces and take a quarter off the error.
  int sweeps = 4;
  // The share of the vertices that came back whose neighbours have to have given way for the
  // compressed parts of a level to be relaxed before the whole: 3 % do on disks where that gains
  // nothing, 9 to 12 % on limbs.
  double compressed_share = 0.05;
  // The ratio of the mean energy around a vertex to the mean of that over all vertices above which
  // the vertex is compressed: a surface with limbs, of 10,000 faces, takes 16.3 fe with 1.5, 16.9
  // with 1.3, 18.4 with 2, 26.9 without.
  double compressed = 1.5;
  // Rings of neighbours that move with the compressed vertices: 2 take 0.7 fe more at 10,000
  // faces.
  int compressed_rings = 1;
  // Newton steps of the compressed parts: 15 leave twice the error.
  int compressed_steps = 30;
  // The relative decrease of the energy of these parts that ends them: as `decrease`.
  double compressed_decrease = 1e-4;
  // Steps of all vertices together for a factorization: 6 cost 0.3 fe more at 10,000
  // faces.
  int factor_steps = 10;
  // The most of these on a level: surfaces with long limbs take as many on coarse
  // levels.
  int most_steps = 30;
  // The share of all triangles that a coarse level has at most; chosen, not tuned.
  double coarse_part = 1.0 / 8;
  // The relative decrease of a step that ends the coarsest and coarse levels: 1e-7 gains
  // nothing.
  double coarse_decrease = 1e-5;
  // The same for the others: what is left there is less than what the next level adds.
  double decrease = 1e-4;
  // The drop of the energy from one level to the next that is not coarse above which the start is
  // given up, since what is coarse says nothing of what is fine. Infinite: never.
  double largest_drop = std::numeric_limits<double>::infinity();
};

// What a level cost: for measurements.
struct LevelRecord {
  Index faces = 0;
  Index high_energy = 0;     // vertices whose neighbours gave way
  Index compressed = 0;      // vertices that were relaxed together before the others
  int compressed_steps = 0;  // of these
  int steps = 0;             // of all vertices together
  double energy = 0;         // mean, after these
  // CPU time of the process.
  double insert_seconds = 0, sweep_seconds = 0, compressed_seconds = 0, solve_seconds = 0;
};
struct MultiresolutionRecord {
  double decimation_seconds = 0;
  std::vector<LevelRecord> levels;  // the coarsest first
};

// u, v per vertex, model units; every face positive with room (Tutte's boundary where
// asked.boundary is fixed). Deterministic, whatever the number of threads. None where the surface
// is too small or unsuited, or doubles have no room. Needs a disk, possibly with holes; throws
// Error as tutte_map(); Stopped, by run.start_stop(). Notes the steps of all vertices together in
// `run`, those of the coarsest mesh as the highest level; its limit of iterations is not for them.
// solve_level: for MapInjectivity::Global. Boundary vertices come back inside of the image then and
// move in its solves alone, so that there are no overlaps but by rounding, for which the caller
// looks. Throws InvalidArgument where it is missing.
// goes_on: for MapInjectivity::Local; empty: yes. None where it says no.
std::optional<Vec> multiresolution_map(const SurfaceMesh& mesh, const MapOptions& asked,
                                       RunRecord& run, const MultiresolutionRules& rules = {},
                                       MultiresolutionRecord* record = nullptr,
                                       const LevelSolver& solve_level = {},
                                       const CoarseTest& goes_on = {});
// The same, unseen.
std::optional<Vec> multiresolution_map(const SurfaceMesh& mesh, const MapOptions& asked,
                                       const StopCheck& stop = {},
                                       const MultiresolutionRules& rules = {},
                                       MultiresolutionRecord* record = nullptr);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
