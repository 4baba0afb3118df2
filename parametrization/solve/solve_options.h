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

// Measured: a run that ends without a factorization at its degree makes one, to know its cost
// (ParametrizationResult::factor_solve_seconds). Its time counts nowhere.
enum class FactorCost { IfKnown, Measured };

struct SolveOptions {
  Curvature curvature = Curvature::Projected;
  // Relative energy decrease per iteration. As StoppingRules::relative_decrease.
  double tolerance = 1e-6;
  Elevation elevation = Elevation::Incremental;
  // The degree is raised below this decrease. Measured by bench/tune.py elevation_tolerance.
  double elevation_tolerance = 1e-4;
  int quadrature_points = 0;                   // lattice points per triangle; 0: our own rule
  int injectivity_depth = ProofDepth::kStart;  // of bisection; deeper when a run is held back
  ScaffoldFlips scaffold_flips = ScaffoldFlips::Performed;  // of MapInjectivity::Global
  Triangles triangles = Triangles::Kept;
  FactorCost factor_cost = FactorCost::IfKnown;
  MapObserver watch = {};  // may be empty
  // Makes what solves Newton's systems, once for every degree; empty: make_direct_solver(), which
  // is the fastest up to some millions of faces. The scaffold's relaxation keeps that.
  PatternSolverFactory linear_solver = {};
  int threads = 0;  // 0: as many as the caller has (parallel.h); results do not depend on it
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
