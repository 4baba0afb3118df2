// Low-distortion, certified locally injective, piecewise degree-n maps of a disk, or of a surface
// cut open along seams.
//
//   auto mesh = std::make_shared<const SurfaceMesh>(SurfaceMesh::from_polygons(read_mesh(path)));
//   ParametrizationOptions options;
//   options.map.degree = 3;
//   ParametrizationResult result = parametrize(mesh, options);
//   Vector2 uv = result.map->evaluate(12, {0.2, 0.3, 0.5});
//
// Newton's method minimizes the energy from Tutte's map (or the caller's), the line search keeps
// det J > 0, and the degree is raised step by step. See [MC20] and docs/method.md.
//
// Closed surfaces must be cut open first: unwrap() (unwrap.h), make_seamless() (start.h).
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
// added for the final degree.
struct AddedTerm {
  std::string name;
  double weight;
  double energy;  // unweighted, in the units of MapExtension
};
struct AddedCheck {
  std::string name;
  Verdict verdict;  // on the result in normalized coordinates
};

struct ParametrizationResult {
  Status status = Status::Failed;
  std::string message;                     // why the run ended; for invalid results, what failed
  std::optional<BezierMap> map;            // absent only when status is Infeasible or Failed
  StartMethod start = StartMethod::Given;  // the actual one, never Automatic
  double initial_value = 0;                // mean density of the start
  double value_quadrature = 0;  // the optimizer's own energy at the end, added terms included
  // -g . p of the last step, relative to the map's energy; with a scaffold, of map and scaffold
  // together.
  double newton_decrement = 0;
  double constraint_residual = 0;  // model units
  double start_moved = 0;  // largest distance by which aligning edges moved the start, model units
  std::vector<Pin> handles;    // with their targets
  double handle_distance = 0;  // largest distance of a soft handle from its target, model units
  std::int64_t variables = 0;  // unknowns at the last degree
  MapMeasures measures;
  std::vector<AddedTerm> terms;
  std::vector<AddedCheck> checks;
  std::vector<long> injectivity_tests;  // elements certified, by bisection depth
  FlipCounts flips;                     // of the scaffold's edges, and of Triangles::Flipped
  bool other_triangles = false;         // the map's faces are not those of the input
  RemedyUses remedies{};                // remedies for stalls, at the last degree
  std::optional<BezierMesh> scaffold;   // around the map, model units; of MapInjectivity::Global
  std::optional<GlobalInjectivity> boundary;  // of MapInjectivity::Global: proof of no overlaps
  double initialize_seconds = 0, optimize_seconds = 0, measure_seconds = 0;
  double scaffold_seconds = 0;  // included above: scaffold or barrier, problems, their analyses
  // The median time of one factorization and one solve at the requested degree
  // (SolveOptions::factor_cost).
  std::optional<double> factor_solve_seconds;
};

// Returns "auto", "tutte", "multiresolution" or "input".
std::string_view start_name(StartMethod method);

// Returns u, v of every vertex in the start, which is given or computed as StartMethod says. Maps
// with aligned edges or constrained sector sums start from Tutte's. taken: receives the method
// used, may be null. Throws Error(Unsupported) if the mesh is no disk, with or without holes,
// Error(Usage) if the given start has the wrong size; Stopped.
Vec initial_map(const SurfaceMesh& mesh, const MapOptions& options, const StopCheck& stop = {},
                StartMethod* taken = nullptr);
// Does the same within the limits of a run (RunRecord::start_stop()), and records the steps on
// coarser levels.
Vec initial_map(const SurfaceMesh& mesh, const MapOptions& options, RunRecord& record,
                StartMethod* taken = nullptr);

// Computes a map of a disk. Throws Error as initial_map(). Throws Error(Infeasible) if the start is
// not locally injective, does not meet the pins or has an aligned edge off its axis by more than
// kSeamTolerance (seams.h). Throws Error(Unsupported) if a vertex is pinned twice, or pinned and a
// handle. Throws Error(Usage) for options out of range, or if the energy does not support the
// curvature or would shrink the map to a point (FreeScale::Collapses with neither a fixed boundary
// nor points that hold the scale). Throws Stopped before there is a start; later a stop ends the
// run with the best map so far.
//
// With additions (options.extend): throws Error(Usage) if edges are to be flipped too, or a term
// does not support the curvature. Throws Error(Infeasible) if the start is not injective once it
// satisfies added constraints, Error(Unsupported) if they contradict others. An automatic start is
// Tutte's. Status::Infeasible: the start violates an added checker, or no map was found inside a
// bound.
ParametrizationResult parametrize(std::shared_ptr<const SurfaceMesh> mesh,
                                  const ParametrizationOptions& options, RunRecord& record);
ParametrizationResult parametrize(std::shared_ptr<const SurfaceMesh> mesh,
                                  const ParametrizationOptions& options);
// Starts from a map of degree 1 instead, of a disk or of any cut surface whose seams then hold
// exactly (start.h). options.map.initial is ignored. The start must satisfy its seams up to
// rounding.
ParametrizationResult parametrize(const BezierMap& start, const ParametrizationOptions& options,
                                  RunRecord& record);

// deform() moves a planar mesh by point handles, starting from the identity map of the mesh.
//
//   BezierMap rest = planar_map(mesh);                 // the identity
//   ParametrizationOptions options;
//   options.map.handles = {{12, Vector2(0.5, 1)}};          // soft; pins are hard
//   options.map.injectivity = MapInjectivity::Global;
//   ParametrizationResult bent = deform(rest, options, record);
//
// Targets are approached in steps at degree 1, so that the mesh bends gradually. Pins are pulled by
// springs until they can be held exactly, as in parametrize(); soft handles are pulled as hard as
// pins meanwhile. Then the degree is raised.

// Returns the identity map of a mesh in a plane z = const, seen from the side from which its faces
// are counterclockwise: (x, y), or (-x, y) if they are clockwise. The mesh may have any number of
// boundary loops. Throws Error(Unsupported) naming a vertex off the plane, or an inverted face.
BezierMap planar_map(std::shared_ptr<const SurfaceMesh> mesh);

// Deforms a map. start: of degree 1, locally (for MapInjectivity::Global also globally) injective.
// options: as for parametrize(). Throws the errors of parametrize().
ParametrizationResult deform(const BezierMap& start, const ParametrizationOptions& options,
                             RunRecord& record);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
