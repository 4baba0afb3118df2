// Unknowns on manifolds: retractions, terms, minima compared with eigenvectors, closed forms, and
// problems with equalities.
#include "majorant/framework/terms/manifold.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "majorant/framework/barrier_minimizer.h"
#include "majorant/framework/error.h"
#include "majorant/framework/terms/equality.h"
#include "majorant/framework/terms/inequality.h"
#include "majorant/framework/terms/internal/manifold_chart.h"
#include "majorant/framework/terms/least_squares.h"
#include "majorant/framework/terms/manifold_problem.h"
#include "majorant/framework/terms/manifold_sensitivity.h"
#include "random.h"

namespace majorant {
namespace {

Vec random_vector(Index size, unsigned seed) { return test::Random(seed).vector(size); }

Eigen::MatrixXd random_matrix(Index rows, Index columns, unsigned seed) {
  return random_vector(rows * columns, seed).reshaped(rows, columns);
}

Cells rows_of_unknowns(Index points, Index size) {
  Cells unknowns(points, size);
  for (Index p = 0; p < points; ++p)
    for (Index k = 0; k < size; ++k) unknowns(p, k) = size * p + k;
  return unknowns;
}

Cells one_node_each(Index count) {
  Cells nodes(count, 1);
  for (Index k = 0; k < count; ++k) nodes(k, 0) = k;
  return nodes;
}

// Returns a cylinder about the third axis, the example of manifold.h.
std::shared_ptr<const Manifold> cylinder() {
  return make_manifold<3, 2>(
      "cylinder",
      [](const Eigen::Vector3d& p) {
        Eigen::Matrix<double, 3, 2> basis;
        basis << -p[1], 0, p[0], 0, 0, 1;
        return basis;
      },
      [](const Eigen::Vector3d& p, const auto& v) {
        using std::sqrt;
        const auto x = v[0] + p[0], y = v[1] + p[1];
        const auto r = sqrt(x * x + y * y);
        std::remove_cvref_t<decltype(v)> q;
        q << x / r, y / r, v[2] + p[2];
        return q;
      });
}

std::vector<std::shared_ptr<const Manifold>> all_manifolds() {
  return {unit_sphere(2), unit_sphere(3),      unit_sphere(4),
          unit_sphere(9), rotation_matrices(), cylinder()};
}

Vec random_point(const Manifold& manifold, unsigned seed) {
  Vec x = random_vector(manifold.size(), seed);
  EXPECT_TRUE(manifold.project(x.data()));
  return x;
}

TEST(Manifold, RetractionsStayOnItAndHaveTheirDerivatives) {
  for (const auto& manifold : all_manifolds()) {
    const int n = manifold->size(), d = manifold->dimension();
    const Vec base = random_point(*manifold, 1);
    for (const double length : {0.0, 0.3, 2.0}) {
      const Vec t = length * random_vector(d, 2);
      const auto at = [&](const Vec& s, Vec* slopes = nullptr, Vec* bends = nullptr) {
        Vec x(n), first(n * d), second(n * d * (d + 1) / 2);
        manifold->retract(base.data(), s.data(), x.data(), slopes ? first.data() : nullptr,
                          bends ? second.data() : nullptr);
        if (slopes) *slopes = first;
        if (bends) *bends = second;
        return x;
      };
      Vec slopes, bends, again;
      const Vec x = at(t, &slopes, &bends);
      EXPECT_EQ(x, at(t, &again));
      EXPECT_EQ(slopes, again);
      if (length == 0) {
        EXPECT_LE((x - base).norm(), 1e-15) << manifold->name();
      }
      Vec projected = x;
      ASSERT_TRUE(manifold->project(projected.data()));
      EXPECT_LE((projected - x).norm(), 1e-14) << manifold->name();
      const double h = 1e-5;
      for (int a = 0; a < d; ++a) {
        Vec up_slopes, down_slopes;
        const Vec up = at(t + h * Vec::Unit(d, a), &up_slopes),
                  down = at(t - h * Vec::Unit(d, a), &down_slopes);
        for (int i = 0; i < n; ++i) {
          EXPECT_NEAR(slopes[i * d + a], (up[i] - down[i]) / (2 * h), 1e-9) << manifold->name();
          for (int b = 0; b <= a; ++b)
            EXPECT_NEAR(bends[i * d * (d + 1) / 2 + a * (a + 1) / 2 + b],
                        (up_slopes[i * d + b] - down_slopes[i * d + b]) / (2 * h), 1e-8)
                << manifold->name();
        }
      }
      if (length == 0) {  // a basis of the tangent space
        const Eigen::MatrixXd basis = Eigen::Map<const RowMatrix>(slopes.data(), n, d);
        EXPECT_GT(basis.jacobiSvd().singularValues().minCoeff(), 0.5) << manifold->name();
      }
    }
  }
}

TEST(Manifold, HasANearestPointOrReportsThatThereIsNone) {
  Vec zero = Vec::Zero(3), reflection(9);
  EXPECT_FALSE(unit_sphere(3)->project(zero.data()));
  reflection << 1, 0, 0, 0, 1, 0, 0, 0, -1;  // many rotations are equally near
  EXPECT_FALSE(rotation_matrices()->project(reflection.data()));
  Vec near = Vec{{2, 0.1, 0, 0, 1, 0, 0.3, 0, 0.5}};
  EXPECT_TRUE(rotation_matrices()->project(near.data()));
  const Eigen::Matrix3d R = Eigen::Map<Eigen::Matrix3d>(near.data());
  EXPECT_LE((R.transpose() * R - Eigen::Matrix3d::Identity()).norm(), 4e-15);
  EXPECT_NEAR(R.determinant(), 1, 4e-15);
  EXPECT_THROW(unit_sphere(1), InvalidArgument);
  for (const double size : {1e-300, 1e300}) {  // the squares are infinite or 0
    Vec far = size * Vec{{3, 0, -4}};
    EXPECT_TRUE(unit_sphere(3)->project(far.data()));
    EXPECT_LE((far - Vec{{0.6, 0, -0.8}}).norm(), 1e-15);
  }
}

// The minimum of x.A x on a sphere is the least eigenvalue; saddles are the others.
TEST(ManifoldProblem, TheLeastEigenvalueIsAMinimumOnASphere) {
  constexpr int n = 6;
  const Eigen::MatrixXd half = random_matrix(n, n, 3);
  const Eigen::Matrix<double, n, n> A = half + half.transpose();
  ManifoldProblemBuilder builder(n);
  builder.on(unit_sphere(n), rows_of_unknowns(1, n));
  builder.add(
      make_term<1, n>("form", one_node_each(1),
                      [A](Index, const auto& z) { return z.col(0).dot((A * z.col(0)).eval()); }),
      1.0);
  const ManifoldProblem problem = builder.build();
  EXPECT_EQ(problem.full_size(), n);
  EXPECT_EQ(problem.size(), n - 1);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(A);
  for (const double projection : {0.0, 1.0, 2.0}) {
    NewtonOptions options;
    options.projection = projection;
    const ManifoldResult result = problem.minimize(random_vector(n, 4), options);
    EXPECT_EQ(result.status, Status::Converged) << result.message;
    EXPECT_EQ(result.definite, Definite::Yes);
    EXPECT_NEAR(result.energy, eigen.eigenvalues()[0], 1e-13);
    EXPECT_NEAR(std::abs(result.x.dot(eigen.eigenvectors().col(0))), 1, 1e-12);
    EXPECT_NEAR(result.x.norm(), 1, 1e-15);
    EXPECT_LE(result.iterations.size(), 25u);
  }
  const ManifoldResult saddle = problem.minimize(Vec(eigen.eigenvectors().col(2)));
  EXPECT_EQ(saddle.definite, Definite::No);
  EXPECT_NE(saddle.message.find("saddle"), std::string::npos);
}

// Points on three manifolds and a free point, in one term each and in a term of all.
struct Mixture {
  ManifoldProblem problem;
  Vec start;
};

Mixture mixture() {
  // 0-2: direction, 3-11: rotation, 12-15: quaternion, 16-18: point of the cylinder, 19-21: free
  ManifoldProblemBuilder builder(22);
  builder.on(unit_sphere(3), Cells{{0, 1, 2}});
  builder.on(rotation_matrices(), Cells{{3, 4, 5, 6, 7, 8, 9, 10, 11}});
  builder.on(unit_sphere(4), Cells{{12, 13, 14, 15}});
  builder.on(cylinder(), Cells{{16, 17, 18}});
  Cells turned(1, 15);
  for (Index k = 0; k < 12; ++k) turned(0, k) = k;
  for (Index k = 12; k < 15; ++k) turned(0, k) = 7 + k;
  builder.add(make_term<15>("turned", turned,
                            [](Index, const auto& z) {
                              const Eigen::Vector3d to(0.2, -0.5, 1.3);
                              auto sum = 0.0 * z[0];
                              for (int i = 0; i < 3; ++i) {
                                auto r = z[12 + i] - to[i];
                                for (int k = 0; k < 3; ++k) r = r + z[3 + 3 * i + k] * z[k];
                                sum = sum + r * r;
                              }
                              return sum;
                            }),
              1.0);
  builder.add(make_least_squares<10>("near", Cells{{12, 13, 14, 15, 16, 17, 18, 19, 20, 21}},
                                     [](Index, const auto& z) {
                                       using std::sin;
                                       return std::array{z[0] * z[4] - 0.3,  z[1] - sin(z[5]),
                                                         z[2] * z[3] + z[6], z[7] - z[0],
                                                         z[8] - 0.4,         z[9] + z[5] * z[6]};
                                     }),
              2.0);
  const Vec targets = random_vector(22, 9);
  builder.add(
      make_least_squares<1>("pull", one_node_each(22),
                            [targets](Index e, const auto& z) { return z[0] - targets[e]; }),
      0.3);
  return {builder.build(), random_vector(22, 5)};
}

TEST(ManifoldProblem, TermsOfCoordinatesHaveTheirDerivatives) {
  const Mixture m = mixture();
  Vec y;
  const Problem problem = m.problem.around(m.start, &y);
  for (const double away : {0.0, 0.4}) {  // at the base points, and beside them
    const Vec at = problem.expand(y + away * random_vector(y.size(), 6));
    for (const TermId id : problem.terms()) {
      const DerivativeReport report =
          check_derivatives(problem.term(id), at, 1e-5, problem.state(id));
      EXPECT_TRUE(report.ok()) << report.message();
    }
  }
}

TEST(ManifoldProblem, AProductEndsOnAllOfThemWithAllModels) {
  const Mixture m = mixture();
  double energies[3];
  int k = 0;
  for (const double projection : {1.0, 2.0, 0.0}) {
    NewtonOptions options;
    options.projection = projection;
    options.stopping.relative_decrease = 1e-10;
    const ManifoldResult result = m.problem.minimize(m.start, options);
    EXPECT_EQ(result.status, Status::Converged) << result.message;
    const Eigen::Matrix3d R = Eigen::Map<const Eigen::Matrix3d>(result.x.data() + 3);
    EXPECT_NEAR(result.x.head(3).norm(), 1, 1e-15);
    EXPECT_LE((R.transpose() * R - Eigen::Matrix3d::Identity()).norm(), 4e-15);
    EXPECT_NEAR(result.x.segment(12, 4).norm(), 1, 1e-15);
    EXPECT_NEAR(result.x.segment(16, 2).norm(), 1, 1e-15);
    // The gradient normal to the manifolds has no effect.
    Vec y, gradient;
    const Problem around = m.problem.around(result.x, &y);
    Evaluator(around).gradient(y, gradient);
    EXPECT_LE(gradient.norm(), 1e-6);
    energies[k++] = result.energy;
  }
  EXPECT_NEAR(energies[0], energies[1], 1e-8);
}

// Directions on a graph have the minimum of the problem with equalities |x|^2 = 1.
TEST(ManifoldProblem, ASphereIsTheEqualityOfItsPoints) {
  constexpr Index count = 12;
  const Eigen::MatrixXd targets = random_matrix(count, 3, 7);
  Cells pairs(count - 1, 2);
  for (Index k = 0; k + 1 < count; ++k) pairs.row(k) << k, k + 1;
  const auto bending = make_term<2, 3>(
      "bending", pairs, [](Index, const auto& z) { return (z.col(1) - z.col(0)).squaredNorm(); });
  const auto pull =
      make_term<1, 3>("pull", one_node_each(count), [targets](Index e, const auto& z) {
        const Eigen::Vector3d to = targets.row(e).transpose();
        return -z(0, 0) * to[0] - z(1, 0) * to[1] - z(2, 0) * to[2];
      });
  const Vec start = random_vector(3 * count, 8);

  ManifoldProblemBuilder builder(3 * count);
  builder.on(unit_sphere(3), rows_of_unknowns(count, 3));
  builder.add(bending, 2.0);
  builder.add(pull, 1.0);
  const ManifoldResult on_manifold = builder.build().minimize(start);
  EXPECT_EQ(on_manifold.status, Status::Converged) << on_manifold.message;

  ProblemBuilder held(3 * count);
  held.add(bending, 2.0);
  held.add(pull, 1.0);
  held.add(equality<1, 3>("sphere", one_node_each(count),
                          [](Index, const auto& z) { return z.squaredNorm() - 1.0; }),
           1.0);
  const BarrierResult by_equality = BarrierMinimizer({}).run(held.build(), on_manifold.x);
  EXPECT_EQ(by_equality.status, Status::Converged) << by_equality.message;
  EXPECT_NEAR(on_manifold.energy, by_equality.energy, 1e-9);
  EXPECT_LE((on_manifold.x - by_equality.y).norm(), 1e-5);
}

TEST(ManifoldProblem, KeepsItsAnalysisAndTakesConstraintsOnOtherUnknowns) {
  // A point p (0-2) of the sphere, and a point q (3-5) that a constraint keeps in a plane.
  ManifoldProblemBuilder builder(6);
  builder.on(unit_sphere(3), Cells{{0, 1, 2}});
  builder.add(
      make_term<2, 3>("apart", Cells{{0, 1}},
                      [](Index, const auto& z) { return (z.col(1) - z.col(0)).squaredNorm(); }),
      1.0);
  builder.add(FixedUnknowns({{3, 2.0}, {4, 1.0}}));
  const ManifoldProblem problem = builder.build();
  EXPECT_EQ(problem.size(), 3);
  const ManifoldResult result = problem.minimize(Vec{{0.1, -0.2, 1, 2, 1, 0.4}});
  EXPECT_EQ(result.status, Status::Converged) << result.message;
  EXPECT_LE((result.x - Vec{{2 / std::sqrt(5), 1 / std::sqrt(5), 0, 2, 1, 0}}).norm(), 1e-7);
  EXPECT_TRUE(problem.around(result.x).same_structure(problem.around(Vec::Ones(6))));
}

TEST(ManifoldProblem, TermsSeeTheDataOfTheirState) {
  const auto pull = make_term<1, 3>(
      "pull", Cells{{0}},
      [](Index, const auto& z, const auto& to) {
        return (z[0] - to[0]) * (z[0] - to[0]) + (z[1] - to[1]) * (z[1] - to[1]) +
               (z[2] - to[2]) * (z[2] - to[2]);
      },
      Vec{{1, 0, 0}});
  ManifoldProblemBuilder builder(3);
  builder.on(unit_sphere(3), Cells{{0, 1, 2}});
  builder.add(pull, TermState{.parameters = Vec{{0, 2, 1}}});
  const ManifoldResult result = builder.build().minimize(Vec{{0.5, 0.5, 0}});
  EXPECT_EQ(result.status, Status::Converged) << result.message;
  EXPECT_LE((result.x - Vec{{0, 2 / std::sqrt(5), 1 / std::sqrt(5)}}).norm(), 1e-6);
}

// The Hessian of a linear energy has no positive eigenvalue on half of a sphere.
TEST(ManifoldProblem, LeavesPointsWithoutPositiveCurvature) {
  ManifoldProblemBuilder builder(3);
  builder.on(unit_sphere(3), Cells{{0, 1, 2}});
  builder.add(linear_term("slope", Vec{{0, 0, 1}}), 1.0);
  const ManifoldProblem problem = builder.build();
  for (unsigned seed = 1; seed < 30; ++seed) {
    const ManifoldResult result = problem.minimize(random_vector(3, seed));
    EXPECT_EQ(result.status, Status::Converged) << result.message;
    EXPECT_NEAR(result.energy, -1, 1e-10);
  }
}

// Four rods of a spatial linkage: their orientations R_k are near others, and the rods close,
//     sum_k R_k a_k = 0.
struct Linkage {
  std::vector<Eigen::Vector3d> rods;
  std::vector<Eigen::Matrix3d> targets;
  std::shared_ptr<const EnergyTerm> pull, closed;
};

using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

Linkage linkage() {
  Linkage made;
  Vec all(36);
  for (unsigned k = 0; k < 4; ++k) {
    made.rods.emplace_back(1, 0.1 * k, -0.2);
    const Vec point = random_point(*rotation_matrices(), 40 + k);
    made.targets.emplace_back(Eigen::Map<const RowMajor3>(point.data()));
    all.segment(9 * k, 9) = point;
  }
  made.pull = make_term<1>("pull", one_node_each(36), [all](Index e, const auto& z) {
    return (z[0] - all[e]) * (z[0] - all[e]);
  });
  Cells rows(3, 12);
  for (Index i = 0; i < 3; ++i)
    for (Index k = 0; k < 12; ++k) rows(i, k) = 9 * (k / 3) + 3 * i + k % 3;
  made.closed = equality<12>("closed", rows, [rods = made.rods](Index, const auto& z) {
    auto sum = 0.0 * z[0];
    for (int k = 0; k < 12; ++k) sum = sum + rods[to_size(k / 3)][k % 3] * z[k];
    return sum;
  });
  return made;
}

TEST(ManifoldProblem, ALinkageOfRotationsCloses) {
  const Linkage rods = linkage();
  ManifoldProblemBuilder builder(36);
  builder.on(rotation_matrices(), rows_of_unknowns(4, 9));
  builder.add(rods.pull, 1.0);
  const TermId closed = builder.add(rods.closed, 1.0);
  const ManifoldProblem problem = builder.build();
  for (unsigned seed = 50; seed < 55; ++seed) {
    Vec seen;
    StepObserver observer([&](const TraceEntry&, const Vec& x) {
      seen = x;
      return Directive::Continue;
    });
    const ManifoldBarrierResult result =
        problem.minimize(random_vector(36, seed), BarrierMinimizer({}), &observer);
    ASSERT_EQ(result.status, Status::Converged) << result.message;
    EXPECT_EQ(result.definite, Definite::Yes);
    EXPECT_LE(result.violation, 1e-10);
    EXPECT_EQ(seen.size(), 36);
    ASSERT_EQ(result.multipliers.size(), 1u);
    const Eigen::Vector3d l = result.multipliers.front();
    EXPECT_GT(l.norm(), 0.1);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (Index k = 0; k < 4; ++k) {
      const Eigen::Matrix3d R = Eigen::Map<const RowMajor3>(result.x.data() + 9 * k);
      EXPECT_LE((R.transpose() * R - Eigen::Matrix3d::Identity()).norm(), 4e-15);
      sum += R * rods.rods[to_size(k)];
      // R^T dL/dR is symmetric: no rotation lowers L = E + l.g.
      const Eigen::Matrix3d slope = R.transpose() * (2 * (R - rods.targets[to_size(k)]) +
                                                     l * rods.rods[to_size(k)].transpose());
      EXPECT_LE((slope - slope.transpose()).norm(), 1e-7);
    }
    EXPECT_LE(sum.norm(), 1e-9);
    // The states of the last phase have their minimum here.
    Vec y, gradient;
    const Problem around = problem.around(result.x, &y).with(result.states);
    EXPECT_EQ(y, result.y);
    Evaluator(around).gradient(y, gradient);
    EXPECT_LE(gradient.norm(), 1e-7);
    const DerivativeReport report =
        check_derivatives(around.term(closed), around.expand(y + 0.3 * random_vector(y.size(), 6)),
                          1e-5, around.state(closed));
    EXPECT_TRUE(report.ok()) << report.message();
  }
}

// The nearest points of a sphere and of a box, which the start is outside of.
TEST(ManifoldProblem, HoldsBoundsOfOtherUnknowns) {
  ManifoldProblemBuilder builder(6);
  builder.on(unit_sphere(3), Cells{{0, 1, 2}});
  builder.add(
      make_term<2, 3>("apart", Cells{{0, 1}},
                      [](Index, const auto& z) { return (z.col(1) - z.col(0)).squaredNorm(); }),
      1.0);
  const double none = std::numeric_limits<double>::infinity();
  const auto box =
      Bounds(Vec{{-none, -none, -none, 1, 2, -1}}, Vec{{none, none, none, 3, 4, 1}}).checker();
  builder.add(box);
  const auto method = BarrierMinimizer::of_bounds({{builder.add(box->barrier(), 1.0), box}});
  const ManifoldBarrierResult result = builder.build().minimize(Vec{{0, 0, 1, 0, 0, 0.5}}, method);
  ASSERT_EQ(result.status, Status::Converged) << result.message;
  const double length = std::sqrt(5);
  EXPECT_LE((result.x - Vec{{1 / length, 2 / length, 0, 1, 2, 0}}).norm(), 1e-6);
  EXPECT_NEAR(result.energy, (length - 1) * (length - 1), 1e-7);
  EXPECT_NEAR(result.x.head(3).norm(), 1, 1e-15);
  EXPECT_TRUE(box->check(result.x).feasible);
}

// The least x of the cap z >= 0.6, from the other side of the sphere.
TEST(ManifoldProblem, HoldsInequalitiesOfPoints) {
  const auto cap = inequality<1, 3>("cap", Cells{{0}}, [](Index, const auto& z) {
                     return z[2] - 0.6;
                   }).checker();
  const double none = std::numeric_limits<double>::infinity();
  const auto bounds = Bounds(Vec{{-none, -none, 0.6}}, Vec::Constant(3, none)).checker();
  for (const std::shared_ptr<const BarrierChecker>& bound : {cap, bounds}) {
    ManifoldProblemBuilder builder(3);
    builder.on(unit_sphere(3), Cells{{0, 1, 2}});
    builder.add(linear_term("x", Vec::Unit(3, 0)), 1.0);
    builder.add(bound);
    const auto method = BarrierMinimizer::of_bounds({{builder.add(bound->barrier(), 1.0), bound}});
    const ManifoldProblem problem = builder.build();
    for (const Vec& start : {Vec{{0.3, 0.2, -1}}, Vec{{1, 0.1, 0}}, Vec{{-0.1, 0.2, 1}}}) {
      const ManifoldBarrierResult result = problem.minimize(start, method);
      ASSERT_EQ(result.status, Status::Converged) << bound->name() << ": " << result.message;
      EXPECT_LE((result.x - Vec{{-0.8, 0, 0.6}}).norm(), 1e-6) << bound->name();
      EXPECT_TRUE(bound->check(result.x).feasible);
      EXPECT_NEAR(result.x.norm(), 1, 1e-15);
    }
  }
}

// The coordinates of a point stay where the chart moves to it, and where it comes back from
// another.
TEST(ManifoldChart, ComesBackToAPoint) {
  ManifoldProblemBuilder builder(9);
  builder.on(rotation_matrices(), rows_of_unknowns(1, 9));
  builder.add(linear_term("slope", random_vector(9, 30)), 1.0);
  const auto points = std::make_shared<const ManifoldPoints>(
      9, std::vector<ManifoldPoints::Point>{{rotation_matrices(), {0, 1, 2, 3, 4, 5, 6, 7, 8}}});
  const Vec start = random_point(*rotation_matrices(), 31);
  Vec y;
  ManifoldChart chart(points, {}, points->around(start, y));
  Evaluator evaluator(chart.begun(builder.build().around(start)));
  EXPECT_LE((chart.expand(y) - start).norm(), 1e-14);
  const double energy = evaluator.value(y);
  Vec other = y;
  for (unsigned k = 0; k < 3; ++k) {
    other += random_vector(3, 32 + k);
    const Vec there = chart.expand(other);
    const double before = evaluator.value(other);
    chart.move(evaluator, other);
    EXPECT_LE((chart.expand(other) - there).norm(), 1e-14);
    EXPECT_NEAR(evaluator.value(other), before, 1e-14);
  }
  EXPECT_GT((chart.expand(y) - start).norm(), 1e-2);
  chart.return_to(evaluator, y, start);
  EXPECT_LE((chart.expand(y) - start).norm(), 1e-14);
  EXPECT_NEAR(evaluator.value(y), energy, 1e-14);
}

// Energies without a minimum raise the penalties, and the run begins where it began.
TEST(ManifoldProblem, ComesBackToItsStart) {
  ManifoldProblemBuilder builder(4);
  builder.on(unit_sphere(3), Cells{{0, 1, 2}});
  builder.add(make_term<1>("falls", Cells{{3}},
                           [](Index, const auto& z) { return -z[0] * z[0] * z[0] * z[0]; }),
              1.0);
  builder.add(make_term<1, 3>("pull", Cells{{0}},
                              [](Index, const auto& z) { return 0.1 * z[2] + 0.01 * z[1]; }),
              1.0);
  builder.add(equality<2>("same", Cells{{0, 3}}, [](Index, const auto& z) { return z[0] - z[1]; }),
              1.0);
  const ManifoldBarrierResult result =
      builder.build().minimize(Vec{{0.1, 0.2, -1, 0.05}}, BarrierMinimizer({}));
  ASSERT_EQ(result.status, Status::Converged) << result.message;
  EXPECT_EQ(result.definite, Definite::Yes);
  EXPECT_NEAR(result.x[0], result.x[3], 1e-10);
  EXPECT_NEAR(result.x.head(3).norm(), 1, 1e-15);
}

TEST(ManifoldProblem, NamesConstraintsThatCannotBeMet) {
  ManifoldProblemBuilder builder(3);
  builder.on(unit_sphere(3), Cells{{0, 1, 2}});
  builder.add(linear_term("slope", Vec{{0, 1, 0.3}}), 1.0);
  builder.add(equality<1>("far", Cells{{0}}, [](Index, const auto& z) { return z[0] - 2.0; }), 1.0);
  const ManifoldBarrierResult result =
      builder.build().minimize(Vec{{0.1, 0.2, -1}}, BarrierMinimizer({}));
  EXPECT_EQ(result.status, Status::Infeasible);
  EXPECT_NE(result.message.find("'far'"), std::string::npos) << result.message;
  EXPECT_NEAR(result.x[0], 1, 1e-3);
  EXPECT_NEAR(result.x.norm(), 1, 1e-15);
}

// x_3 > limit; counts the points that it refuses.
class HalfSpace final : public FeasibilityChecker {
 public:
  HalfSpace(double limit, int& refused) : limit_(limit), refused_(refused) {}
  std::string_view name() const override { return "half-space"; }
  Verdict check(VecIn x) const override {
    EXPECT_EQ(x.size(), 4);
    EXPECT_NEAR(x.head(3).norm(), 1, 1e-14);
    if (!(x[3] > limit_)) ++refused_;
    return {x[3] > limit_, x[3] - limit_, {}, {}};
  }
  StepBound max_step(VecIn x, VecIn d, double s) const override {
    return {d[3] < 0 ? std::min(s, (limit_ - x[3]) / d[3]) : s, {}};
  }

