// The optimization problem of a map on one space, which parametrize() minimizes at every degree.
// Any other Minimizer can minimize it instead.
//
//   auto terms = energy_terms(spec, space, {rule});
//   auto injectivity = std::make_shared<const LocalInjectivity>(space, 2 * spec.rest->measure);
//   Problem problem = map_problem(spec, space, start, terms, injectivity).problem;
//   SolveResult r = LbfgsMinimizer().minimize(problem, problem.reduce(start), {});
//
// For a finished map use parametrize(): it also raises the degree, refines quadrature and resolves
// stalls.
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

// The normalized problem that solvers derive from MapOptions, for any degree. Positions are in the
// units of the rest shapes.
struct MapSpecification {
  MapSpecification() = default;
  // Copies the options that have no units.
  explicit MapSpecification(const MapOptions& options);

  EnergySum energy = MapOptions().energy;
  Vec face_weight;  // this and the next three are those of MapOptions
  BoundaryCondition boundary = BoundaryCondition::Free;
  BoundaryAngles boundary_angles = BoundaryAngles::Free;
  double handle_weight = MapOptions().handle_weight;
  std::shared_ptr<const RestShapes> rest = std::make_shared<const RestShapes>();  // not null
  std::shared_ptr<const Seams> seams;  // hold exactly; null: none
  std::vector<AlignedEdge> aligned;    // stay parallel to an axis
  std::vector<FixedPoint> pins;        // hard, vertices
  std::vector<FixedPoint> handles;     // soft, vertices
  // The part to which all of the above belongs, which excludes seams, aligned edges and angles at
  // the boundary. Null: the whole map.
  std::shared_ptr<const MapPart> part;
  // Terms and constraints that a caller adds at the degree of the problem; null: none.
  std::shared_ptr<const MapExtension> added;
};

// Returns the area of the whole map.
double whole_area(const MapSpecification& spec);
// Returns the nodes on the boundary of the uncut surface, sorted.
std::vector<Index> boundary_of(const MapSpecification& spec, const BezierTriangleSpace& space);
// Returns a builder of the unknowns of a map, for problems of that map alone.
ProblemBuilder map_builder(const MapSpecification& spec, const BezierTriangleSpace& space);

using DensityTerms = std::vector<std::shared_ptr<const DensityTerm>>;

// Returns one term per summand of spec.energy. Throws InvalidArgument for a summand that has data
// or weights for another number of faces.
DensityTerms energy_terms(const MapSpecification& spec,
                          const std::shared_ptr<const BezierTriangleSpace>& space,
                          const std::vector<Quadrature>& rules);

// Returns for each vertex the smallest vertex of its component of the (cut) surface.
std::vector<Index> vertex_components(const BezierTriangleSpace& space);

// Returns the vertices that map_problem() holds, one for each piece of the (cut) surface whose
// translations nothing else holds. Translations are the null space of the energy (method.md N3).
std::vector<Index> gauge_vertices(const MapSpecification& spec, const BezierTriangleSpace& space);

// Ids of terms in the problem of a map: those of spec.energy, one a summand, and those of
// additions, in their order.
struct MapTerms {
  std::vector<TermId> energies, added;
};

// Adds terms, constraints and checkers of a map whose nodes are the builder's first unknowns.
// Includes injectivity (may be null) but not the gauge. For problems with more unknowns than those
// of a map, such as a scaffold; others use map_problem().
MapTerms add_map(ProblemBuilder& builder, const MapSpecification& spec,
                 const std::shared_ptr<const BezierTriangleSpace>& space, VecIn start,
                 const DensityTerms& terms, std::shared_ptr<const FeasibilityChecker> injectivity);

struct MapProblem : MapTerms {
  Problem problem;
};

// Returns the problem. start: 2 numbers per node, whose fixed boundary and gauge vertices stay.
// injectivity: may be null. The energies have the weights of spec. A gauge vertex is held only in
// coordinates whose translations no addition resists. A term resists if a translation changes it at
// the start; rows with auxiliary unknowns do not count.
MapProblem map_problem(const MapSpecification& spec,
                       const std::shared_ptr<const BezierTriangleSpace>& space, VecIn start,
                       const DensityTerms& terms,
                       std::shared_ptr<const FeasibilityChecker> injectivity);

// Returns states of the energies with other quadrature rules (#F, empty = all 0) and element
// weights (#F, multiplied by those of spec and of its summands, empty = all 1).
TermChanges energy_states(const MapSpecification& spec, const std::vector<TermId>& energies,
                          const std::vector<RuleId>& rules, const Vec& element_weight);

// Returns the #F integrals of the energy over each face here, with face weights, without handles
// and additions. Throws Stopped.
Vec energy_by_face(const MapSpecification& spec, const DensityTerms& terms,
                   const std::vector<RuleId>& rules, VecIn x, const StopCheck& stop = {});
// Returns their sum over the whole map plus that of the handles, divided by the area, plus the
// additions.
double energy_of_map(const MapSpecification& spec, const DensityTerms& terms,
                     const std::vector<RuleId>& rules, VecIn x);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
