// All that is asked of a map: *what* it shall be (MapOptions: degree, energy, boundary, points that
// are held), *how* it is looked for (SolveOptions: models, rules, limits of accuracy), and what
// else takes part (ParametrizationOptions::extend). In model units, vertices and half-edges of the
// mesh that is mapped (of the start's, where a start is given).
//
//   ParametrizationOptions options;
//   options.map.degree = 2;
//   options.map.pins = {{0, {}}};                  // stays where the initial map has it
//   options.map.handles = {{12, Vector2(0.5, 1)}}; // pulled there
//   options.solve.tolerance = 1e-8;
//
// What and how are two types because starts, checks and reports know the first alone; the second
// changes the path to a minimum, which may lead to another local one, and no minimum.
//
// Not for putting a problem together by hand, or for other minimizers: solvers make of this the
// normalised problem, MapSpecification (map_problem.h). Limits of time and iterations are those of
// the run (run_record.h).
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

// ---- What ----

// Weights lie between 1 / kLargestFactor and kLargestFactor, targets no farther than that many
// model sizes away: the products of two weights and a squared distance, of two of which norms are
// made, stay finite in doubles.
inline constexpr double kLargestFactor = 1e30;
inline bool is_usable_weight(double weight) {
  return weight >= 1 / kLargestFactor && weight <= kLargestFactor;
}

enum class BoundaryCondition { Free, Fixed };        // Fixed: the start's boundary stays
enum class BoundaryAngles { Free, AtMostFullTurn };  // sector sums at boundary vertices

// Local: det J > 0 and angle sums; Global: no overlaps either, held by a scaffold, a mesh of the
// space around the image.
enum class MapInjectivity { Local, Global };

// The start of a map. Automatic: Multiresolution for large surfaces, unless points are pulled or
// held where the initial map has them. Multiresolution: multiresolution_map(), but Tutte where that
// does not know what is asked. Tutte: tutte_map(). Given: MapOptions::initial, or the start that a
// caller brings.
enum class StartMethod { Automatic, Tutte, Multiresolution, Given };

struct Pin {
  Index vertex;                        // of the mesh
  std::optional<Vector2> target = {};  // model units; none: where the initial map has the vertex
};

struct MapOptions {
  EnergySum energy{{symmetric_dirichlet(), 1.0}};  // minimized: its mean over the surface
  // #F positive factors of the whole energy, empty = all 1: where it matters. What is measured of a
  // map leaves them out, unlike those of single summands (WeightedEnergy::face_weight), which say
  // what the energy is.
  Vec face_weight = {};
  BoundaryCondition boundary = BoundaryCondition::Free;
  BoundaryAngles boundary_angles = BoundaryAngles::Free;
  // w of the soft handles: + w * sum |x - target|^2 / area; chosen, not tuned: handles are
  // asked for because they may give way.
  double handle_weight = 1e3;
  int degree = 3;  // 1..8
  MapInjectivity injectivity = MapInjectivity::Local;
  std::vector<Pin> pins = {};       // hard
  std::vector<Pin> handles = {};    // soft, with handle_weight
  std::vector<Index> aligned = {};  // half-edges that stay parallel to an axis
  std::optional<Vec> initial = {};  // u, v per vertex; none: made by `start`
  StartMethod start = StartMethod::Automatic;
};

// ---- Watching a map on its way ----
//
//   options.solve.watch = [](const TraceEntry& row, const MapView& at) {
//     if (row.record.iteration == 10) map = at.in_model_units();
//     return row.energy < 4.1 ? Directive::Interrupt : Directive::Continue;
//   };
//
// Called with the start, in a row of its own whose iteration is that of the row before it (0 at
// first), and after every row of the trace. Starts that are pulled to their pins are seen, too;
// what is answered then does not count. Who needs no map watches the RunRecord: a RunObserver is
// told its rows and activities, and those of runs without a map (run_record.h).

// The state of a run; valid during the call.
struct MapView {
  const std::shared_ptr<const BezierTriangleSpace>& space;  // of the row's degree
  VecIn x;  // control points as they are minimized: MapExtension::scale() * (u, v)
  std::function<BezierMap()> in_model_units;  // costs what it takes to copy the map
};

// Anything but Continue ends the run with that status and the best map so far.
using MapObserver = std::function<Directive(const TraceEntry& row, const MapView& at)>;

// ---- How ----

enum class Elevation { Incremental, Direct };

// Where a map that is to end free of overlaps has a scaffold around it. WhereMapsOverlap: from the
// first step on that would overlap; a run without such steps is that of a free map, and its result
// has no scaffold. FromTheStart: always; the result has one.
enum class ScaffoldUse { WhereMapsOverlap, FromTheStart };

// Omitted: for comparison only; the scaffold's shape suffers.
enum class ScaffoldFlips { Performed, Omitted };

// Flipped: edges inside flat parts of the surface are flipped at the end where that lowers the
// energy; the result's faces are not those of the input then.
enum class Triangles { Kept, Flipped };

// Measured: a run that ends without a factorization at its degree makes one, to know its cost
// (ParametrizationResult::factor_solve_seconds). Its time counts nowhere.
enum class FactorCost { IfKnown, Measured };

struct SolveOptions {
  CurvatureChoice curvature = {};
  // Relative energy decrease per iteration. As StoppingRules::relative_decrease.
  double tolerance = 1e-6;
  Elevation elevation = Elevation::Incremental;
  // The degree is raised below this decrease. Measured by bench/tune.py elevation_tolerance.
  double elevation_tolerance = 1e-4;
  int quadrature_points = 0;                   // lattice points per triangle; 0: our own rule
  int injectivity_depth = ProofDepth::kStart;  // of bisection; deeper when a run is held back
  ScaffoldUse scaffold = ScaffoldUse::WhereMapsOverlap;     // of MapInjectivity::Global
  ScaffoldFlips scaffold_flips = ScaffoldFlips::Performed;  // of MapInjectivity::Global
  Triangles triangles = Triangles::Kept;
  FactorCost factor_cost = FactorCost::IfKnown;
  MapObserver watch = {};  // may be empty
  // Makes what solves Newton's systems, once for every degree; empty: make_direct_solver(), which
  // is the fastest up to some millions of faces. The scaffold's relaxation keeps that.
  PatternSolverFactory linear_solver = {};
  int threads = 0;  // 0: as many as the caller has (parallel.h); results do not depend on it
};

// ---- What, how, and what else ----

class MapExtension;
// Adds terms, constraints, checkers and observers of one's own to each degree (map_extension.h).
using MapExtender = std::function<void(MapExtension&)>;

struct ParametrizationOptions {
  MapOptions map = {};
  SolveOptions solve = {};
  MapExtender extend = {};  // may be empty
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
