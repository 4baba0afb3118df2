#include "majorant/parametrization/solve/internal/map_domain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "majorant/framework/element_values.h"
#include "majorant/framework/energy_term.h"
#include "majorant/framework/error.h"
#include "majorant/framework/problem.h"
#include "majorant/framework/stopwatch.h"

namespace majorant {
namespace {

// A solver that is kept for the next one who needs one: patterns differ little, and it knows the
// last one's ordering.
class KeptSolver final : public LinearSolver {
 public:
  explicit KeptSolver(std::shared_ptr<LinearSolver> solver) : solver_(std::move(solver)) {}
  void analyze(const SparsePattern& pattern) override { solver_->analyze(pattern); }
  FactorStatus factorize(const Vec& values, double shift) override {
    return solver_->factorize(values, shift);
  }
  Solution solve(const Vec& r, Vec& p, double tolerance) override {
    return solver_->solve(r, p, tolerance);
  }
  std::string description() const override { return solver_->description(); }

 private:
  std::shared_ptr<LinearSolver> solver_;
};

// The translation that terms are asked about, where the surface has a size of about 1. Chosen: any
// length will do that is no rounding error of the coordinates.
constexpr double kTranslation = 0.5;
// Changes of a term's value and coefficients of a translation that count as 0, relative to the
// largest number that they are sums of: far above rounding, far below what a term means.
constexpr double kNoChange = 1e-9;

// A checker of the map's unknowns in a problem with more. Its elements are its own: the remedies
// of a run are for faces.
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

// The translations of the pieces that gauge vertices stand for, 2 each, and which of them rows
// rule out: by Gaussian elimination of few columns.
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

  // The unknowns that stop the translations that are left, at their values in x.
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
  std::vector<Index> piece_of_;  // by node, -1: cannot move anyway
  std::vector<char> ruled_out_;
  std::vector<std::pair<Index, Vec>> rows_;  // 1 at their pivots
};

}  // namespace

DomainProblem PlainDomain::build(const DomainInput& in, VecIn) {
  ProblemBuilder builder = map_builder(in.map, *in.space);
  EnergyIds energies = add_map(builder, in.map, in.space, in.start, in.terms);
  builder.add(in.injectivity);
  std::vector<TermId> barriers = in.added.add_to(builder);
  builder.add(in.added.gauge(in.map, *in.space, in.start));
  return {{builder.build(), std::move(energies)}, std::move(barriers)};
}

ScaffoldedDomain::ScaffoldedDomain(const BezierMap& start, ScaffoldFlips flips,
                                   const SolverRules& rules)
    : scaffold_([&] {
        const AddedSeconds time(seconds_);
        return Scaffold(start.shared_space(), start.control_points());
      }()),
      mode_(flips),
      rules_(rules.scaffold),
      relaxing_(newton_options(Curvature::Projected, rules, {}, ScaffoldedDomain::ordering())),
      share_(rules_.share) {
  const std::shared_ptr<LinearSolver> solver = make_direct_solver(ScaffoldedDomain::ordering());
  relaxing_.linear_solver = [solver] { return std::make_unique<KeptSolver>(solver); };
}

DomainProblem ScaffoldedDomain::build(const DomainInput& in, VecIn x) {
  const AddedSeconds time(seconds_);
  ProblemBuilder builder(2 * scaffold_.joint_node_count());
  EnergyIds energies = add_map(builder, in.map, in.space, in.start, in.terms);
  TermState around;
  around.element_rule = scaffold_.levels();
  around_ = builder.add(scaffold_.energy_term(), around);
  builder.add(std::make_shared<const ScaffoldInjectivity>(
      in.injectivity, in.space->element_count(),
      std::make_shared<const LocalInjectivity>(scaffold_.space(), Vec::Ones(scaffold_.face_count()),
                                               depth(in), in.stop)));
  std::vector<TermId> barriers = in.added.add_to(builder);
  builder.add(FixedPoints::at(scaffold_.frame_nodes(), x));
  lambda_.reset();
  built_ = built_ ? builder.build(*built_) : builder.build();
  return {{*built_, std::move(energies)}, std::move(barriers)};
}

