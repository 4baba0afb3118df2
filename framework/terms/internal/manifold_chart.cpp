#include "majorant/framework/terms/internal/manifold_chart.h"

#include <utility>

#include "majorant/framework/terms/internal/manifold_term.h"

namespace majorant {
namespace {

using SharedChart = std::shared_ptr<const ManifoldPoints::Chart>;

// A checker of x as one of the coordinates. Paths of points on manifolds are curved: certified is
// the chord to the end of the step, which is the path of all other unknowns.
class ManifoldChecker final : public FeasibilityChecker {
 public:
  ManifoldChecker(std::shared_ptr<const FeasibilityChecker> checker,
                  std::shared_ptr<const ManifoldPoints> points, SharedChart chart)
      : checker_(std::move(checker)), points_(std::move(points)), chart_(std::move(chart)) {}

  std::string_view name() const override { return checker_->name(); }
  Verdict check(VecIn coordinates) const override {
    return checker_->check(points_->expand(*chart_, coordinates));
  }
  StepBound max_step(VecIn coordinates, VecIn d, double s) const override {
    if (!(s > 0)) return {s, {}};
    const Vec x = points_->expand(*chart_, coordinates);
    Vec chord = (points_->expand(*chart_, coordinates + s * d) - x) / s;
    for (Index i = 0; i < x.size(); ++i)
      if (points_->point_of(i) < 0) chord[i] = d[points_->coordinate_of(i)];
    return checker_->max_step(x, chord, s);
  }

 private:
  std::shared_ptr<const FeasibilityChecker> checker_;
  std::shared_ptr<const ManifoldPoints> points_;
  SharedChart chart_;
};

}  // namespace

TermChanges on_chart(const Problem& problem, const ManifoldPoints::Chart& chart) {
  TermChanges changes;
  for (const TermId id : problem.terms()) {
    const auto& term = dynamic_cast<const ManifoldTerm&>(problem.term(id));
    changes.emplace_back(id,
                         TermChange{.parameters = term.parameters_on(chart, problem.state(id))});
  }
  return changes;
}

ManifoldChart::ManifoldChart(std::shared_ptr<const ManifoldPoints> points, Checkers checkers,
                             ManifoldPoints::Chart chart)
    : points_(std::move(points)),
      checkers_(std::move(checkers)),
      chart_(std::make_shared<ManifoldPoints::Chart>(std::move(chart))) {}

Problem ManifoldChart::begun(const Problem& problem) const {
  return on(checkers_.empty() ? problem : exchanged(problem, {}, checkers_));
}

Vec ManifoldChart::expand(VecIn coordinates) const { return points_->expand(*chart_, coordinates); }

Vec ManifoldChart::shown(const Problem& problem, const Vec& y) const {
  return expand(problem.expand(y));
}

Problem ManifoldChart::on(const Problem& problem) const {
  return problem.with(on_chart(problem, *chart_));
}

Problem ManifoldChart::exchanged(const Problem& problem, const Terms& terms,
                                 Checkers checkers) const {
  Terms moving;
  TermChanges own;  // parameters of what is replaced say nothing of what replaces it
  for (const auto& [id, term] : terms) {
    moving.emplace_back(id, ManifoldTerm::make(term, points_, *chart_));
    own.emplace_back(id, TermChange{.parameters = Vec()});
  }
  return problem.with(std::move(own)).exchanged(moving, of_coordinates(std::move(checkers)));
}

Problem ManifoldChart::fixed(const Problem& problem) const {
  Terms terms;
  TermChanges none, own;
  for (const TermId id : problem.terms()) {
    const auto& term = dynamic_cast<const ManifoldTerm&>(problem.term(id));
    terms.emplace_back(id, term.fixed(*chart_));
    none.emplace_back(id, TermChange{.parameters = Vec()});
    own.emplace_back(id, TermChange{.parameters = term.own_parameters(problem.state(id))});
  }
  return problem.with(std::move(none))
      .exchanged(terms, of_coordinates(checkers_))
      .with(std::move(own));
}

MovingChart::Checkers ManifoldChart::of_coordinates(Checkers checkers) const {
  for (auto& checker : checkers)
    checker = std::make_shared<const ManifoldChecker>(std::move(checker), points_, chart_);
  return checkers;
}

void ManifoldChart::move(Evaluator& evaluator, const Vec& y) {
  return_to(evaluator, y, shown(evaluator.problem(), y));
}

void ManifoldChart::return_to(Evaluator& evaluator, const Vec& y, const Vec& x) {
  const Problem& problem = evaluator.problem();
  *chart_ = points_->around(x, problem.expand(y));
  evaluator.reset(on(problem));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
