// The main job: a low-distortion, certified locally injective, piecewise degree-n map of a disk, or
// of a surface cut open along seams.
//
//   auto mesh = std::make_shared<const SurfaceMesh>(SurfaceMesh::from_polygons(read_mesh(path)));
//   ParametrizationOptions options;
//   options.map.degree = 3;
//   ParametrizationResult result = parametrize(mesh, options);
//   Vector2 uv = result.map->evaluate(12, {0.2, 0.3, 0.5});
//
// Tutte start (or the caller's), Newton on the energy with det J > 0 held by the line search, the
// degree raised step by step. [MC20], method.md.
//
// Not for closed surfaces, which are cut open first: unwrap() (unwrap.h), make_seamless()
// (start.h).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "majorant/certify/global_injectivity.h"
#include "majorant/framework/run_record.h"
#include "majorant/maps/bezier_map.h"
#include "majorant/maps/map_extension.h"
#include "majorant/maps/map_options.h"
#include "majorant/maps/map_problem.h"
#include "majorant/maps/measure.h"

namespace majorant {

// The outcome of terms and checkers that a MapExtension added, in the order in which they were
// added for the last degree.
struct AddedTerm {
  std::string name;
  double weight;
  double energy;  // unweighted, in the units of MapExtension
};
struct AddedCheck {
  std::string name;
  Verdict verdict;  // on the result, before it is put back into model units
};

struct ParametrizationResult {
  Status status = Status::Failed;
  std::string message;           // why the run ended; what failed where the result is not valid
  std::optional<BezierMap> map;  // absent only when status is Infeasible or Failed
  StartMethod start = StartMethod::Given;  // what was taken, never Automatic
  double initial_value = 0;                // mean density of the start
  double value_quadrature = 0;  // the optimizer's own energy at the end, added terms included
  // -g . p of the last step, with a scaffold that of map and scaffold together, relative to the
  // map's energy.
  double newton_decrement = 0;
  double constraint_residual = 0;  // model units
  double start_moved = 0;          // by aligning edges, largest distance, model units
  std::vector<Pin> handles;        // with their targets
  double handle_distance = 0;      // largest distance of a soft handle from its target, model units
  std::int64_t variables = 0;      // of the last degree
  MapMeasures measures;
  std::vector<AddedTerm> terms;
  std::vector<AddedCheck> checks;
  std::vector<long> injectivity_tests;  // elements certified, by bisection depth
  FlipCounts flips;                     // of the scaffold's edges, and of Triangles::Flipped
  bool other_triangles = false;         // the map's faces are not those of the input
  RemedyUses remedies{};                // against stalls, at the last degree
  std::optional<BezierMesh> scaffold;   // around the map, model units; of MapInjectivity::Global
  std::optional<GlobalInjectivity> boundary;  // likewise: the proof that `map` does not overlap
  double initialize_seconds = 0, optimize_seconds = 0, measure_seconds = 0;
  double scaffold_seconds = 0;  // of these: the scaffold, its problems, their analyses
  // The time of one factorization and one solve at the degree asked for, the median
  // (SolveOptions::factor_cost).
  std::optional<double> factor_solve_seconds;
};

std::string_view start_name(StartMethod method);  // "auto", "tutte", "multiresolution", "input"

// The start that is asked for, u, v per vertex: the given one or one that is made (StartMethod;
// aligned edges and sector sums that are held start from Tutte's). taken (may be null) receives
// which it is. Throws Error(Unsupported) when the mesh is no disk, with or without holes,
// Error(Usage) when the given one has the wrong size; Stopped.
Vec initial_map(const SurfaceMesh& mesh, const MapOptions& asked, const StopCheck& stop = {},
                StartMethod* taken = nullptr);
// Does the same within the limits of a run (RunRecord::start_stop()), which records the steps on
// coarser levels.
Vec initial_map(const SurfaceMesh& mesh, const MapOptions& asked, RunRecord& record,
                StartMethod* taken = nullptr);

// Throws Error as initial_map; Error(Infeasible) when the start is not locally injective, does not
// meet the pins or has an aligned edge off its axis by more than kSeamTolerance (seams.h);
// Error(Unsupported) when a vertex is pinned twice or pinned and a handle; Error(Usage) when the
// energy does not support the curvature or would shrink the map to a point (FreeScale::Collapses
// with neither a fixed boundary nor points that hold the scale), or options are out of range;
// Stopped before there is a start. Where something is added (options.extend): Error(Usage) when
// edges are to be flipped, too, or a term does not support the curvature; Error(Infeasible) when
// the start is not injective where it satisfies added constraints, Error(Unsupported) when they
// contradict others; an automatic start is Tutte's. Status::Infeasible: the start violates a
// checker that was added, or no map was found inside a bound. From then on a stop ends the run with
// the best map so far.
ParametrizationResult parametrize(std::shared_ptr<const SurfaceMesh> mesh,
                                  const ParametrizationOptions& options, RunRecord& record);
ParametrizationResult parametrize(std::shared_ptr<const SurfaceMesh> mesh,
                                  const ParametrizationOptions& options);
// Starts from a map of degree 1 instead, of a disk or of any cut surface whose seams then hold
// exactly (start.h); options.map.initial is ignored. The start must satisfy its seams to rounding.
ParametrizationResult parametrize(const BezierMap& start, const ParametrizationOptions& options,
                                  RunRecord& record);

// Deformation of a planar mesh by point handles: the map of the mesh onto itself, moved.
//
//   BezierMap rest = planar_map(mesh);                 // every point where it is
//   ParametrizationOptions options;
//   options.map.handles = {{12, Vector2(0.5, 1)}};          // soft; pins are hard
//   options.map.injectivity = MapInjectivity::Global;
//   ParametrizationResult bent = deform(rest, options, record);
//
// Targets are approached in steps at degree 1, so that the mesh bends on its way as it does at the
// end. Pins are pulled by springs until they can be held exactly, as parametrize() does without
// these steps; the degree is raised after that. Meanwhile soft handles are
// pulled as hard as pins.

// The identity of a mesh in a plane z = const, seen from the side from which its faces are
// counterclockwise: (x, y), or (-x, y) where they are clockwise. Any number of boundary loops.
// Throws Error(Unsupported) naming a vertex that is off the plane, or a face that is turned over.
BezierMap planar_map(std::shared_ptr<const SurfaceMesh> mesh);

// start: of degree 1, locally (for MapInjectivity::Global also globally) injective. options: as for
// parametrize(). Throws as parametrize().
ParametrizationResult deform(const BezierMap& start, const ParametrizationOptions& options,
                             RunRecord& record);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
