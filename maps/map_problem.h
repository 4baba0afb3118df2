// The optimization problem of a map on one space: what parametrize() minimizes at every degree, and
// what any other Minimizer can be given instead.
//
//   auto terms = energy_terms(spec, space, {rule});
//   auto injectivity = std::make_shared<const LocalInjectivity>(space, 2 * spec.rest->measure);
//   Problem problem = map_problem(spec, space, start, terms, injectivity).problem;
//   SolveResult r = LbfgsMinimizer().minimize(problem, problem.reduce(start), {});
//
// Not for who wants the map: parametrize() raises the degree, refines quadrature and gets runs out
// of stalls, of which nothing is here.
#pragma once

#include <memory>
#include <vector>

#include "majorant/constraints/constraints.h"
#include "majorant/constraints/local_injectivity.h"
#include "majorant/framework/problem.h"
#include "majorant/framework/stop_check.h"
#include "majorant/maps/map_extension.h"
#include "majorant/maps/map_options.h"
#include "majorant/mesh/seams.h"

namespace majorant {

class MapPart;

// The normalised problem: what solvers make of MapOptions, whatever the degree. Positions in the
// units of the rest shapes.
struct MapSpecification {
  MapSpecification() = default;
  // Takes over what MapOptions says without units.
  explicit MapSpecification(const MapOptions& asked);

  EnergySum energy = MapOptions().energy;
  Vec face_weight;  // as MapOptions has them, as the next three
  BoundaryCondition boundary = BoundaryCondition::Free;
  BoundaryAngles boundary_angles = BoundaryAngles::Free;
  double handle_weight = MapOptions().handle_weight;
  std::shared_ptr<const RestShapes> rest = std::make_shared<const RestShapes>();  // not null
  std::shared_ptr<const Seams> seams;  // hold exactly; null: none
  std::vector<AlignedEdge> aligned;    // stay parallel to an axis
  std::vector<FixedPoint> pins;        // hard, vertices
  std::vector<FixedPoint> handles;     // soft, vertices
  // Null: the whole map. Else all of the above is that of a part of it; seams, aligned
  // edges and angles at the boundary cannot be asked for.
  std::shared_ptr<const MapPart> part;
  // Terms and constraints that a caller adds at the degree of the problem; null: none.
  std::shared_ptr<const MapExtension> added;
};

// The area of the whole map.
double whole_area(const MapSpecification& spec);
// Nodes on the boundary of the uncut surface, sorted.
std::vector<Index> boundary_of(const MapSpecification& spec, const BezierTriangleSpace& space);
// Returns a builder of the unknowns of a map, for problems of that map alone.
ProblemBuilder map_builder(const MapSpecification& spec, const BezierTriangleSpace& space);

using DensityTerms = std::vector<std::shared_ptr<const DensityTerm>>;

// One term per summand of spec.energy. Throws InvalidArgument for a summand that has data or
// weights for another number of faces.
DensityTerms energy_terms(const MapSpecification& spec,
                          const std::shared_ptr<const BezierTriangleSpace>& space,
                          const std::vector<Quadrature>& rules);

// Returns for each vertex the smallest vertex of its component of the (cut) surface.
std::vector<Index> vertex_components(const BezierTriangleSpace& space);

// Vertices that map_problem() holds because nothing else holds the translations of their piece of
// the (cut) surface, which are the null space of the energy (method.md N3): one a piece.
std::vector<Index> gauge_vertices(const MapSpecification& spec, const BezierTriangleSpace& space);

// Ids of terms in the problem of a map: those of spec.energy, one a summand, and those that were
// added, in their order.
struct MapTerms {
  std::vector<TermId> energies, added;
};

// Adds to `builder` what is asked of a map whose nodes are the builder's first unknowns: terms,
// constraints and checkers, injectivity (may be null) among them; not the gauge. For problems with
// more unknowns than a map's (a scaffold); others use map_problem().
MapTerms add_map(ProblemBuilder& builder, const MapSpecification& spec,
                 const std::shared_ptr<const BezierTriangleSpace>& space, VecIn start,
                 const DensityTerms& terms, std::shared_ptr<const FeasibilityChecker> injectivity);

struct MapProblem : MapTerms {
  Problem problem;
};

// start: 2 numbers per node, whose boundary (where it is fixed) and gauge vertices stay.
// injectivity may be null. The energies have the weights of spec. Of a gauge vertex only those
// coordinates are held whose translations nothing that was added withstands: a term does where a
// translation changes it at the start; rows with auxiliary unknowns do not count.
MapProblem map_problem(const MapSpecification& spec,
                       const std::shared_ptr<const BezierTriangleSpace>& space, VecIn start,
                       const DensityTerms& terms,
                       std::shared_ptr<const FeasibilityChecker> injectivity);

// States of the energies with other quadrature rules (#F, empty = all 0) and element weights (#F,
// on top of those of spec and of its summands, empty = all 1).
TermChanges energy_states(const MapSpecification& spec, const std::vector<TermId>& energies,
                          const std::vector<RuleId>& rules, const Vec& element_weight);

// #F integrals of the energy over each face here, face weights included, neither handles nor what
// was added. Throws Stopped.
Vec energy_by_face(const MapSpecification& spec, const DensityTerms& terms,
                   const std::vector<RuleId>& rules, VecIn x, const StopCheck& stop = {});
// Their sum over the whole map and that of the handles, over the area, and what was added.
double energy_of_map(const MapSpecification& spec, const DensityTerms& terms,
                     const std::vector<RuleId>& rules, VecIn x);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
