// *How* a map is looked for: models, rules, limits of accuracy. The minimum is the same for all of
// them but for the path to it, which may lead to another local one.
#pragma once

#include <functional>
#include <memory>

#include "majorant/elements/element_space.h"
#include "majorant/framework/curvature.h"
#include "majorant/framework/linear_solver.h"
#include "majorant/parametrization/maps/map_observer.h"

namespace majorant {

enum class Elevation { Incremental, Direct };

// Omitted: for comparison only; the scaffold's shape suffers.
enum class ScaffoldFlips { Performed, Omitted };

// Flipped: edges inside flat parts of the surface are flipped at the end where that lowers the
// energy; the result's faces are not those of the input then.
enum class Triangles { Kept, Flipped };

// Whether a run that ends without a factorization at its degree makes one, to know what it costs
// (ParametrizationResult::factor_solve_seconds). Its time counts nowhere.
enum class FactorCost { IfKnown, Measured };

// What the direct solver will need where a run ends, for the map alone, all of it free.
struct LastDegree {
  int degree;
  FactorSize at_most;                    // of surfaces of few handles, by the number of faces
  std::function<FactorSize()> analysed;  // costs one more analysis of that degree
};

struct SolveOptions {
  Curvature curvature = Curvature::Projected;
  // Relative energy decrease per iteration. Origin: as StoppingRules::relative_decrease.
  double tolerance = 1e-6;
  Elevation elevation = Elevation::Incremental;
  // The degree is raised below this decrease. Origin: bench/tune.py elevation_tolerance.
  double elevation_tolerance = 1e-4;
  int quadrature_points = 0;                   // lattice points per triangle; 0: our own rule
  int injectivity_depth = ProofDepth::kStart;  // of bisection; deeper when a run is held back
  ScaffoldFlips scaffold_flips = ScaffoldFlips::Performed;  // of MapInjectivity::Global
  Triangles triangles = Triangles::Kept;
  FactorCost factor_cost = FactorCost::IfKnown;
  MapObserver watch = {};  // may be empty
  // Of Newton's systems; empty: the library's own direct one, which is the fastest up to some
  // millions of faces. The scaffold's relaxation keeps that.
  SolverFactory linear_solver = {};
  // Where that is empty: asked after every analysis, before the direct solver allocates a factor.
  // What it returns, if anything, solves instead. May be empty.
  std::function<std::unique_ptr<LinearSolver>(const FactorSize& needed)> instead_of_factor = {};
  // Likewise, called before the first step of a run that goes through lower degrees. May be empty.
  std::function<void(const LastDegree&)> foresee = {};
  int threads = 0;  // 0: as many as the caller has (thread_count.h); results do not depend on it
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
