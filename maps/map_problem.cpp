#include "majorant/maps/map_problem.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "majorant/constraints/constraints.h"
#include "majorant/framework/argument_check.h"
#include "majorant/framework/element_values.h"
#include "majorant/framework/problem.h"
#include "majorant/framework/terms/quadratic_penalty.h"
#include "majorant/maps/map_part.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/mesh/union_find.h"

namespace majorant {
namespace {

const Seams& seams_of(const MapSpecification& spec) {
  static const Seams none;
  return spec.seams ? *spec.seams : none;
}

// Returns the factors of one summand at the faces, times `more` (empty = all 1); empty = all 1.
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

// Returns the state of a summand. area: of the whole map.
TermState state_of(const MapSpecification& spec, const WeightedEnergy& summand, double area,
                   const Vec& element_weight) {
  TermState state;
  state.weight = summand.weight / area;
  state.element_weight = weight_of_faces(spec, summand, element_weight);
  return state;
}

// The translation by which terms are tested, on a surface of size about 1. Chosen: any length far
// above the rounding of coordinates works.
constexpr double kTranslation = 0.5;
// Changes of a term's value, and coefficients of a translation, below this count as 0. The value is
// relative to the largest number in their sum: far above rounding, far below any real effect.
constexpr double kNoChange = 1e-9;

// A checker of the map's unknowns in a problem with more unknowns. It reports no blocking elements,
// since remedies apply to faces.
class OnMap final : public FeasibilityChecker {
 public:
  OnMap(std::shared_ptr<const FeasibilityChecker> checker, Index unknowns)
      : checker_(std::move(checker)), unknowns_(unknowns) {}
  std::string_view name() const override { return checker_->name(); }
  Verdict check(VecIn x) const override {
    Verdict verdict = checker_->check(x.head(unknowns_));
    verdict.blocking.clear();
    verdict.proven.clear();
    return verdict;
  }
  StepBound max_step(VecIn x, VecIn d, double s) const override {
    return {checker_->max_step(x.head(unknowns_), d.head(unknowns_), s).step, {}};
  }

 private:
  std::shared_ptr<const FeasibilityChecker> checker_;
  Index unknowns_;
};

Vec values_of(const EnergyTerm& term, VecIn x) {
  return element_values(term, {}, ColoredBatches(term.element_dofs(), {}), x);
}

bool same_values(const Vec& a, const Vec& b) {
  double size = 0;
  for (const double f : a)
    if (std::isfinite(f)) size = std::max(size, std::abs(f));
  for (Index e = 0; e < a.size(); ++e)
    if (a[e] != b[e] && !(std::abs(a[e] - b[e]) <= kNoChange * size)) return false;
  return true;
}

// The translations of the pieces of gauge vertices, 2 each, and those of them that rows rule out,
// by Gaussian elimination of few columns.
class Translations {
 public:
  Translations(const BezierTriangleSpace& space, const std::vector<Index>& gauge)
      : gauge_(gauge), piece_of_(to_size(space.node_count()), -1), ruled_out_(2 * gauge.size(), 0) {
    const std::vector<Index> component = vertex_components(space);
    std::vector<Index> piece(to_size(space.vertex_count()), -1);
    for (std::size_t g = 0; g < gauge.size(); ++g)
      piece[component[gauge[g]]] = static_cast<Index>(g);
    for (Index f = 0; f < space.element_count(); ++f)
      for (const Index node : space.cells().row(f))
        piece_of_[node] = piece[component[space.faces()(f, 0)]];
  }

  void constrain(const ConstraintRows& rows) {
    for (std::size_t r = 0; r < rows.size(); ++r) {
      Vec row = Vec::Zero(count());
      double size = 0;
      bool own = true;
      for (auto e = rows.begin(r); e != rows.end(r); ++e) {
        own = own && e->unknown >= 0;
        if (!own || e->unknown / 2 >= static_cast<Index>(piece_of_.size())) continue;
        size = std::max(size, std::abs(e->coefficient));
        if (const Index piece = piece_of_[e->unknown / 2]; piece >= 0)
          row[2 * piece + e->unknown % 2] += e->coefficient;
      }
      if (own) rule_out(std::move(row), kNoChange * size);
    }
  }

