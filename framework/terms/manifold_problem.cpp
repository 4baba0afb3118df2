#include "majorant/framework/terms/manifold_problem.h"

#include <fmt/format.h>

#include <utility>

#include "majorant/framework/argument_check.h"
#include "majorant/framework/equality_term.h"
#include "majorant/framework/error.h"
#include "majorant/framework/terms/internal/manifold_points.h"
#include "majorant/framework/terms/internal/manifold_term.h"

namespace majorant {
namespace {

// The rows for the coordinates of unknowns on no manifold.
class RowsOfCoordinates final : public Constraint {
 public:
  RowsOfCoordinates(const ConstraintRows& rows, const ManifoldPoints& points)
      : rows_(rows), points_(points) {}

  void append_rows(ConstraintRows& rows) const override {
    for (Index k = 0; k < rows_.auxiliary_count(); ++k) rows.add_auxiliary();
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      rows.begin_row(rows_.label(r));
      for (const auto* entry = rows_.begin(r); entry != rows_.end(r); ++entry)
        rows.add(entry->unknown < 0 ? entry->unknown : coordinate_of(entry->unknown, r),
                 entry->coefficient);
      rows.end_row(rows_.rhs(r));
    }
  }

 private:
  Index coordinate_of(Index unknown, std::size_t row) const {
    require_index("ManifoldProblem: an unknown of constraint row '" + rows_.label(row) + "'",
                  unknown, points_.unknown_count());
    const Index point = points_.point_of(unknown);
    if (point >= 0)
      throw Error(ErrorKind::Unsupported,
                  fmt::format("constraint row '{}' holds unknown {}, which lies on a {}: linear "
                              "constraints are for unknowns on no manifold",
                              rows_.label(row), unknown,
                              points_.points()[to_size(point)].manifold->name()));
    return points_.coordinate_of(unknown);
  }

  const ConstraintRows& rows_;
  const ManifoldPoints& points_;
};

// Returns an arbitrary chart, for building a problem that is not evaluated.
ManifoldPoints::Chart some_chart(const ManifoldPoints& points) {
  Index bases = 0;
  for (const auto& point : points.points()) bases += point.manifold->size();
  return {Vec::Zero(bases), Vec::Zero(points.coordinate_count())};
}

TermChanges on_chart(const Problem& problem, const ManifoldPoints::Chart& chart) {
  TermChanges changes;
  for (const TermId id : problem.terms()) {
    const auto& term = dynamic_cast<const ManifoldTerm&>(problem.term(id));
    changes.emplace_back(id,
                         TermChange{.parameters = term.parameters_on(chart, problem.state(id))});
  }
  return changes;
}

}  // namespace

// Makes the end points of each step the bases of the next one.
class ManifoldProblem::Descent final : public majorant::Descent {
 public:
  Descent(NewtonStepper& stepper, const ManifoldPoints& points, ManifoldPoints::Chart chart,
          RunObserver* observer)
      : stepper_(stepper), points_(points), chart_(std::move(chart)), observer_(observer) {}

  Answer after_step(const StepResult& step) override {
    result.energy = energy;
    if (step.outcome != StepResult::Outcome::Moved) return {};
    enter(points_.moved(chart_, full()));
    return {observed(observer_, step.record, x())};
  }
  void set_fallback() override {
    majorant::Descent::set_fallback();
    fallback_ = chart_;
  }
  void return_to_fallback() override {
    majorant::Descent::return_to_fallback();
    enter(fallback_);
  }
  Vec x() const { return points_.expand(chart_, full()); }

 private:
  // Returns all coordinates, including those that constraints fix.
  Vec full() const { return stepper_.evaluator().problem().expand(result.y); }
  void enter(ManifoldPoints::Chart chart) {
    chart_ = std::move(chart);
    const Problem& problem = stepper_.evaluator().problem();
    stepper_.evaluator().reset(problem.with(on_chart(problem, chart_)));
  }

  NewtonStepper& stepper_;
  const ManifoldPoints& points_;
  ManifoldPoints::Chart chart_, fallback_;
  RunObserver* observer_;
};

