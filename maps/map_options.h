// The options of a map. MapOptions describe the result: degree, energy, boundary, held points.
// SolveOptions describe the computation: models, rules, limits of accuracy.
// ParametrizationOptions::extend adds to the problem. All are in model units and refer to vertices
// and half-edges of the mesh that is mapped (that of the start, if one is given).
//
//   ParametrizationOptions options;
//   options.map.degree = 2;
//   options.map.pins = {{0, {}}};                  // held where the initial map has it
//   options.map.handles = {{12, Vector2(0.5, 1)}}; // pulled to this target
//   options.solve.tolerance = 1e-8;
//
// The two are separate types, since starts, checks and reports depend only on MapOptions.
// SolveOptions change the path, which may lead to another local minimum; they do not change the
// minima.
//
// Solvers derive the normalized problem, MapSpecification (map_problem.h), from these options;
// problems built by hand and other minimizers use that. Limits of time and iterations belong to the
// run (run_record.h).
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "majorant/elements/element_space.h"
#include "majorant/energies/energy_factory.h"
#include "majorant/framework/curvature_choice.h"
#include "majorant/framework/linear_solver.h"
#include "majorant/framework/run_record.h"
#include "majorant/framework/types.h"
#include "majorant/maps/bezier_map.h"

namespace majorant {

// ---- The result ----

// Weights lie between 1 / kLargestFactor and kLargestFactor, and targets are at most that many
// model sizes away. Norms of two products of two weights and a squared distance then stay in the
// range of doubles.
inline constexpr double kLargestFactor = 1e30;
inline bool is_usable_weight(double weight) {
  return weight >= 1 / kLargestFactor && weight <= kLargestFactor;
}

enum class BoundaryCondition { Free, Fixed };        // Fixed: the start's boundary stays
enum class BoundaryAngles { Free, AtMostFullTurn };  // sector sums at boundary vertices

// The injectivity of a map. Local: det J > 0 and angle sums. Global: also no overlaps, ensured by a
// barrier at degree 1, else by a scaffold, a mesh of the space around the image.
enum class MapInjectivity { Local, Global };

// The start of a map.
// * Automatic: Multiresolution for large surfaces, unless points are pulled, or held where the
//  initial map has them.
// * Tutte: tutte_map().
// * Multiresolution: multiresolution_map(), or Tutte if that does not support the options.
// * Given: MapOptions::initial, or the start of the caller.
enum class StartMethod { Automatic, Tutte, Multiresolution, Given };

struct Pin {
  Index vertex;                        // of the mesh
  std::optional<Vector2> target = {};  // model units; none: where the initial map has the vertex
};

struct MapOptions {
  EnergySum energy{{symmetric_dirichlet(), 1.0}};  // minimized: its mean over the surface
  // #F positive factors of the whole energy, empty = all 1. Measures of a map ignore them, unlike
  // those of single summands (WeightedEnergy::face_weight), which are part of the energy.
  Vec face_weight = {};
  BoundaryCondition boundary = BoundaryCondition::Free;
  BoundaryAngles boundary_angles = BoundaryAngles::Free;
  // The weight w of soft handles: + w * sum |x - target|^2 / area. Chosen, not tuned: soft handles
  // are meant to yield.
  double handle_weight = 1e3;
  int degree = 3;  // 1..8
  MapInjectivity injectivity = MapInjectivity::Local;
  std::vector<Pin> pins = {};       // hard
  std::vector<Pin> handles = {};    // soft, with handle_weight
  std::vector<Index> aligned = {};  // half-edges that stay parallel to an axis
  std::optional<Vec> initial = {};  // u, v per vertex; none: computed by `start`
  StartMethod start = StartMethod::Automatic;
};

// ---- Observation of a run ----
//
//   options.solve.watch = [](const TraceEntry& row, const MapView& at) {
//     if (row.record.iteration == 10) map = at.in_model_units();
//     return row.energy < 4.1 ? Directive::Interrupt : Directive::Continue;
//   };
//
// The observer is called with the start, and after every row of the trace. The start has a row of
// its own, whose iteration is that of the row before it (0 at first). The observer is also called
// for starts that are pulled to their pins; its answers are ignored then. A RunObserver of the
// RunRecord (run_record.h) is enough if no map is needed; it also sees activities, and runs without
// a map.

// The state of a run; valid during the call.
struct MapView {
  const std::shared_ptr<const BezierTriangleSpace>& space;  // of the row's degree
  VecIn x;  // normalized control points: MapExtension::scale() * (u, v)
  std::function<BezierMap()> in_model_units;  // copies the map
};

// Called with each row; any result but Continue ends the run with that status and the best map so
// far.
using MapObserver = std::function<Directive(const TraceEntry& row, const MapView& at)>;

// ---- The solve ----

enum class Elevation { Incremental, Direct };

// The scaffold of bijective maps. WhereMapsOverlap: from the first step on that would overlap,
// where no barrier suits (degree 1); a run without such steps equals that of a free map, and its
// result has no scaffold. FromTheStart: always; the result has one.
enum class ScaffoldUse { WhereMapsOverlap, FromTheStart };

// Edge flips of the scaffold. Omitted: for comparison only, since the scaffold's shape suffers.
enum class ScaffoldFlips { Performed, Omitted };

// Edge flips of the surface. Flipped: edges inside flat parts are flipped at the end if that lowers
// the energy; the result then has other faces than the input.
enum class Triangles { Kept, Flipped };

// Normal: one path from one start. High: at degree 1 several paths, of which the lowest end counts;
// some ten times the time. Only of parametrize(); deform() has one path.
enum class Effort { Normal, High };

// Measured: a run that ends without a factorization at its degree computes one to measure its cost
// (ParametrizationResult::factor_solve_seconds). Its time is not counted.
enum class FactorCost { IfKnown, Measured };

struct SolveOptions {
  CurvatureChoice curvature = {};
  // Relative energy decrease per iteration that ends a run, as StoppingRules::relative_decrease.
  double tolerance = 1e-6;
  Elevation elevation = Elevation::Incremental;
  // The degree is raised below this decrease. Tuned by bench/tune.py elevation_tolerance.
  double elevation_tolerance = 1e-4;
  int quadrature_points = 0;                   // lattice points per triangle; 0: the default rule
  int injectivity_depth = ProofDepth::kStart;  // of bisection; deeper if a run stalls
  ScaffoldUse scaffold = ScaffoldUse::WhereMapsOverlap;     // of MapInjectivity::Global
  ScaffoldFlips scaffold_flips = ScaffoldFlips::Performed;  // of MapInjectivity::Global
  Triangles triangles = Triangles::Kept;
  Effort effort = Effort::Normal;
  FactorCost factor_cost = FactorCost::IfKnown;
  MapObserver watch = {};  // may be empty
  // Returns the solver of Newton's systems, once for every degree; empty: make_direct_solver(),
  // which is the fastest up to some millions of faces. The scaffold's relaxation always uses the
  // latter.
  PatternSolverFactory linear_solver = {};
  int threads = 0;  // 0: the caller's number (parallel.h); results do not depend on it
};

// ---- All options ----

class MapExtension;
// Adds custom terms, constraints, checkers and observers at each degree (map_extension.h).
using MapExtender = std::function<void(MapExtension&)>;

struct ParametrizationOptions {
  MapOptions map = {};
  SolveOptions solve = {};
  MapExtender extend = {};  // may be empty
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