  void constrain(const EnergyTerm& term, const Vec& x) {
    const Vec values = values_of(term, x);
    for (Index t = 0; t < count(); ++t) {
      Vec moved = x;
      for (std::size_t node = 0; node < piece_of_.size(); ++node)
        if (piece_of_[node] == t / 2) moved[2 * static_cast<Index>(node) + t % 2] += kTranslation;
      if (!same_values(values, values_of(term, moved))) rule_out(Vec::Unit(count(), t), kNoChange);
    }
  }

  // Returns the unknowns that hold the remaining translations, with their values in x.
  std::vector<FixedUnknown> stopped(VecIn x) const {
    std::vector<FixedUnknown> unknowns;
    for (Index t = 0; t < count(); ++t) {
      const Index unknown = 2 * gauge_[t / 2] + t % 2;
      if (!ruled_out_[t]) unknowns.push_back({unknown, x[unknown]});
    }
    return unknowns;
  }

 private:
  Index count() const { return static_cast<Index>(ruled_out_.size()); }

  void rule_out(Vec row, double tolerance) {
    for (const auto& [pivot, basis] : rows_) row -= row[pivot] * basis;
    Index pivot = 0;
    if (!(row.cwiseAbs().maxCoeff(&pivot) > tolerance)) return;
    ruled_out_[pivot] = 1;
    row /= row[pivot];
    rows_.emplace_back(pivot, std::move(row));
  }