 private:
  double limit_;
  int& refused_;
};

TEST(ManifoldProblem, CheckersSeeTheirUnknowns) {
  ManifoldProblemBuilder builder(4);
  builder.on(unit_sphere(3), Cells{{0, 1, 2}});
  builder.add(
      make_term<4>("height", Cells{{0, 1, 2, 3}},
                   [](Index, const auto& z) { return z[2] + (z[3] + z[0]) * (z[3] + z[0]); }),
      1.0);
  int refused = 0;
  builder.add(std::make_shared<const HalfSpace>(-0.1, refused));
  const ManifoldProblem problem = builder.build();
  const ManifoldResult result = problem.minimize(Vec{{1, 0.2, 0.3, 0.5}});
  EXPECT_EQ(result.status, Status::Converged) << result.message;
  EXPECT_LE((result.x - Vec{{0, 0, -1, 0}}).norm(), 1e-6);
  EXPECT_EQ(refused, 0);
  EXPECT_TRUE(std::any_of(result.iterations.begin(), result.iterations.end(),
                          [](const IterationRecord& step) { return step.step_bound < 1; }));
  const ManifoldResult outside = problem.minimize(Vec{{1, 0.2, 0.3, -0.5}});
  EXPECT_EQ(outside.status, Status::Infeasible);
  EXPECT_NE(outside.message.find("half-space"), std::string::npos) << outside.message;
}

// Derivatives of solutions against differences of solutions, with an equality, a bound that holds
// the minimum, a constraint and data beside a direction.
TEST(ManifoldSensitivity, IsTheDerivativeOfSolutions) {
  const double none = std::numeric_limits<double>::infinity();
  const auto solved = [&](double weight, const Vec& to, double fixed, auto use) {
    ManifoldProblemBuilder builder(6);
    builder.on(unit_sphere(3), Cells{{0, 1, 2}});
    builder.add(linear_term("slope", Vec{{1, 0.5, 0.2, 0, 0.3, 0}}), weight);
    builder.add(make_term<1, 3>(
                    "pull", Cells{{0}},
                    [](Index, const auto& z, const auto& p) {
                      return (z[0] - p[0]) * (z[0] - p[0]) + (z[1] - p[1]) * (z[1] - p[1]) +
                             (z[2] - p[2]) * (z[2] - p[2]);
                    },
                    to),
                1.0);
    builder.add(make_term<2>("tie", Cells{{2, 4}},
                             [](Index, const auto& z) { return (z[0] - z[1]) * (z[0] - z[1]); }),
                1.0);
    builder.add(equality<3>("leans", Cells{{0, 1, 3}},
                            [](Index, const auto& z) { return z[0] * z[1] + 0.5 * z[2] - 0.2; }),
                1.0);
    builder.add(FixedUnknowns({{3, fixed}}));
    const auto bound =
        Bounds(Vec{{-none, -none, -none, -none, 0.4, 2}}, Vec{{none, none, none, none, none, 3}})
            .checker();
    builder.add(make_term<1>("up", Cells{{5}}, [](Index, const auto& z) { return z[0] * z[0]; }),
                1.0);
    builder.add(bound);
    const auto method = BarrierMinimizer::of_bounds({{builder.add(bound->barrier(), 1.0), bound}});
    const ManifoldProblem problem = builder.build();
    const ManifoldBarrierResult result =
        problem.minimize(Vec{{0.2, 0.5, -0.8, fixed, 0.6, 2.5}}, method);
    EXPECT_EQ(result.status, Status::Converged) << result.message;
    return use(problem, result);
  };
  const auto x_of = [&](double weight, const Vec& to, double fixed) {
    return solved(weight, to, fixed,
                  [](const ManifoldProblem&, const ManifoldBarrierResult& r) { return r.x; });
  };
  const Vec to{{0.3, -0.4, 0.7}}, dto{{1, 2, -1}}, slope = random_vector(6, 61);
  solved(0.4, to, 0.1, [&](const ManifoldProblem& problem, const ManifoldBarrierResult& result) {
    const ManifoldSensitivity s(problem, result);
    EXPECT_LE((s.point() - result.x).norm(), 1e-7);
    EXPECT_EQ(s.row_count(), 1);
    const double h = 1e-4;
    const TermId id_slope{0}, id_pull{1};
    const Sensitivity::Derivative d = s.adjoint(slope);
    const auto compare = [&](const Sensitivity::Change& change, const Vec& up, const Vec& down,
                             double by_adjoint) {
      const Vec dx = s.forward(change), expected = (up - down) / (2 * h);
      EXPECT_GT(expected.norm(), 1e-2);
      EXPECT_LE((dx - expected).norm(), 1e-5 * expected.norm());
      EXPECT_NEAR(by_adjoint, slope.dot(dx), 1e-9 * slope.norm() * dx.norm());
      EXPECT_NEAR(dx.head(3).dot(result.x.head(3)), 0, 1e-12);
    };
    compare({.weights = {{id_slope, 1.0}}}, x_of(0.4 + h, to, 0.1), x_of(0.4 - h, to, 0.1),
            d.weights[0]);
    compare({.parameters = {{id_pull, dto}}}, x_of(0.4, to + h * dto, 0.1),
            x_of(0.4, to - h * dto, 0.1), d.parameters[1].dot(dto));
    compare({.right_hand_sides = Vec::Ones(1)}, x_of(0.4, to, 0.1 + h), x_of(0.4, to, 0.1 - h),
            d.right_hand_sides[0]);
    EXPECT_THROW(s.adjoint(Vec::Ones(5)), InvalidArgument);
    return 0;
  });
}

std::string refusal(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(ManifoldProblem, RefusesByName) {
  ManifoldProblemBuilder builder(7);
  builder.on(unit_sphere(3), Cells{{0, 1, 2}});
  builder.add(make_term<1>("free", Cells{{6}}, [](Index, const auto& z) { return z[0] * z[0]; }),
              1.0);
  EXPECT_NE(refusal([&] {
              auto other = builder;
              other.add(FixedUnknowns({{1, 0.0}}));
              other.build();
            }).find("holds unknown 1, which lies on a sphere"),
            std::string::npos);
  EXPECT_NE(refusal([&] {
              auto other = builder;
              other.on(unit_sphere(2), Cells{{2, 3}});
              other.build();
            }).find("unknown 2 lies on two manifolds"),
            std::string::npos);
  EXPECT_NE(refusal([&] {
              auto other = builder;
              other.on(unit_sphere(2), Cells{{6, 7}});
              other.build();
            }).find("7"),
            std::string::npos);
  EXPECT_NE(refusal([&] {
              builder.on(rotation_matrices(), Cells{{3, 4, 5}});
            }).find("9 are needed"),
            std::string::npos);
  const ManifoldProblem problem = builder.build();
  EXPECT_NE(refusal([&] {
              problem.minimize(Vec::Zero(7));
            }).find("begins with unknown 0 has no nearest one on the sphere"),
            std::string::npos);
  EXPECT_NE(refusal([&] { problem.minimize(Vec::Zero(5)); }).find("5 numbers"), std::string::npos);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
