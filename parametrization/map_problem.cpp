#include "majorant/parametrization/map_problem.h"

#include "majorant/energies/quadratic_penalty.h"
#include "majorant/framework/evaluator.h"

namespace majorant {

DensityTerms energy_terms(const MapSpecification& spec,
                          const std::shared_ptr<const BezierTriangleSpace>& space,
                          const std::vector<Quadrature>& rules) {
  DensityTerms terms;
  for (const WeightedEnergy& e : spec.energy) terms.push_back(e.make(space, spec.rest, rules));
  return terms;
}

Problem map_problem(const MapSpecification& spec,
                    const std::shared_ptr<const BezierTriangleSpace>& space, VecIn start,
                    const DensityTerms& terms,
                    std::shared_ptr<const FeasibilityChecker> injectivity) {
  ProblemBuilder builder(2 * space->node_count());
  const double area = spec.rest.measure.sum();
  for (std::size_t k = 0; k < terms.size(); ++k) {
    TermState state;
    state.weight = spec.energy[k].weight / area;
    state.element_weight = spec.face_weight;
    builder.add(terms[k], state);
  }
  builder.add(std::move(injectivity));
  if (spec.boundary_angles == BoundaryAngles::AtMostFullTurn)
    builder.add(std::make_shared<const AngleSums>(space, AngleSums::Vertices::Boundary));
  if (spec.boundary == BoundaryCondition::Fixed)
    builder.add(FixedPoints::at(space->boundary_nodes(), start));
  if (!spec.handles.empty())
    builder.add(std::make_shared<const QuadraticPenalty>(FixedPoints(spec.handles)),
                spec.handle_weight / area);
  if (!spec.pins.empty())
    builder.add(FixedPoints(spec.pins));
  else if (spec.boundary == BoundaryCondition::Free && spec.handles.empty())
    builder.add(FixedPoints::at({0}, start));  // translations are the null space (method.md N3)
  return builder.build();
}

std::vector<TermState> energy_states(const MapSpecification& spec, const Problem& problem,
                                     const std::vector<RuleId>& rules, const Vec& element_weight) {
  std::vector<TermState> states;
  for (std::size_t k = 0; k < problem.term_count(); ++k) {
    states.push_back(problem.state(k));
    if (k >= spec.energy.size()) continue;
    states[k].element_rule = rules;
    states[k].element_weight = spec.face_weight;
    if (element_weight.size() == 0) continue;
    if (spec.face_weight.size() == 0)
      states[k].element_weight = element_weight;
    else
      states[k].element_weight.array() *= element_weight.array();
  }
  return states;
}

Vec energy_by_face(const MapSpecification& spec, const DensityTerms& terms,
                   const std::vector<RuleId>& rules, VecIn x) {
  Vec sum = Vec::Zero(spec.rest.measure.size());
  TermState state;
  state.element_rule = rules;
  for (std::size_t k = 0; k < terms.size(); ++k) {
    const ChunkPlan plan(terms[k]->stencils(), rules);
    sum += spec.energy[k].weight * element_values(*terms[k], state, plan, x);
  }
  if (spec.face_weight.size()) sum.array() *= spec.face_weight.array();
  return sum;
}

}  // namespace majorant
