// The optimization problem of a map on one space: what parametrize() minimizes at every degree, and
// what any other Minimizer can be given instead.
//
//   auto terms = energy_terms(spec, space, {rule});
//   auto injectivity = std::make_shared<const LocalInjectivity>(space, 2 * spec.rest.measure);
//   Problem problem = map_problem(spec, space, start, terms, injectivity);
//   SolveResult r = LbfgsMinimizer().minimize(problem, problem.reduce(start), {});
#pragma once

#include <memory>
#include <vector>

#include "majorant/constraints/axis_alignment.h"
#include "majorant/constraints/fixed_points.h"
#include "majorant/constraints/local_injectivity.h"
#include "majorant/energies/energy_factory.h"
#include "majorant/framework/problem.h"
#include "majorant/framework/stop_check.h"
#include "majorant/mesh/seams.h"

namespace majorant {

// Weights lie between 1 / kLargestFactor and kLargestFactor, targets no farther than that many
// model sizes away: the products of two weights and a squared distance, of two of which norms are
// made, stay finite in doubles.
inline constexpr double kLargestFactor = 1e30;
inline bool is_usable_weight(double weight) {
  return weight >= 1 / kLargestFactor && weight <= kLargestFactor;
}

enum class BoundaryCondition { Free, Fixed };        // Fixed: the start's boundary stays
enum class BoundaryAngles { Free, AtMostFullTurn };  // sector sums at boundary vertices

// What is asked of a map, whatever its degree. Positions in the units of the rest shapes.
struct MapSpecification {
  RestShapes rest;
  EnergySum energy;  // minimized: its mean over the surface
  Vec face_weight;   // #F factors of the density, empty = all 1
  BoundaryCondition boundary = BoundaryCondition::Free;
  BoundaryAngles boundary_angles = BoundaryAngles::Free;
  std::shared_ptr<const Seams> seams;  // hold exactly; null: none
  std::vector<AlignedEdge> aligned;    // stay parallel to an axis
  std::vector<FixedPoint> pins;        // hard, vertices
  std::vector<FixedPoint> handles;     // soft, vertices
  double handle_weight = 1e3;          // w of w * sum |x - target|^2 / area
};

using DensityTerms = std::vector<std::shared_ptr<const DensityTerm>>;

// One term per summand of spec.energy.
DensityTerms energy_terms(const MapSpecification& spec,
                          const std::shared_ptr<const BezierTriangleSpace>& space,
                          const std::vector<Quadrature>& rules);

// Per vertex, the smallest vertex of its piece of the (cut) surface: faces connect a piece.
std::vector<Index> pieces_of(const BezierTriangleSpace& space);

// Vertices that map_problem() holds because nothing else holds the translations of their piece of
// the (cut) surface, which are the null space of the energy (method.md N3): one a piece.
std::vector<Index> gauge_vertices(const MapSpecification& spec, const BezierTriangleSpace& space);

// Adds to `builder` what is asked of a map whose nodes are the builder's first unknowns: terms,
// constraints and the check of boundary angles; neither injectivity nor gauge vertices. For
// problems with more unknowns than a map's (a scaffold); others use map_problem().
void add_map(ProblemBuilder& builder, const MapSpecification& spec,
             const std::shared_ptr<const BezierTriangleSpace>& space, VecIn start,
             const DensityTerms& terms);

// start: 2 numbers per node, whose boundary (where it is fixed) and gauge vertices stay.
// injectivity may be null. Terms 0 .. terms.size() - 1 of the problem are `terms`, with the weights
// of spec; the penalty of soft handles comes after them.
Problem map_problem(const MapSpecification& spec,
                    const std::shared_ptr<const BezierTriangleSpace>& space, VecIn start,
                    const DensityTerms& terms,
                    std::shared_ptr<const FeasibilityChecker> injectivity);

// States of the problem's terms with other quadrature rules (#F, empty = all 0) and element weights
// (#F, on top of spec.face_weight, empty = all 1) for its energies.
std::vector<TermState> energy_states(const MapSpecification& spec, const Problem& problem,
                                     const std::vector<RuleId>& rules, const Vec& element_weight);

// #F integrals of the energy over each face, face weights included, handles not. Throws Stopped.
Vec energy_by_face(const MapSpecification& spec, const DensityTerms& terms,
                   const std::vector<RuleId>& rules, VecIn x, const StopCheck& stop = {});

}  // namespace majorant
