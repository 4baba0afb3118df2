// The rules by which parametrize() solves, as a value: stopping, remedies for stalls, and the care
// of a scaffold.
//
//   SolverRules rules;                     // those of parametrize()
//   rules.scaffold.share = 1e-4;           // [MC20]'s
//   parametrize_by(rules, map, options, record);   // parametrize_by.h
//
// Only measurements set them (bench/tune.cpp). bench/tune.py measures the effect of each.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "majorant/elements/element_space.h"
#include "majorant/framework/barrier_path.h"
#include "majorant/maps/map_options.h"
#include "majorant/maps/map_problem.h"
#include "majorant/maps/newton_of_maps.h"
#include "majorant/maps/quadrature_hierarchy.h"

namespace majorant {

// Rules of the remedies for stalls, in the order in which they are tried (degree_solver.cpp).
struct RemedyRules {
  // Depth of bisection if the requested depth stalls a run.
  int deepest_bisection = ProofDepth::kDeepest;
  // Levels that are added at a time. Two remedies lead from 5 to 13.
  int bisections_deeper = 4;
  // Weight of excluded triangles: docs/method.md, section 9.
  double excluded_weight = 1e-6;
  // Steps without the excluded triangles. Tuned by bench/tune.py remedies.excluded_iterations.
  int excluded_iterations = 10;
  // Relative decrease that ends these steps early, a thousand times the final one: they only leave
  // a corner.
  double excluded_tolerance = 1e-3;
  // Upper bound on remedies of a degree. Tuned by bench/tune.py remedies.stall_rounds.
  int stall_rounds = 60;
  // The weights of the barrier that a run follows, relative to the energy. Tuned by bench/tune.py
  // remedies.barrier_rounds, which leaves them out.
  BarrierWeights barrier_weights{.first = 0.1, .most_phases = 6};
  // Relative decrease that ends a weight. Tuned by bench/tune.py remedies.barrier_tolerance.
  double barrier_tolerance = 1e-4;
  // Upper bound on passes along the barrier, which end when one gains nothing. A second one helps
  // where the first did; a third one has no known use.
  int barrier_rounds = 3;
};

// Rules of the triangulated space around an image (map_domain.h).
struct ScaffoldRules {
  // False: the scaffold is created when a map first overlaps, around the previous map. True is
  // faster if free maps are known to overlap.
  bool from_the_start = false;
  // lambda E_conf / E while the image moves. The 1e-4 of [MC20] is too weak a barrier where curves
  // touch, so that runs stall with it from the start.
  double share = 1e-3;
  // This ratio at rest. [MC20] Sec. 6; energies are 1e-5 to 3e-4 lower than with `share` where
  // the image would overlap (docs/bijective.md). Tuned by bench/tune.py scaffold.share_at_rest.
  double share_at_rest = 1e-4;
  // The least depth of bisection of the scaffold's certificates. Slits are full of slivers, where
  // det J has minima, and combs stall at lower depths (tests/campaigns/combs.py). Only faces that
  // are not proven earlier are bisected, and no result contains them.
  int depth = 25;
  // The image rests when a step without obstacles decreases the energy by less than this fraction.
  // Tuned by bench/tune.py scaffold.at_rest.
  double at_rest = 1e-5;
  // A relative change of lambda below this is ignored, so that the stepper keeps its history. Tuned
  // by bench/tune.py scaffold.same_lambda.
  double same_lambda = 0.02;
  // Lower bound on the mean density that scales lambda, for maps whose density vanishes. It is a
  // small fraction of the densities of maps that are not isometric, which are 4 and more where
  // isometries do not have 0.
  double least_energy = 1e-3;
  // The scaffold is relaxed after flips if the relative decrease is below this; before, the next
  // step changes everything again. Tuned by bench/tune.py scaffold.still_moving.
  double still_moving = 1e-3;
  // The scaffold is relaxed if less than this fraction of a step was free of inverted triangles.
  // Tuned by bench/tune.py scaffold.short_bound.
  double short_bound = 0.5;
  // Newton steps of a relaxation. Tuned by bench/tune.py scaffold.relax_steps.
  int relax_steps = 5;
  // Around maps of at least this many faces the scaffold stays unchanged while a factor serves
  // several steps (LaggedFactorRules). A flip requires a factorization, which costs several times
  // the rest of a step, and near the minimum most steps gain almost nothing by it.
  Index patient_faces = 50000;
  // The number of such steps: those that a factor serves.
  int patience = LaggedFactorRules{}.steps;
  // A run ends at the first small step whose decrease is below this fraction of the requested
  // tolerance. Newton steps are never exact: the image of a scaffolded map may not rotate freely,
  // so the exact Hessian is indefinite. The small steps at the end add up: with the tolerance
  // itself, runs end 2e-5 above their minimum. Requiring two small steps of half the tolerance
  // gives no lower energy and takes a tenth more iterations.
  double part_of_tolerance = 0.25;
  // StoppingRules::tail_steps. Tuned by bench/tune.py scaffold.tail_steps.
  int tail_steps = 1;
};

// The distance at which a barrier between parts of the boundary begins: a part of the lengths of
// their edges, but at most a part of the square root of the map's area.
struct BarrierReach {
  double of_edges;
  double of_size = std::numeric_limits<double>::infinity();
};

// Rules of the barrier between parts of the boundary (boundary_barrier.h), which replaces a
// scaffold around maps of degree 1.
struct BoundaryBarrierRules {
  // weight: relative to the weights of the energies.
  struct Strength {
    BarrierReach reach;
    double weight;
  };
  // A barrier that begins far from contact bends Newton steps in time, and one that begins near it
  // adds less to the energy. Tuned on the public disks whose free maps overlap.
  Strength moving{{0.5}, 0.1}, at_rest{{0.25, 0.01}, 0.03};
  // The image rests when a step without obstacles decreases the energy by less than this fraction.
  double rests_below = 1e-3;
  // A step is without obstacles if at least this part of it is free of contacts.
  double short_bound = 0.5;
  // Pairs within this multiple of the reach are elements of a new problem. Fewer problems have to
  // be built if there are more of them.
  double listed = 2;
  // A factor serves several steps only if these decrease the energy by less than this fraction,
  // since the barrier's curvature changes quickly.
  double lagged_below = 1e-5;
  // See ScaffoldRules::part_of_tolerance.
  double part_of_tolerance = 0.25;
};

// Rules of bounds with a barrier, as in BarrierOptions (barrier_minimizer.h).
struct BoundRules {
  // The first weight times the absolute values of the barrier's elements, relative to the energy:
  // strong enough to lead away from the bound, weak enough for the energy to matter.
  double first_share = 0.1;
  // Lower bound on the mean density that scales the weight, for maps whose density vanishes.
  double least_energy = ScaffoldRules{}.least_energy;
  // Lower bound on the absolute values of the barrier, which vanish at distance 1 from the bound.
  // It keeps the weight finite.
  double least_barrier = 1e-6;
  // See BarrierOptions::centred. With the default there, 0.1, coarse maps end 1e-4 above their
  // minimum.
  double centred = 0.01;
  BoundEntryRules entry;
  // The first weight follows from first_share. most_phases bounds the cost of hopeless cases;
  // chosen, not tuned.
  BarrierWeights weights{.most_phases = 40};
};

struct SolverRules {
  // All rules except relative_decrease and max_iterations, which are options of a solve.
  StoppingRules stopping = stopping_of_maps();
  LineSearchOptions line_search;
  BlendRules blend = blend_of_maps();
  // These values have most of the gain of any such values, at every degree.
  LaggedFactorRules lagged{.below = 1e-4};
  QuadratureRules quadrature;
  // Upper bound on refinements of the quadrature of a finished run. Tuned by bench/tune.py
  // accuracy_rounds.
  int accuracy_rounds = 3;
  // A start with a larger mean density than this is a soft one. Tuned by bench/tune.py soft_start.
  double soft_start = 1e5;
  RemedyRules remedies;
  BoundRules bounds;
  ScaffoldRules scaffold;
  BoundaryBarrierRules boundary;
};

// Throws InvalidArgument that lists the available models if a term does not have this curvature
// model.
void require_curvature(const DensityTerms& terms, Curvature model);

// Returns the options. linear_solver: empty for the direct one with these options.
NewtonOptions newton_options(const CurvatureChoice& curvature, const SolverRules& rules,
                             const StopCheck& stop, const DirectSolverOptions& direct,
                             const SolverFactory& linear_solver = {});

// Returns whether a limit or Ctrl-C ended a solve.
bool was_stopped(Status status);
// Returns `result` with the reason that ended a run early.
SolveResult stopped(SolveResult result, Directive why);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