TermChanges ScaffoldedDomain::before_step(const MapProblem& built, VecIn x) {
  const AddedSeconds time(seconds_);
  double mean = 0;
  for (const TermId id : built.energies) mean += term_energy(built.problem, id, x);
  TermState around = built.problem.state(*around_);
  const double share = stage_ == Stage::AtRest ? rules_.share_at_rest : share_;
  const double lambda = share * std::max(mean, rules_.least_energy) * around.weight /
                        term_energy(built.problem, *around_, x);
  if (lambda_ && std::abs(lambda - *lambda_) <= rules_.same_lambda * lambda) return {};
  lambda_ = lambda;
  around.weight = lambda;
  around.element_rule = scaffold_.levels();
  return {{*around_, std::move(around)}};
}

double ScaffoldedDomain::foreign_energy(const Problem& problem, VecIn x) const {
  return term_energy(problem, *around_, x);
}

// The scaffold is enlarged, flipped and relaxed.
DomainChange ScaffoldedDomain::after_step(Vec& x, const StepResult& step, const DomainInput& in) {
  const AddedSeconds time(seconds_);
  scaffold_.take(x);
  if (refine(step.blocking, in.space->element_count())) lambda_.reset();
  if (rests(step)) stage_ = Stage::AtRest;
  const bool grown = scaffold_.grow();
  FlipCounts counts = flip();
  const bool relaxed = grown || needs_relaxing(step.record, counts);
  if (relaxed) {
    NewtonOptions options = relaxing_;
    options.stop = in.stop;
    scaffold_.relax(rules_.relax_steps, depth(in), options);
    const FlipCounts more = flip();
    counts.intended += more.intended;
    counts.performed += more.performed;
  }
  flips_.intended += counts.intended;
  flips_.performed += counts.performed;
  x = scaffold_.joined(x);
  if (grown || counts.performed > 0) return DomainChange::Structure;
  return relaxed ? DomainChange::Values : DomainChange::None;
}

// A step moves all nodes, the scaffold's as well: that keeps it in shape, as long as it has room.
bool ScaffoldedDomain::needs_relaxing(const IterationRecord& step, const FlipCounts& flips) const {
  return step.step_bound < rules_.short_bound ||
         (flips.performed > 0 && step.relative_decrease < rules_.still_moving);
}

// Not while a stronger scaffold is followed: that is for leaving places where the image rests.
bool ScaffoldedDomain::rests(const StepResult& step) const {
  return stage_ == Stage::Moving && share_ == rules_.share &&
         step.outcome == StepResult::Outcome::Moved &&
         step.record.step_bound >= rules_.short_bound &&
         step.record.relative_decrease < rules_.at_rest;
}

// Scaffold faces that block a step get a finer quadrature rule: theirs does not see the barrier.
bool ScaffoldedDomain::refine(const std::vector<Index>& blocking, Index map_faces) {
  std::vector<Index> faces;
  for (const Index e : blocking)
    if (e >= map_faces) faces.push_back(e - map_faces);
  scaffold_.refine(faces);
  return !faces.empty();
}

int ScaffoldedDomain::depth(const DomainInput& in) const {
  return std::max(in.depth, rules_.depth);
}

FlipCounts ScaffoldedDomain::flip() {
  return mode_ == ScaffoldFlips::Performed ? scaffold_.flip() : FlipCounts{};
}

bool ScaffoldedDomain::strengthen(double weight) {
  const double share = std::max(rules_.share, weight);
  lambda_.reset();
  if (stage_ == Stage::AtRest) stage_ = Stage::Moving;
  return std::exchange(share_, share) != share;
}