  const std::vector<Index>& gauge_;
  std::vector<Index> piece_of_;  // by node, -1: held in any case
  std::vector<char> ruled_out_;
  std::vector<std::pair<Index, Vec>> rows_;  // 1 at their pivots
};

double energy_of(const MapExtension& added, VecIn x) {
  double sum = 0;
  for (const auto& [term, weight] : added.terms()) sum += weight * values_of(*term, x).sum();
  return sum;
}

// Returns the unknowns to hold so that the pieces of a map cannot be translated.
FixedUnknowns gauge(const MapSpecification& spec, const BezierTriangleSpace& space, VecIn start) {
  const std::vector<Index> vertices = gauge_vertices(spec, space);
  Translations translations(space, vertices);
  if (spec.added && !vertices.empty()) {
    ConstraintRows rows;
    for (const auto& constraint : spec.added->constraints()) constraint->append_rows(rows);
    translations.constrain(rows);
    for (const auto& added : spec.added->terms()) translations.constrain(*added.term, start);
  }
  return FixedUnknowns(translations.stopped(start));
}

void add_extension(ProblemBuilder& builder, const MapExtension& added, MapTerms& ids) {
  const auto unknowns = static_cast<Index>(added.start().size());
  for (const auto& [term, weight] : added.terms()) ids.added.push_back(builder.add(term, weight));
  for (const auto& constraint : added.constraints()) builder.add(*constraint);
  for (const auto& checker : added.checkers())
    builder.add(std::make_shared<const OnMap>(checker, unknowns));
}

}  // namespace

MapSpecification::MapSpecification(const MapOptions& options)
    : energy(options.energy),
      face_weight(options.face_weight),
      boundary(options.boundary),
      boundary_angles(options.boundary_angles),
      handle_weight(options.handle_weight) {}

const Ranks& ranks_of(const MapSpecification& spec) {
  return spec.part ? spec.part->ranks() : *one_process();
}

BezierMap as_owners_have_it(const MapSpecification& spec, BezierMap map) {
  if (!spec.part) return map;
  Vec x = map.control_points();
  spec.part->unknowns(map.space())->copy_from_owners(x);
  return map.with(map.shared_space(), std::move(x));
}

double whole_area(const MapSpecification& spec) {
  return ranks_of(spec).sum(spec.rest->measure.sum());
}

std::vector<Index> boundary_of(const MapSpecification& spec, const BezierTriangleSpace& space) {
  return spec.part ? spec.part->boundary_nodes(space) : boundary_nodes(space, seams_of(spec));
}

ProblemBuilder map_builder(const MapSpecification& spec, const BezierTriangleSpace& space) {
  if (!spec.part) return ProblemBuilder(2 * space.node_count());
  return shared_problem_builder(spec.part->unknowns(space));
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
  // Vertices off the seams come first, since holding them makes no fractions.
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

namespace {

// Returns element values by their rules. If all elements have one rule, they are computed in order.
Vec values_by(const std::vector<RuleId>& rules, const EnergyTerm& term, const TermState& state,
              VecIn x, const StopCheck& stop) {
  const RuleId first = rules.empty() ? 0 : rules.front();
  if (!std::all_of(rules.begin(), rules.end(), [=](RuleId rule) { return rule == first; }))
    return element_values(term, state, ColoredBatches(term.element_dofs(), rules), x, stop);
  std::vector<Index> all(to_size(term.element_dofs().element_count()));
  std::iota(all.begin(), all.end(), 0);
  return element_values(term, state, first, all, x, stop);
}

}  // namespace

DensityTerms energy_terms(const MapSpecification& spec,
                          const std::shared_ptr<const BezierTriangleSpace>& space,
                          const std::vector<Quadrature>& rules) {
  require_elements(spec.energy, space->element_count());
  DensityTerms terms;
  for (const WeightedEnergy& e : spec.energy) terms.push_back(e.make(space, spec.rest, rules));
  return terms;
}

MapTerms add_map(ProblemBuilder& builder, const MapSpecification& spec,
                 const std::shared_ptr<const BezierTriangleSpace>& space, VecIn start,
                 const DensityTerms& terms, std::shared_ptr<const FeasibilityChecker> injectivity) {
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
  MapTerms ids;
  for (std::size_t k = 0; k < terms.size(); ++k)
    ids.energies.push_back(builder.add(terms[k], state_of(spec, spec.energy[k], area, {})));
  if (spec.boundary_angles == BoundaryAngles::AtMostFullTurn)
    builder.add(
        std::make_shared<const AngleSums>(space, AngleSums::Vertices::Boundary, spec.seams));
  if (!spec.pins.empty())
    builder.add(FixedPoints(spec.pins));  // first, so that they hold to the bit
  if (!seams_of(spec).empty()) builder.add(SeamlessConstraint(space, spec.seams));
  if (!spec.aligned.empty()) builder.add(AxisAlignment(space, spec.aligned));
  if (spec.boundary == BoundaryCondition::Fixed)
    builder.add(FixedPoints::at(boundary_of(spec, *space), start));
  if (!spec.handles.empty())
    builder.add(std::make_shared<const QuadraticPenalty>(FixedPoints(spec.handles)),
                spec.handle_weight / area);
  if (injectivity) builder.add(std::move(injectivity));
  if (spec.added) add_extension(builder, *spec.added, ids);
  return ids;
}

MapProblem map_problem(const MapSpecification& spec,
                       const std::shared_ptr<const BezierTriangleSpace>& space, VecIn start,
                       const DensityTerms& terms,
                       std::shared_ptr<const FeasibilityChecker> injectivity) {
  require_given("map_problem: the space", space);
  ProblemBuilder builder = map_builder(spec, *space);
  MapTerms ids = add_map(builder, spec, space, start, terms, std::move(injectivity));
  builder.add(gauge(spec, *space, start));
  return {std::move(ids), builder.build()};
}

TermChanges energy_states(const MapSpecification& spec, const std::vector<TermId>& energies,
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
  Vec sum = Vec::Zero(spec.rest->measure.size());
  TermState state;
  state.element_rule = rules;
  for (std::size_t k = 0; k < terms.size(); ++k) {
    Vec values = spec.energy[k].weight * values_by(rules, *terms[k], state, x, stop);
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
  energy = ranks_of(spec).sum(energy) / whole_area(spec);
  return spec.added ? energy + energy_of(*spec.added, x) : energy;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
