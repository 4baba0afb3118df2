// Compares derivatives of solutions by the data of their problems with differences of whole solves,
// and covariances with dense inverses.
#include "majorant/framework/sensitivity.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <functional>
#include <string>

#include "framework/counting_solver.h"
#include "majorant/framework/argument_check.h"
#include "majorant/framework/barrier_minimizer.h"
#include "majorant/framework/hessian_factor.h"
#include "majorant/framework/newton.h"
#include "majorant/framework/terms/inequality.h"
#include "majorant/framework/terms/least_squares.h"
#include "majorant/framework/terms/local_term.h"
#include "random.h"

namespace majorant {
namespace {

using Change = Sensitivity::Change;

// The data of a problem, and the function that makes the problem.
struct Data {
  Vec right_hand_sides;
  double weight = 1;    // of the first term
  Vec element_weights;  // of the first term
  Vec parameters;       // of the first term
};

Data operator+(Data a, const std::pair<double, Data>& step) {
  const auto& [t, d] = step;
  a.right_hand_sides += t * d.right_hand_sides;
  a.weight += t * d.weight;
  a.element_weights += t * d.element_weights;
  a.parameters += t * d.parameters;
  return a;
}

struct Made {
  Problem problem;
  TermId first;
  Vec start;
};
using Maker = std::function<Made(const Data&)>;

SolveResult solved(const Made& made) {
  NewtonOptions options;
  options.stopping.relative_decrease = 1e-13;
  options.stopping.decrement = 1e-26;
  return NewtonMinimizer(options).minimize(made.problem, made.start, nullptr);
}

// Returns the derivative of x* along d by differences of four solutions, each with exact Newton
// steps.
Vec differences(const Maker& make, const Data& at, const Data& d) {
  const double h = 5e-4;
  const auto x = [&](double t) {
    const Made made = make(at + std::pair{t, d});
    const SolveResult r = solved(made);
    EXPECT_EQ(r.status, Status::Converged) << r.message;
    Vec y = r.y;
    for (int k = 0; k < 3; ++k) {
      const HessianFactor factor(made.problem, y);
      y -= factor.solve(factor.gradient());
    }
    return made.problem.expand(y);
  };
  return (8 * (x(h) - x(-h)) - (x(2 * h) - x(-2 * h))) / (12 * h);
}

void expect_derivatives(const Maker& make, const Data& at, unsigned seed, double tolerance = 1e-7) {
  test::Random random(seed);
  Data d{random.vector(at.right_hand_sides.size(), -1, 1), random.uniform(-1, 1),
         random.vector(at.element_weights.size(), -1, 1),
         random.vector(at.parameters.size(), -1, 1)};
  const Made made = make(at);
  const SolveResult r = solved(made);
  ASSERT_EQ(r.status, Status::Converged) << r.message;
  const Sensitivity s(made.problem, r);
  EXPECT_LT(s.error(), 1e-8);
  Change change;
  change.right_hand_sides = d.right_hand_sides;
  change.weights = {{made.first, d.weight}};
  if (d.element_weights.size() > 0) change.element_weights = {{made.first, d.element_weights}};
  if (d.parameters.size() > 0) change.parameters = {{made.first, d.parameters}};
  const Vec dx = s.forward(change), expected = differences(make, at, d);
  EXPECT_GT(expected.norm(), 0);
  EXPECT_LE((dx - expected).norm(), tolerance * expected.norm());
  const Vec slope = random.vector(dx.size(), -1, 1);
  const Sensitivity::Derivative back = s.adjoint(slope);
  double product = d.weight * back.weights[0];
  if (d.right_hand_sides.size() > 0) product += back.right_hand_sides.dot(d.right_hand_sides);
  if (d.element_weights.size() > 0) product += back.element_weights[0].dot(d.element_weights);
  if (d.parameters.size() > 0) product += back.parameters[0].dot(d.parameters);
  EXPECT_NEAR(product, slope.dot(dx), 1e-8 * slope.norm() * dx.norm());
}

// Returns a hanging net: stiff springs whose lengths are data, loads, fixed corners.
Maker net(Index n, bool rows) {
  return [=](const Data& data) {
    Cells edges(2 * n * (n - 1), 2);
    Index e = 0;
    for (Index k = 0; k < n * n; ++k) {
      if (k % n + 1 < n) edges.row(e++) << k, k + 1;
      if (k / n + 1 < n) edges.row(e++) << k, k + n;
    }
    const auto spring = [](const auto& z, double length) {
      const auto stretch = (z.col(1) - z.col(0)).squaredNorm() / (length * length) - 1.0;
      return stretch * stretch;
    };
    const auto term =
        rows ? make_term<2, 3>(
                   "net", edges,
                   [=](Index, const auto& z, const auto& l) { return spring(z, l[0]); },
                   RowMatrix(data.parameters))
             : make_term<2, 3>(
                   "net", edges,
                   [=](Index i, const auto& z, const auto& l) { return spring(z, l[i]); },
                   data.parameters);
    Vec load = Vec::Zero(3 * n * n), x(3 * n * n);
    for (Index k = 0; k < n * n; ++k) {
      load[3 * k + 2] = 0.05;
      x.segment<3>(3 * k) << k % n, k / n,
          -0.3 * std::sin(3.0 * (k % n) / (n - 1)) * (k / n + 1) / n;
    }
    ProblemBuilder builder(3 * n * n);
    const TermId id =
        builder.add(term, TermState{.weight = data.weight, .element_weight = data.element_weights});
    builder.add(linear_term("load", load), 1);
    std::vector<FixedUnknown> held;
    Index row = 0;
    for (const Index corner : {0, n - 1, n * (n - 1), n * n - 1})
      for (Index c = 0; c < 3; ++c, ++row)
        held.push_back({3 * corner + c, data.right_hand_sides[row]});
    builder.add(FixedUnknowns(held));
    const Problem problem = builder.build();
    return Made{problem, id, problem.reduce(problem.expand(problem.reduce(x)))};
  };
}

Data net_data(Index n) {
  const Index edges = 2 * n * (n - 1);
  Data data{Vec(12), 1.5, Vec::Ones(edges), Vec::Constant(edges, 1.1)};
  const double s = n - 1;
  data.right_hand_sides << 0, 0, 0, s, 0, 0, 0, s, 0, s, s, 0.2;
  return data;
}

TEST(Sensitivity, OfAHangingNetOfThreeSizes) {
  for (const Index n : {4, 7, 10})
    for (const bool rows : {false, true}) expect_derivatives(net(n, rows), net_data(n), 1);
}

// Rows of several unknowns, one of which depends on others.
TEST(Sensitivity, OfRowsThatDependOnEachOther) {
  class DependentRows final : public Constraint {
   public:
    explicit DependentRows(const Vec& b) : b_(b) {}
    void append_rows(ConstraintRows& rows) const override {
      const double entries[3][4] = {
          {1, 2, 0, -1}, {0, 1, 1, 3}, {1, 3, 1, 2}};  // the last row is the sum
      for (int r = 0; r < 3; ++r) {
        rows.begin_row("row " + std::to_string(r));
        for (int k = 0; k < 4; ++k)
          if (entries[r][k] != 0) rows.add(2 * k, entries[r][k]);
        rows.end_row(r < 2 ? b_[r] : b_[0] + b_[1]);
      }
    }

   private:
    Vec b_;
  };
  const Cells all = Vec::LinSpaced(8, 0, 7).cast<Index>().transpose();
  const auto make = [&](const Vec& b) {
    const auto term = make_term<8>("quartic", all, [](Index, const auto& z) {
      const auto s = z.squaredNorm();
      return s * s + s + z[0] * z[3] + 0.3 * z[2] - z[5];
    });
    return ProblemBuilder(8).add(term, 1).add(DependentRows(b)).build();
  };
  const Vec b{{1, -2}};
  const Problem problem = make(b);
  const SolveResult r = NewtonMinimizer().minimize(problem, Vec::Zero(problem.size()), nullptr);
  const Sensitivity s(problem, r);
  ASSERT_EQ(s.row_count(), 3);
  const Vec db{{0.3, 0.5, 0.8}};  // consistent
  const Vec dx = s.forward(Change{.right_hand_sides = db});
  const double h = 1e-3;
  const auto x = [&](double t) {
    const Problem p = make(b + t * db.head(2));
    Vec y = NewtonMinimizer().minimize(p, Vec::Zero(p.size()), nullptr).y;
    for (int k = 0; k < 3; ++k) {
      const HessianFactor factor(p, y);
      y -= factor.solve(factor.gradient());
    }
    return p.expand(y);
  };
  const Vec expected = (8 * (x(h) - x(-h)) - (x(2 * h) - x(-2 * h))) / (12 * h);
  EXPECT_LE((dx - expected).norm(), 1e-8 * expected.norm());
  const Vec slope = Vec::LinSpaced(8, -1, 1);
  EXPECT_NEAR(s.adjoint(slope).right_hand_sides.dot(db), slope.dot(dx), 1e-9);
  EXPECT_THROW(s.forward(Change{.right_hand_sides = Vec{{0, 0, 1}}}),
               Error);  // the rows contradict each other
}

// The last barrier counts as a term.
TEST(Sensitivity, OfAProblemWithBounds) {
  const Cells pairs =
      (Cells(9, 2) << 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 6, 7, 7, 8, 8, 9).finished();
  const auto make = [&](double pull) {
    const auto chain = make_term<2>(
        "chain", pairs,
        [](Index, const auto& z, const auto& p) {
          const auto d = z[1] - z[0] - p[0];
          return d * d + 0.1 * d * d * d * d;
        },
        Vec(Vec::Constant(1, pull)));
    ProblemBuilder builder(10);
    const TermId first = builder.add(chain, 1);
    const Bounds bounds(Vec::Constant(10, -0.5), Vec::Constant(10, 2));
    const TermId wall = builder.add(bounds.barrier(), 1);
    builder.add(bounds.checker());
    builder.add(FixedUnknowns({{0, 0.0}}));
    struct Out {
      Problem problem;
      TermId first, wall;
    };
    return Out{builder.build(), first, wall};
  };
  const double h = 1e-4;
  const auto path = [&](double pull) {
    const auto made = make(pull);
    BarrierOptions options;
    options.tolerance = 1e-6;
    return BarrierMinimizer({made.wall}, options)
        .run(made.problem, made.problem.reduce(Vec::Constant(10, 0.1)), nullptr);
  };
  const auto made = make(0.4);
  const BarrierResult r = path(0.4);
  ASSERT_EQ(r.status, Status::Converged) << r.message;
  SolveResult end = r;
  end.blocking.clear();
  const Problem last = made.problem.with({{made.wall, {.weight = r.phases.back().mu}}});
  const Sensitivity s(last, end);
  const Vec dx = s.forward(Change{.parameters = {{made.first, Vec::Ones(1)}}});
  const auto at = [&](double pull) {
    const auto m = make(pull);
    const Problem p = m.problem.with({{m.wall, {.weight = r.phases.back().mu}}});
    Vec y = end.y;
    for (int k = 0; k < 8; ++k) {
      const HessianFactor factor(p, y);
      y -= factor.solve(factor.gradient());
    }
    return p.expand(y);
  };
  const Vec expected = (at(0.4 + h) - at(0.4 - h)) / (2 * h);
  EXPECT_LE((dx - expected).norm(), 1e-5 * expected.norm());
}

TEST(Sensitivity, HasTheLeastNormWithoutConstraints) {
  const Index n = 12;
  Cells pairs(n - 1, 2);
  for (Index e = 0; e < n - 1; ++e) pairs.row(e) << e, e + 1;
  const Vec lengths = Vec::LinSpaced(n - 1, 0.5, 1.5);
  const auto chain = make_term<2>(
      "chain", pairs,
      [](Index e, const auto& z, const auto& l) {
        const auto d = z[1] - z[0] - l[e];
        return d * d;
      },
      lengths);
  ProblemBuilder builder(n);
  const TermId id = builder.add(chain, 1);
  const Problem problem = builder.build();
  const SolveResult r = NewtonMinimizer().minimize(problem, Vec::LinSpaced(n, 0, n), nullptr);
  EXPECT_THROW(Sensitivity(problem, r), Error);
  SensitivityOptions options;
  options.null_space = [](const Problem& p, VecIn) -> Eigen::MatrixXd {
    return Eigen::MatrixXd::Ones(p.size(), 1);
  };
  const Sensitivity s(problem, r, options);
  const Vec dx = s.forward(Change{.parameters = {{id, Vec::Ones(n - 1)}}});
  const Vec expected = Vec::LinSpaced(n, -(n - 1) / 2.0, (n - 1) / 2.0);
  EXPECT_LE((dx - expected).norm(), 1e-8 * expected.norm());
}

// A gauge selects one of the derivatives, for any slope.
TEST(Sensitivity, KeepsAGauge) {
  const Index n = 6;
  Cells pairs(n - 1, 2);
  for (Index e = 0; e < n - 1; ++e) pairs.row(e) << e, e + 1;
  const auto chain = make_term<2>(
      "chain", pairs,
      [](Index e, const auto& z, const auto& l) {
        const auto d = z[1] - z[0] - l[e];
        return d * d;
      },
      Vec(Vec::Ones(n - 1)));
  ProblemBuilder builder(n);
  const TermId id = builder.add(chain, 1);
  const Problem problem = builder.build();
  const SolveResult r = NewtonMinimizer().minimize(problem, Vec::LinSpaced(n, 0, n), nullptr);
  SensitivityOptions options;
  options.null_space = [](const Problem& p, VecIn) -> Eigen::MatrixXd {
    return Eigen::MatrixXd::Ones(p.size(), 1);
  };
  options.gauge = [](const Problem& p, VecIn) -> Eigen::MatrixXd {
    return Eigen::MatrixXd::Identity(1, p.full_size());
  };
  const Sensitivity s(problem, r, options);
  const Vec change = Vec::LinSpaced(n - 1, 1, 2);
  const Vec dx = s.forward(Change{.parameters = {{id, change}}});
  EXPECT_NEAR(dx[0], 0, 1e-14);
  for (Index e = 0; e + 1 < n; ++e) EXPECT_NEAR(dx[e + 1] - dx[e], change[e], 1e-9);
  const Vec slope = Vec::Unit(n, n - 1);
  EXPECT_NEAR(s.adjoint(slope).parameters[0].dot(change), dx[n - 1], 1e-9);
  EXPECT_THROW(s.forward(Change{.gradient = Vec::Ones(n)}),
               Error);  // the gradient has a component along free motions
}

// A run that stopped early is continued by exact steps; if they are not allowed, the estimate has
// the distance.
TEST(Sensitivity, PolishesTheMinimumOrReportsTheError) {
  const Made made = net(6, true)(net_data(6));
  const SolveResult end = solved(made);
  SolveResult rough = end;
  rough.y += 1e-4 * test::Random(2).vector(end.y.size());
  const double distance = (rough.y - end.y).norm() / end.y.norm();
  SensitivityOptions none;
  none.polishing_steps = 0;
  const Sensitivity as_it_is(made.problem, rough, none), polished(made.problem, rough),
      exact(made.problem, end);
  EXPECT_NEAR(as_it_is.error(), distance, 0.1 * distance);
  EXPECT_LT(polished.error(), 1e-9);
  EXPECT_LE((polished.point() - exact.point()).norm(), 1e-9 * exact.point().norm());
  const Change change{.right_hand_sides = Vec::Ones(12)};
  EXPECT_LE((polished.forward(change) - exact.forward(change)).norm(),
            1e-8 * exact.forward(change).norm());
}

// The analysis of the run's solver is reused.
TEST(Sensitivity, TakesTheAnalysisOfTheRun) {
  const Made made = net(6, true)(net_data(6));
  const auto counts = std::make_shared<test::SolverCounts>();
  const auto solver = std::make_shared<test::CountingSolver>(make_direct_solver(), counts);
  NewtonOptions options;
  options.linear_solver = [&] { return solver; };
  const SolveResult usual = NewtonMinimizer(options).minimize(made.problem, made.start, nullptr);
  EXPECT_EQ(counts->analyses, 1);
  counts->factorizations = 0;
  SensitivityOptions same;
  same.analysed_solver = solver;
  const Sensitivity s(made.problem, usual, same);
  EXPECT_EQ(counts->analyses, 1);
  EXPECT_LE(counts->factorizations, 2);  // at the end of the run, and after steps with that factor
  const Change change{.right_hand_sides = Vec::Ones(12)};
  EXPECT_EQ(s.forward(change), Sensitivity(made.problem, usual).forward(change));
}

// The bias is the distance from the minimum without barrier.
TEST(Sensitivity, ReportsTheBiasOfBarriers) {
  const auto pull = make_term<1>("pull", Cells{{0}}, [](Index, const auto& z) {
    const auto d = z[0] - 3.0;
    return d * d;
  });
  ProblemBuilder builder(1);
  builder.add(pull, 1);
  const Bounds bound(Vec::Constant(1, -std::numeric_limits<double>::infinity()), Vec::Ones(1));
  const TermId wall = builder.add(bound.barrier(), 1e-4);
  const Problem problem = builder.build();
  NewtonOptions tight;
  tight.stopping.relative_decrease = 1e-14;
  const SolveResult r = NewtonMinimizer(tight).minimize(problem, Vec::Constant(1, 0.5), nullptr);
  const Sensitivity s(problem, r);
  EXPECT_NEAR(s.bias({wall}), 1 - r.y[0], 0.01 * (1 - r.y[0]));
  EXPECT_EQ(s.bias({}), 0);
}

TEST(Sensitivity, RefusesSolutionsThatAreNoFunctionOfTheData) {
  const auto saddle = make_term<2>(
      "saddle", (Cells(1, 2) << 0, 1).finished(),
      [](Index, const auto& z) { return z[0] * z[0] - z[1] * z[1] + z[1] * z[1] * z[1] * z[1]; });
  const Problem problem = ProblemBuilder(2).add(saddle, 1).build();
  const SolveResult r = NewtonMinimizer().minimize(problem, Vec{{1, 0}}, nullptr);
  EXPECT_THROW(Sensitivity(problem, r), Error);
  const SolveResult good = NewtonMinimizer().minimize(problem, Vec{{1, 0.4}}, nullptr);
  const Sensitivity s(problem, good);
  EXPECT_THROW(s.forward(Change{.right_hand_sides = Vec::Ones(1)}), InvalidArgument);
  EXPECT_THROW(s.forward(Change{.parameters = {{TermId(0), Vec::Ones(1)}}}), InvalidArgument);
  EXPECT_THROW(s.forward(Change{.weights = {{TermId(4), 1.0}}}), InvalidArgument);
  EXPECT_THROW(s.adjoint(Vec(Vec::Ones(3))), InvalidArgument);
  EXPECT_THROW(s.adjoint(Vec(Vec::Constant(2, std::nan("")))), InvalidArgument);
  SolveResult held = good;
  held.blocking = {3};
  EXPECT_THROW(Sensitivity(problem, held), Error);
  held = good;
  held.y = Vec::Ones(1);
  EXPECT_THROW(Sensitivity(problem, held), InvalidArgument);
  // Each element depends on two of the common numbers.
  const auto crossed = make_term<1>(
      "crossed", Cells::Zero(100, 1),
      [](Index e, const auto& z, const auto& p) {
        const auto d = z[0] - p[e] * p[(e + 1) % 100];
        return d * d;
      },
      Vec(Vec::LinSpaced(100, 1, 2)));
  const Problem many = ProblemBuilder(1).add(crossed, 1).build();
  const Sensitivity several(many, NewtonMinimizer().minimize(many, Vec::Zero(1), nullptr));
  EXPECT_THROW(several.adjoint(Vec(Vec::Ones(1))), Error);
  EXPECT_NO_THROW(several.forward(Change{.parameters = {{TermId(0), Vec::Ones(100)}}}));
}

TEST(Covariance, IsTheBlockOfTheInverse) {
  const Vec t = Vec::LinSpaced(30, 0, 2);
  const Cells unknowns = Cells::Ones(30, 1) * Eigen::RowVector4i(0, 1, 2, 3);
  const auto fit = make_least_squares<4>("fit", unknowns, [t](Index e, const auto& z) {
    using std::exp;
    return z[0] * exp(z[1] * t[e]) + z[2] * t[e] + z[3] - std::cos(3 * t[e]);
  });
  ProblemBuilder builder(4);
  builder.add(fit, 2.0);
  builder.add(FixedUnknowns({{3, 0.25}}));
  const Problem problem = builder.build();
  const SolveResult r = NewtonMinimizer().minimize(problem, Vec{{1, -1, 0.1}}, nullptr);
  ASSERT_EQ(r.status, Status::Converged) << r.message;
  const Vec x = problem.expand(r.y);
  Eigen::MatrixXd J(30, 3);
  for (Index e = 0; e < 30; ++e)
    J.row(e) << std::exp(x[1] * t[e]), x[0] * t[e] * std::exp(x[1] * t[e]), t[e];
  const Eigen::MatrixXd expected = (2.0 * J.transpose() * J).inverse();
  const Eigen::MatrixXd found = covariance(problem, r, {2, 0, 3});
  EXPECT_NEAR(found(0, 0), expected(2, 2), 1e-9 * expected(2, 2));
  EXPECT_NEAR(found(1, 1), expected(0, 0), 1e-9 * expected(0, 0));
  EXPECT_NEAR(found(0, 1), expected(2, 0), 1e-9 * std::abs(expected(2, 0)));
  EXPECT_EQ(found(2, 2), 0);
  EXPECT_EQ(found(0, 2), 0);
  EXPECT_THROW(covariance(problem, r, {4}), InvalidArgument);
  const auto flat = make_least_squares<2>("sum", (Cells(1, 2) << 0, 1).finished(),
                                          [](Index, const auto& z) { return z[0] + z[1] - 1.0; });
  const Problem open = ProblemBuilder(2).add(flat, 1).build();
  const SolveResult some = NewtonMinimizer().minimize(open, Vec::Zero(2), nullptr);
  EXPECT_THROW(covariance(open, some, {0}), Error);
  const auto square =
      make_term<1>("square", Cells::Zero(1, 1), [](Index, const auto& z) { return z[0] * z[0]; });
  const Problem other = ProblemBuilder(1).add(square, 1).build();
  EXPECT_THROW(covariance(other, NewtonMinimizer().minimize(other, Vec::Zero(1), nullptr), {0}),
               Error);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
