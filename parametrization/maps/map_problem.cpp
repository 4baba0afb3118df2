#include "majorant/parametrization/maps/map_problem.h"

#include <algorithm>

#include "majorant/constraints/constraints.h"
#include "majorant/energies/quadratic_penalty.h"
#include "majorant/framework/argument_check.h"
#include "majorant/framework/element_values.h"
#include "majorant/framework/problem.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/mesh/union_find.h"

namespace majorant {
namespace {

const Seams& seams_of(const MapSpecification& spec) {
  static const Seams none;
  return spec.seams ? *spec.seams : none;
}

// The factors of one summand at the faces, `more` (empty = all 1) among them; empty = all 1.
Vec weight_of_faces(const MapSpecification& spec, const WeightedEnergy& summand, const Vec& more) {
  Vec product;
  for (const Vec* factor : {&spec.face_weight, &summand.face_weight, &more}) {
    if (factor->size() == 0) continue;
    if (product.size() == 0)
      product = *factor;
    else
      product.array() *= factor->array();
  }
  return product;
}

// area: of the whole map.
TermState state_of(const MapSpecification& spec, const WeightedEnergy& summand, double area,
                   const Vec& element_weight) {
  TermState state;
  state.weight = summand.weight / area;
  state.element_weight = weight_of_faces(spec, summand, element_weight);
  return state;
}

}  // namespace

const Ranks& ranks_of(const MapSpecification& spec) {
  return spec.part ? spec.part->ranks() : *one_process();
}

double whole_area(const MapSpecification& spec) {
  return ranks_of(spec).sum(spec.rest.measure.sum());
}

std::vector<Index> boundary_of(const MapSpecification& spec, const BezierTriangleSpace& space) {
  return spec.part ? spec.part->boundary_nodes(space) : boundary_nodes(space, seams_of(spec));
}

ProblemBuilder map_builder(const MapSpecification& spec, const BezierTriangleSpace& space) {
  if (!spec.part) return ProblemBuilder(2 * space.node_count());
  return ProblemBuilder(spec.part->unknowns(space));
}

std::vector<Index> vertex_components(const BezierTriangleSpace& space) {
  UnionFind components(space.vertex_count());
  for (Index f = 0; f < space.element_count(); ++f)
    for (const int k : {1, 2}) components.join(space.faces()(f, 0), space.faces()(f, k));
  std::vector<Index> component(to_size(space.vertex_count()));
  for (Index v = 0; v < space.vertex_count(); ++v) component[v] = components.find(v);
  return component;
}

std::vector<Index> gauge_vertices(const MapSpecification& spec, const BezierTriangleSpace& space) {
  for (const auto* points : {&spec.pins, &spec.handles})
    for (const FixedPoint& p : *points)
      require_index("MapSpecification: the node of a pin or handle", p.node, space.vertex_count());
  if (spec.part) {
    const bool held =
        !spec.pins.empty() || !spec.handles.empty() || spec.boundary == BoundaryCondition::Fixed;
    return spec.part->ranks().any(held) ? std::vector<Index>{} : spec.part->gauge_vertex();
  }
  const std::vector<Index> component = vertex_components(space);
  std::vector<char> is_held(to_size(space.vertex_count()), 0);
  std::vector<char> on_seam = is_held;
  for (const auto* points : {&spec.pins, &spec.handles})
    for (const FixedPoint& p : *points) is_held[component[p.node]] = 1;
  if (spec.boundary == BoundaryCondition::Fixed)
    for (const Index node : boundary_nodes(space, seams_of(spec)))
      if (node < space.vertex_count()) is_held[component[node]] = 1;
  for (const SeamEdge& edge : seams_of(spec).edges())
    for (const Index h : {edge.side, edge.opposite})
      for (const Index v : {from_vertex(space.faces(), h), to_vertex(space.faces(), h)})
        on_seam[v] = 1;
  // Off the seams first, where holding a point makes no fractions.
  std::vector<Index> gauge;
  for (const char allowed : {0, 1})
    for (Index v = 0; v < space.vertex_count(); ++v) {
      char& held = is_held[component[v]];
      if (held || on_seam[v] > allowed) continue;
      held = 1;
      gauge.push_back(v);
    }
  return gauge;
}

DensityTerms energy_terms(const MapSpecification& spec,
                          const std::shared_ptr<const BezierTriangleSpace>& space,
                          const std::vector<Quadrature>& rules) {
  require_elements(spec.energy, space->element_count());
  DensityTerms terms;
  for (const WeightedEnergy& e : spec.energy) terms.push_back(e.make(space, spec.rest, rules));
  return terms;
}

EnergyIds add_map(ProblemBuilder& builder, const MapSpecification& spec,
                  const std::shared_ptr<const BezierTriangleSpace>& space, VecIn start,
                  const DensityTerms& terms) {
  require_given("add_map: the space", space);
  require_enough("add_map: the start", start.size(), 2 * space->node_count());
  require_size("add_map: the list of terms", static_cast<Index>(terms.size()),
               static_cast<Index>(spec.energy.size()));
  if (spec.part && (spec.boundary_angles != BoundaryAngles::Free || !seams_of(spec).empty() ||
                    !spec.aligned.empty()))
    throw InvalidArgument(
        "add_map: seams, aligned edges and angles at the boundary need the whole map in one "
        "process");
  const double area = whole_area(spec);
  EnergyIds energies;
  for (std::size_t k = 0; k < terms.size(); ++k) {
    energies.push_back(builder.add(terms[k], state_of(spec, spec.energy[k], area, {})));
  }
  if (spec.boundary_angles == BoundaryAngles::AtMostFullTurn)
    builder.add(
        std::make_shared<const AngleSums>(space, AngleSums::Vertices::Boundary, spec.seams));
  if (!spec.pins.empty()) builder.add(FixedPoints(spec.pins));  // first: to the bit
  if (!seams_of(spec).empty()) builder.add(SeamlessConstraint(space, spec.seams));
  if (!spec.aligned.empty()) builder.add(AxisAlignment(space, spec.aligned));
  if (spec.boundary == BoundaryCondition::Fixed)
    builder.add(FixedPoints::at(boundary_of(spec, *space), start));
  if (!spec.handles.empty())
    builder.add(std::make_shared<const QuadraticPenalty>(FixedPoints(spec.handles)),
                spec.handle_weight / area);
  return energies;
}

MapProblem map_problem(const MapSpecification& spec,
                       const std::shared_ptr<const BezierTriangleSpace>& space, VecIn start,
                       const DensityTerms& terms,
                       std::shared_ptr<const FeasibilityChecker> injectivity) {
  require_given("map_problem: the space", space);
  ProblemBuilder builder = map_builder(spec, *space);
  EnergyIds energies = add_map(builder, spec, space, start, terms);
  if (injectivity) builder.add(std::move(injectivity));
  builder.add(FixedPoints::at(gauge_vertices(spec, *space), start));
  return {builder.build(), std::move(energies)};
}

TermChanges energy_states(const MapSpecification& spec, const EnergyIds& energies,
                          const std::vector<RuleId>& rules, const Vec& element_weight) {
  const double area = whole_area(spec);
  TermChanges changes;
  for (std::size_t k = 0; k < energies.size(); ++k) {
    TermState state = state_of(spec, spec.energy[k], area, element_weight);
    state.element_rule = rules;
    changes.emplace_back(energies[k], std::move(state));
  }
  return changes;
}

Vec energy_by_face(const MapSpecification& spec, const DensityTerms& terms,
                   const std::vector<RuleId>& rules, VecIn x, const StopCheck& stop) {
  Vec sum = Vec::Zero(spec.rest.measure.size());
  TermState state;
  state.element_rule = rules;
  for (std::size_t k = 0; k < terms.size(); ++k) {
    const ColoredBatches plan(terms[k]->element_dofs(), rules);
    Vec values = spec.energy[k].weight * element_values(*terms[k], state, plan, x, stop);
    const Vec weight = weight_of_faces(spec, spec.energy[k], {});
    if (weight.size() > 0) values.array() *= weight.array();
    sum += values;
  }
  return sum;
}

double energy_of_map(const MapSpecification& spec, const DensityTerms& terms,
                     const std::vector<RuleId>& rules, VecIn x) {
  double energy = energy_by_face(spec, terms, rules, x).sum();
  for (const FixedPoint& handle : spec.handles)
    energy += spec.handle_weight * (x.segment<2>(2 * handle.node) - handle.position).squaredNorm();
  return ranks_of(spec).sum(energy) / whole_area(spec);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
