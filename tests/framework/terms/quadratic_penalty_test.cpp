// Soft linear constraints: derivatives, elimination beside them, handles.
#include "majorant/framework/terms/quadratic_penalty.h"

#include <gtest/gtest.h>

#include "energies/density_fixture.h"
#include "majorant/constraints/constraints.h"
#include "majorant/framework/energy_term.h"
#include "majorant/framework/error.h"
#include "majorant/framework/newton.h"
#include "majorant/maps/map_problem.h"

namespace majorant {
namespace {

struct Row {
  std::vector<std::pair<Index, long>> entries;
  double rhs;
};

class Rows final : public Constraint {
 public:
  explicit Rows(std::vector<Row> rows) : rows_(std::move(rows)) {}
  void append_rows(ConstraintRows& out) const override {
    for (const Row& row : rows_) {
      out.begin_row("row");
      for (const auto& [unknown, coefficient] : row.entries) out.add(unknown, coefficient);
      out.end_row(row.rhs);
    }
  }

 private:
  std::vector<Row> rows_;
};

// Returns rows of 1 to 4 entries, with negative coefficients, a repeated unknown, two equal rows.
std::vector<Row> mixed_rows() {
  return {{{{0, 1}}, 0.5},
          {{{1, 2}, {4, -3}}, -1},
          {{{2, 1}, {2, 2}, {5, 1}}, 2},
          {{{0, 1}, {3, -1}, {5, 4}, {1, -2}}, 0},
          {{{6, 5}}, 3},
          {{{6, 5}}, 3},
          {{{7, 1}, {7, -1}, {4, 1}}, 0.25}};
}

double direct(const std::vector<Row>& rows, const Vec& x) {
  double sum = 0;
  for (const Row& row : rows) {
    double r = -row.rhs;
    for (const auto& [unknown, coefficient] : row.entries) r += double(coefficient) * x[unknown];
    sum += r * r;
  }
  return sum;
}

Eigen::MatrixXd dense(const SparsePattern& p, const Vec& values) {
  Eigen::MatrixXd h = Eigen::MatrixXd::Zero(p.size, p.size);
  for (Index c = 0; c < p.size; ++c)
    for (Index k = p.column_starts[static_cast<std::size_t>(c)];
         k < p.column_starts[static_cast<std::size_t>(c) + 1]; ++k)
      h(p.rows[static_cast<std::size_t>(k)], c) = h(c, p.rows[static_cast<std::size_t>(k)]) =
          values[k];
  return h;
}

TEST(QuadraticPenalty, ValueGradientAndHessianAreThoseOfTheRows) {
  const std::vector<Row> rows = mixed_rows();
  const Problem problem =
      ProblemBuilder(8).add(std::make_shared<QuadraticPenalty>(Rows(rows)), 0.7).build();
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(static_cast<Index>(rows.size()), 8);
  Vec b(a.rows());
  for (Index r = 0; r < a.rows(); ++r) {
    const Row& row = rows[static_cast<std::size_t>(r)];
    b[r] = row.rhs;
    for (const auto& [unknown, coefficient] : row.entries) a(r, unknown) += double(coefficient);
  }
  Evaluator evaluator(problem);
  test::Random random(1);
  for (const Curvature c : kCurvatures) {
    ASSERT_TRUE(problem.supports(c));
    const Vec x = random.vector(8, -3, 3);
    Vec g, values;
    const double f = evaluator.linearize(x, c, g, values), expected = 0.7 * direct(rows, x);
    EXPECT_NEAR(f, expected, 1e-13 * expected);
    EXPECT_NEAR(evaluator.value(x), expected, 1e-13 * expected);
    EXPECT_LE((g - 1.4 * a.transpose() * (a * x - b)).norm(), 1e-12 * g.norm());
    EXPECT_LE((dense(problem.pattern(), values) - 1.4 * a.transpose() * a).norm(), 1e-12);
  }
}

// All rows are tested together. Short rows are padded with one of their unknowns, and one row
// repeats an unknown. Derivatives by a repeated unknown are sums over its places.
TEST(QuadraticPenalty, PassesTheDerivativeCheck) {
  const QuadraticPenalty penalty{Rows(mixed_rows())};
  const auto report = check_derivatives(penalty, test::Random(2).vector(8), 1e-7);
  EXPECT_TRUE(report.ok()) << report.message();
}

// Rows keep their weights in the given order.
TEST(QuadraticPenalty, RowWeights) {
  const std::vector<Row> rows = mixed_rows();
  TermState state;
  state.weight = 2;
  state.element_weight.setLinSpaced(static_cast<Index>(rows.size()), 1, 7);
  const Problem problem =
      ProblemBuilder(8).add(std::make_shared<QuadraticPenalty>(Rows(rows)), state).build();
  const Vec x = test::Random(5).vector(8);
  double expected = 0;
  for (std::size_t r = 0; r < rows.size(); ++r)
    expected += 2 * state.element_weight[static_cast<Index>(r)] * direct({rows[r]}, x);
  EXPECT_NEAR(Evaluator(problem).value(x), expected, 1e-13 * expected);
}

// With the hard constraints x0 = 1 and x1 = x2, the reduced problem's derivatives are those of
// x = Z y + c.
TEST(QuadraticPenalty, WithElimination) {
  const std::vector<Row> rows = mixed_rows();
  ProblemBuilder builder(8);
  builder.add(std::make_shared<QuadraticPenalty>(Rows(rows)), 1);
  builder.add(Rows({{{{0, 1}}, 1}, {{{1, 1}, {2, -1}}, 0}, {{{3, 1}, {4, 1}, {5, 1}}, 6}}));
  const Problem problem = builder.build();
  ASSERT_EQ(problem.size(), 5);
  Evaluator evaluator(problem);
  const Vec y = test::Random(8).vector(5);
  Vec g, values;
  const double f = evaluator.linearize(y, Curvature::Exact, g, values);
  EXPECT_NEAR(f, direct(rows, problem.expand(y)), 1e-13 * f);
  const Eigen::MatrixXd h = dense(problem.pattern(), values);
  // A quadratic is its own Taylor polynomial.
  for (int k = 0; k < 10; ++k) {
    const Vec d = test::Random(static_cast<unsigned>(k)).vector(5);
    EXPECT_NEAR(direct(rows, problem.expand(y + d)), f + g.dot(d) + 0.5 * d.dot(h * d), 1e-11 * f);
  }
  // One Newton step reaches its minimum.
  NewtonOptions options;
  options.curvature = Curvature::Exact;
  const SolveResult r = NewtonMinimizer(options).minimize(problem, y, {});
  EXPECT_EQ(r.status, Status::Converged) << r.message;
  EXPECT_LE(r.iterations.size(), 2U);
  evaluator.linearize(r.y, Curvature::Exact, g, values);
  // The Hessian is singular: its shift, 1e-9 of the mean diagonal, leaves this error.
  EXPECT_LE(g.norm(), 1e-8 * f);
}

TEST(QuadraticPenalty, Refusals) {
  EXPECT_THROW(QuadraticPenalty(Rows({{{}, 1}})), InvalidArgument);
  EXPECT_THROW(QuadraticPenalty(Rows({{{{0, 1}}, 1}, {{}, 0}})), InvalidArgument);
  EXPECT_NO_THROW(QuadraticPenalty(FixedPoints({{3, Vector2(1, 2)}})));
  // A row with an invalid unknown is detected when the problem is built.
  EXPECT_THROW(
      ProblemBuilder(4).add(std::make_shared<QuadraticPenalty>(Rows({{{{4, 1}}, 0}})), 1).build(),
      InvalidArgument);
}

// Without rows the energy is 0.
// Real coefficients: a point inside a triangle pulled to a place.
TEST(QuadraticPenalty, AnyLinearExpression) {
  const QuadraticPenalty penalty(
      std::vector<LinearExpression>{{{{0, 0.2}, {1, 0.3}, {2, 0.5}}, 1.5}, {{{2, -0.25}}, 0.0}});
  Vec x(3);
  x << 1, -2, 4;
  Workspace workspace;
  const Index rows[] = {0, 1};
  double f[2];
  penalty.values(x, ElementBatch{0, rows}, {}, workspace, f);
  EXPECT_NEAR(f[0], (0.2 - 0.6 + 2.0 - 1.5) * (0.2 - 0.6 + 2.0 - 1.5), 1e-15);
  EXPECT_NEAR(f[1], 1.0, 1e-15);
  EXPECT_TRUE(check_derivatives(penalty, x).ok());
  LinearExpression longest;
  for (Index k = 0; k < 513; ++k) longest.terms.emplace_back(k, 1.0);
  EXPECT_THROW(QuadraticPenalty(std::vector<LinearExpression>{longest}), InvalidArgument);
  EXPECT_THROW(QuadraticPenalty(std::vector<LinearExpression>{{{}, 1.0}}), InvalidArgument);
}

TEST(QuadraticPenalty, NothingToPullAt) {
  const auto empty = std::make_shared<QuadraticPenalty>(Rows({}));
  EXPECT_EQ(empty->element_dofs().element_count(), 0);
  const Problem problem = ProblemBuilder(2)
                              .add(empty, 1)
                              .add(std::make_shared<QuadraticPenalty>(Rows({{{{0, 1}}, 2}})), 1)
                              .build();
  EXPECT_EQ(Evaluator(problem).value(Vec::Zero(2)), 4);
}

// ---- Soft handles ----

// Returns the distance of two handles from their targets, for each weight.
std::vector<double> distances(const std::vector<double>& weights) {
  const test::Mesh mesh = test::grid(4, 4, 0.2, 0.2);
  const auto space = std::make_shared<const BezierTriangleSpace>(mesh.faces, 25, 2);
  MapSpecification spec;
  spec.rest = std::make_shared<const RestShapes>(flat_triangles(mesh.positions, mesh.faces));
  spec.energy = {{symmetric_dirichlet(), 1.0}};
  const Vec start = test::linear_map(*space, test::flat(mesh.positions));
  spec.handles = {{6, Vector2(start.segment<2>(12)) + Vector2(-0.3, -0.2)},
                  {18, Vector2(start.segment<2>(36)) + Vector2(0.4, 0.1)}};
  std::vector<double> out;
  for (const double weight : weights) {
    spec.handle_weight = weight;
    const auto terms = energy_terms(spec, space, {radon_rule()});
    const Problem problem =
        map_problem(spec, space, start, terms,
                    std::make_shared<const LocalInjectivity>(space, 2 * spec.rest->measure))
            .problem;
    EXPECT_EQ(problem.terms().size(), 2U);
    EXPECT_EQ(problem.size(), 2 * space->node_count());  // handles fix the gauge
    NewtonOptions options;
    options.stopping.relative_decrease = 1e-14;
    const SolveResult r = NewtonMinimizer(options).minimize(problem, problem.reduce(start), {});
    EXPECT_EQ(r.status, Status::Converged) << r.message;
    const Vec x = problem.expand(r.y);
    double distance = 0;
    for (const FixedPoint& h : spec.handles)
      distance = std::max(distance, (x.segment<2>(2 * h.node) - h.position).norm());
    out.push_back(distance);
  }
  return out;
}

TEST(SoftHandles, DistanceFallsLikeOneOverTheWeight) {
  const std::vector<double> d = distances({1e1, 1e2, 1e3, 1e4, 1e5});
  for (std::size_t k = 0; k + 1 < d.size(); ++k) EXPECT_LT(d[k + 1], d[k]);
  EXPECT_GT(d[0], 1e-3);  // otherwise the handles have no effect
  for (std::size_t k = 2; k + 1 < d.size(); ++k) EXPECT_NEAR(d[k] / d[k + 1], 10, 0.3) << k;
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
