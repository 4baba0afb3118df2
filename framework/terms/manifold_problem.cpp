#include "majorant/framework/terms/manifold_problem.h"

#include <fmt/format.h>

#include <utility>

#include "majorant/framework/argument_check.h"
#include "majorant/framework/error.h"
#include "majorant/framework/terms/internal/manifold_chart.h"
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
  return {Vec::Zero(points.base_count()), Vec::Zero(points.coordinate_count())};
}

}  // namespace

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
  ManifoldChart chart(points_, checkers_, points_->around(x0, coordinates));
  const Problem problem = chart.begun(problem_);
  NewtonStepper stepper(problem, options);
  ChartDescent descent(stepper, chart, observer);
  SolveResult& result = descent.result;
  result.y = problem.reduce(coordinates);
  if (check_start(stepper.evaluator(), result)) {
    descent.energy = result.energy;
    stepper.descend(descent, options.stopping);
    if (options.tests_minimum && result.status == Status::Converged && result.y.size() > 0)
      result.definite = stepper.definite_at(result.y);
    if (result.definite == Definite::No)
      result.message += ", at a saddle: the exact Hessian is indefinite there";
  }
  ManifoldResult found;
  found.x = chart.shown(problem, result.y);
  static_cast<SolveResult&>(found) = std::move(result);
  around(found.x, &found.y);
  return found;
}

ManifoldBarrierResult ManifoldProblem::minimize(const Vec& x0, const BarrierMinimizer& method,
                                                RunObserver* observer) const {
  Vec coordinates;
  ManifoldChart chart(points_, checkers_, points_->around(x0, coordinates));
  const Problem problem = chart.begun(problem_);
  ManifoldBarrierResult found;
  static_cast<BarrierResult&>(found) =
      method.run(problem, chart, problem.reduce(coordinates), observer);
  found.x = chart.shown(problem, found.y);
  const Problem there = around(found.x, &found.y);
  const ManifoldPoints::Chart last = points_->around(found.x, coordinates);
  for (auto& [id, change] : found.states)
    change.parameters = dynamic_cast<const ManifoldTerm&>(there.term(id))
                            .parameters_on(last, {.parameters = change.parameters.value_or(Vec())});
  return found;
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
  parts_.push_back({std::move(term), std::move(state)});
  return static_cast<TermId>(parts_.size() - 1);
}

ManifoldProblemBuilder& ManifoldProblemBuilder::add(const Constraint& constraint) {
  constraint.append_rows(rows_);
  rows_.require_ended();
  return *this;
}

ManifoldProblemBuilder& ManifoldProblemBuilder::add(
    std::shared_ptr<const FeasibilityChecker> checker) {
  require_given("ManifoldProblemBuilder::add: the checker", checker);
  checkers_.push_back(std::move(checker));
  return *this;
}

ManifoldProblem ManifoldProblemBuilder::build() const {
  std::vector<ManifoldPoints::Point> all;
  for (const Place& place : places_) all.push_back({place.manifold, place.unknowns});
  auto points = std::make_shared<const ManifoldPoints>(full_size_, std::move(all));
  const ManifoldPoints::Chart chart = some_chart(*points);
  ProblemBuilder builder(points->coordinate_count());
  for (const Part& part : parts_) {
    ProblemBuilder(full_size_).add(part.term, part.state);  // says what is wrong with the term
    auto term = ManifoldTerm::make(part.term, points, chart);
    TermState state = part.state;
    state.parameters = term->parameters_on(chart, part.state);
    builder.add(std::move(term), std::move(state));
  }
  builder.add(RowsOfCoordinates(rows_, *points));
  return {builder.build(), checkers_, std::move(points)};
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
