// The rules by which parametrize() solves, as a value: every number that decides when it ends, what
// it does against stalls, how it keeps a scaffold in shape.
//
//   SolverRules rules;                     // those of parametrize()
//   rules.scaffold.share = 1e-4;           // [MC20]'s
//   parametrize_by(rules, map, options, record);   // parametrize_by.h
//
// Nobody but measurements sets them (bench/tune.cpp). bench/tune.py measures what each is worth.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "majorant/elements/element_space.h"
#include "majorant/framework/barrier_path.h"
#include "majorant/maps/map_options.h"
#include "majorant/maps/map_problem.h"
#include "majorant/maps/newton_of_maps.h"
#include "majorant/maps/quadrature_ladder.h"

namespace majorant {

// Against stalls, in the order in which they are tried (degree_solver.cpp).
struct RemedyRules {
  // Bisection where the depth asked for holds a run back.
  int deepest_bisection = ProofDepth::kDeepest;
  // Levels at a time. Two remedies lead from 5 to 13.
  int bisections_deeper = 4;
  // Weight of triangles that are excluded: docs/method.md, section 9.
  double excluded_weight = 1e-6;
  // Steps without them. Measured by bench/tune.py remedies.excluded_iterations.
  int excluded_iterations = 10;
  // Relative decrease that ends these steps early. A thousand times the final one: they
  // only leave a corner.
  double excluded_tolerance = 1e-3;
  // Remedies of a degree. Measured by bench/tune.py remedies.stall_rounds.
  int stall_rounds = 60;
  // The weights of the barrier that a run follows, relative to the energy. Measured by
  // bench/tune.py remedies.barrier_rounds, which leaves them out.
  BarrierWeights barrier_weights{.first = 0.1, .most_phases = 6};
  // Relative decrease that ends a weight. Measured by bench/tune.py remedies.barrier_tolerance.
  double barrier_tolerance = 1e-4;
  // Ways along the barrier, as long as they gain anything. A second one helps where the first did,
  // a third one has not been seen to.
  int barrier_rounds = 3;
};

// The space around an image (map_domain.h).
struct ScaffoldRules {
  // False: the scaffold is made when a map overlaps for the first time, around the one before. True
  // where free maps are known to overlap: the way is shorter then.
  bool from_the_start = false;
  // lambda E_conf / E while the image moves. [MC20]'s 1e-4 is too weak a barrier where
  // curves touch: runs stall with it from the start.
  double share = 1e-3;
  // The same at rest. [MC20] Sec. 6; energies are 1e-5 to 3e-4 lower than with `share`
  // where the image would overlap (docs/bijective.md); bench/tune.py scaffold.share_at_rest.
  double share_at_rest = 1e-4;
  // Depth of bisection in its certificates, where a run asks for less: slits are full of slivers,
  // in which det J dips, and combs stall at lower depths (tests/campaigns/combs.py). Only what is
  // not proven before is bisected, and none of it is in a result.
  int depth = 25;
  // The image rests when a step that nothing held back decreases the energy by less than this part.
  // Measured by bench/tune.py scaffold.at_rest.
  double at_rest = 1e-5;
  // A change of lambda below this part does not count: the stepper keeps what it has learned.
  // Measured by bench/tune.py scaffold.same_lambda.
  double same_lambda = 0.02;
  // Mean density: where the map's vanishes, the scaffold stays. A small part of the
  // densities of maps that are not isometric, 4 and more where isometries do not have 0.
  double least_energy = 1e-3;
  // The scaffold is relaxed after flips where the relative decrease is below this: before, the next
  // step changes everything again. Measured by bench/tune.py scaffold.still_moving.
  double still_moving = 1e-3;
  // It is relaxed where less than this part of a step was free of inverted triangles.
  // bench/tune.py scaffold.short_bound.
  double short_bound = 0.5;
  // Newton steps that relax it. Measured by bench/tune.py scaffold.relax_steps.
  int relax_steps = 5;
  // Around maps of so many faces the scaffold stays as it is while a factor serves several steps
  // (LaggedFactorRules): a flip means a factorization, which costs several times what all else in a
  // step does, and near the minimum most steps gain by it next to nothing.
  Index patient_faces = 50000;
  // For so many steps, those that a factor serves.
  int patience = LaggedFactorRules{}.steps;
  // The part of the tolerance asked for at which the first small step ends a run. Newton steps
  // never become exact (the image of a scaffolded map may not turn freely, so the exact Hessian is
  // indefinite), and the small steps at the end add up: at the tolerance itself runs end 2e-5 above
  // their minimum. Two small steps of half the tolerance end no lower and take a tenth more
  // iterations.
  double part_of_tolerance = 0.25;
  // StoppingRules::tail_steps. Measured by bench/tune.py scaffold.tail_steps.
  int tail_steps = 1;
};

// Bounds with a barrier, as BarrierOptions (barrier_minimizer.h) has them.
struct BoundRules {
  // The first weight times the absolute values of the barrier's elements, relative to the energy:
  // strong enough to lead away from the bound, weak enough to leave the energy its say.
  double first_share = 0.1;
  // Mean density: where the map's vanishes, a barrier has a weight.
  double least_energy = ScaffoldRules{}.least_energy;
  // The same of a barrier's values, which are 0 where rooms are 1. No weight is infinite.
  double least_barrier = 1e-6;
  // BarrierOptions::centred. A tenth leaves coarse maps of twice the stretch 1e-4 above their
  // minimum.
  double centred = 0.01;
  BoundEntryRules entry;
  // The first is first_share's. Bounds the cost of what leads nowhere; chosen, not tuned.
  BarrierWeights weights{.most_phases = 40};
};

struct SolverRules {
  // All but relative_decrease and max_iterations, which are options of a solve.
  StoppingRules stopping = stopping_of_maps();
  LineSearchOptions line_search;
  BlendRules blend = blend_of_maps();
  // They have most of what any such values gain, at every degree.
  LaggedFactorRules lagged{.below = 1e-4};
  QuadratureRules quadrature;
  // Times the quadrature of a finished run is refined. Measured by bench/tune.py accuracy_rounds.
  int accuracy_rounds = 3;
  // Mean density of a start beyond which it is a soft one. Measured by bench/tune.py soft_start.
  double soft_start = 1e5;
  RemedyRules remedies;
  BoundRules bounds;
  ScaffoldRules scaffold;
};

// Throws InvalidArgument, listing what there is, when a term has no such curvature model.
void require_curvature(const DensityTerms& terms, Curvature asked);

// linear_solver: empty for the direct one with these options.
NewtonOptions newton_options(const CurvatureChoice& curvature, const SolverRules& rules,
                             const StopCheck& stop, const DirectSolverOptions& direct,
                             const SolverFactory& linear_solver = {});

// Returns whether a limit or Ctrl-C ended a solve.
bool was_stopped(Status status);
// `result` with what ended a run in the middle of something else.
SolveResult stopped(SolveResult result, Directive why);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