Index ManifoldProblem::full_size() const { return points_->unknown_count(); }
Index ManifoldProblem::size() const { return problem_.size(); }

Problem ManifoldProblem::around(const Vec& x, Vec* y) const {
  Vec coordinates;
  const ManifoldPoints::Chart chart = points_->around(x, coordinates);
  Problem problem = problem_.with(on_chart(problem_, chart));
  if (y) *y = problem.reduce(coordinates);
  return problem;
}

Vec ManifoldProblem::expand(const Vec& base, VecIn y) const {
  Vec ignored;
  const ManifoldPoints::Chart chart = points_->around(base, ignored);
  return points_->expand(chart, problem_.expand(y));
}

ManifoldResult ManifoldProblem::minimize(const Vec& x0, const NewtonOptions& options,
                                         RunObserver* observer) const {
  Vec coordinates;
  ManifoldPoints::Chart chart = points_->around(x0, coordinates);
  const Problem problem = problem_.with(on_chart(problem_, chart));
  NewtonStepper stepper(problem, options);
  Descent descent(stepper, *points_, std::move(chart), observer);
  descent.result.y = problem.reduce(coordinates);
  const bool starts = check_start(stepper.evaluator(), descent.result);
  if (starts) {
    descent.energy = descent.result.energy;
    stepper.descend(descent, options.stopping);
    SolveResult& result = descent.result;
    if (options.tests_minimum && result.status == Status::Converged && result.y.size() > 0)
      result.definite = stepper.definite_at(result.y);
    if (result.definite == Definite::No)
      result.message += ", at a saddle: the exact Hessian is indefinite there";
  }
  ManifoldResult result;
  result.x = descent.x();
  static_cast<SolveResult&>(result) = std::move(descent.result);
  return result;
}

ManifoldProblemBuilder::ManifoldProblemBuilder(Index full_size) : full_size_(full_size) {}

ManifoldProblemBuilder& ManifoldProblemBuilder::on(std::shared_ptr<const Manifold> manifold,
                                                   const Cells& unknowns) {
  require_given("ManifoldProblemBuilder::on: the manifold", manifold);
  require_size("ManifoldProblemBuilder::on: a row of unknowns", unknowns.cols(), manifold->size());
  for (Index p = 0; p < unknowns.rows(); ++p)
    places_.push_back({manifold, {unknowns.row(p).begin(), unknowns.row(p).end()}});
  return *this;
}

TermId ManifoldProblemBuilder::add(std::shared_ptr<const EnergyTerm> term, double weight) {
  return add(std::move(term), TermState{.weight = weight});
}

TermId ManifoldProblemBuilder::add(std::shared_ptr<const EnergyTerm> term, TermState state) {
  require_given("ManifoldProblemBuilder::add: the term", term);
  if (dynamic_cast<const EqualityTerm*>(term.get()))
    throw Error(ErrorKind::Unsupported,
                fmt::format("equality '{}' beside manifolds: make the manifolds equalities, too",
                            term->name()));
  parts_.push_back({std::move(term), std::move(state)});
  return static_cast<TermId>(parts_.size() - 1);
}

ManifoldProblemBuilder& ManifoldProblemBuilder::add(const Constraint& constraint) {
  constraint.append_rows(rows_);
  rows_.require_ended();
  return *this;
}

ManifoldProblem ManifoldProblemBuilder::build() const {
  std::vector<ManifoldPoints::Point> all;
  for (const Place& place : places_) all.push_back({place.manifold, place.unknowns});
  auto points = std::make_shared<const ManifoldPoints>(full_size_, std::move(all));
  const ManifoldPoints::Chart chart = some_chart(*points);
  ProblemBuilder builder(points->coordinate_count());
  for (const Part& part : parts_) {
    ProblemBuilder(full_size_).add(part.term, part.state);  // throws if the term is invalid
    auto term = std::make_shared<const ManifoldTerm>(part.term, points, chart);
    TermState state = part.state;
    state.parameters = term->parameters_on(chart, part.state);
    builder.add(std::move(term), std::move(state));
  }
  builder.add(RowsOfCoordinates(rows_, *points));
  return {builder.build(), std::move(points)};
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