bool ScaffoldedDomain::hold() {
  if (stage_ != Stage::AtRest) return false;
  stage_ = Stage::Held;
  return true;
}

StoppingRules ScaffoldedDomain::final_rules(StoppingRules usual) const {
  usual.relative_decrease *= rules_.part_of_tolerance;
  usual.tail_steps = rules_.tail_steps;
  // The decrement of the sum does not bound what is left of the map's energy, which lambda follows.
  usual.last_factor = std::numeric_limits<double>::infinity();
  return usual;
}

void ScaffoldedDomain::elevate(const std::shared_ptr<const BezierTriangleSpace>& higher) {
  const AddedSeconds time(seconds_);
  stage_ = Stage::Moving;
  scaffold_ = scaffold_.elevated(higher);
}

void ScaffoldedDomain::restore(const std::optional<Scaffold>& scaffold) {
  if (scaffold) scaffold_ = *scaffold;
}

UserTerms::UserTerms(std::shared_ptr<const MapExtension> extension)
    : extension_(std::move(extension)) {
  HeldBounds::Bounds bounds;
  for (const auto& checker : extension_->checkers())
    if (auto bound = std::dynamic_pointer_cast<const BarrierChecker>(checker))
      bounds.push_back(std::move(bound));
  bounds_ = HeldBounds(std::move(bounds));
}

std::vector<TermId> UserTerms::add_to(ProblemBuilder& builder) const {
  std::vector<TermId> barriers;
  if (!extension_) return barriers;
  const auto unknowns = static_cast<Index>(extension_->start().size());
  for (const auto& [term, weight] : extension_->terms()) builder.add(term, weight);
  for (const auto& constraint : extension_->constraints()) builder.add(*constraint);
  for (const auto& checker : extension_->checkers())
    if (!dynamic_cast<const BarrierChecker*>(checker.get()))
      builder.add(std::make_shared<const OnMap>(checker, unknowns));
  for (const auto& bound : bounds_.held())
    builder.add(std::make_shared<const OnMap>(bound, unknowns));
  for (const auto& barrier : bounds_.barriers())
    barriers.push_back(builder.add(barrier, barrier_weight_));
  return barriers;
}

FixedUnknowns UserTerms::gauge(const MapSpecification& spec, const BezierTriangleSpace& space,
                               VecIn start) const {
  const std::vector<Index> vertices = gauge_vertices(spec, space);
  Translations translations(space, vertices);
  if (extension_ && !vertices.empty()) {
    ConstraintRows rows;
    for (const auto& constraint : extension_->constraints()) constraint->append_rows(rows);
    translations.constrain(rows);
    for (const auto& added : extension_->terms()) translations.constrain(*added.term, start);
    for (const auto& barrier : bounds_.barriers()) translations.constrain(*barrier, start);
  }
  return FixedUnknowns(translations.stopped(start));
}

void UserTerms::require_curvature(Curvature asked) const {
  if (!extension_) return;
  const auto require = [asked](const EnergyTerm& term) {
    if (!term.supports(asked))
      throw InvalidArgument(
          fmt::format("term '{}' has no curvature model '{}'", term.name(), curvature_name(asked)));
  };
  for (const auto& added : extension_->terms()) require(*added.term);
  for (const auto& bound : bounds_.bounds()) require(*bound->barrier());
}

double UserTerms::energy(VecIn x) const {
  double sum = 0;
  if (extension_)
    for (const auto& [term, weight] : extension_->terms())
      sum += weight * values_of(*term, x).sum();
  return sum;
}

Vec UserTerms::of_map(VecIn x) const {
  return extension_ ? x.head(extension_->start().size()) : Vec(x);
}

double UserTerms::barrier_size(VecIn x) const {
  double sum = 0;
  for (const auto& barrier : bounds_.barriers()) sum += values_of(*barrier, x).cwiseAbs().sum();
  return sum;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
