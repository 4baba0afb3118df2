// Terms made of a lambda: derivatives, domain, data, unknowns of any kind, exceptions.
#include "majorant/framework/terms/local_term.h"

#include <gtest/gtest.h>

#include <atomic>
#include <complex>
#include <limits>
#include <stdexcept>
#include <thread>

#include "majorant/framework/energy_term.h"
#include "majorant/framework/error.h"
#include "majorant/framework/newton.h"
#include "random.h"

namespace majorant {
namespace {

Cells chain(Index count, Index nodes) {
  Cells cells(count, nodes);
  for (Index e = 0; e < count; ++e)
    for (Index i = 0; i < nodes; ++i) cells(e, i) = e + i;
  return cells;
}

// Returns a term with branches, powers, angles, and data by element.
auto turning(const Vec& rest) {
  return make_term<3, 2>("turning", chain(rest.size(), 3), [rest](Index e, const auto& z) {
    using std::abs, std::atan2, std::hypot, std::log, std::pow;
    const auto a = (z.col(1) - z.col(0)).eval(), b = (z.col(2) - z.col(1)).eval();
    const auto angle = atan2(a[0] * b[1] - a[1] * b[0], a.dot(b));
    auto energy = angle * angle / rest[e] + pow(hypot(a[0], a[1]) / rest[e], 1.5);
    if (angle > 0) energy += pow(angle, 3);
    return energy + abs(b[0] + 9.0) * log(1.0 + b.squaredNorm());
  });
}

TEST(LocalTerm, DerivativesOfEverything) {
  test::Random random(1);
  const auto term = turning(random.vector(150, 0.5, 2));  // more than one batch
  const DerivativeReport report = check_derivatives(*term, random.vector(2 * 152));
  EXPECT_TRUE(report.ok()) << report.message();
}

TEST(LocalTerm, ClosedForm) {
  // The term x^2 y / w, w by element.
  const Cells unknowns{{0, 1}, {2, 1}};
  const auto term = make_term<2>("cubic", unknowns, [w = Vec{{2.0, 5.0}}](Index e, const auto& z) {
    return z[0] * z[0] * z[1] / w[e];
  });
  const Problem problem = ProblemBuilder(3).add(term, 10).build();
  Evaluator evaluator(problem);
  Vec g, h;
  const Vec x{{3, 7, -1}};
  EXPECT_DOUBLE_EQ(evaluator.value(x), 10 * (63.0 / 2 + 7.0 / 5));
  EXPECT_DOUBLE_EQ(evaluator.linearize(x, Curvature::Exact, g, h), 10 * (63.0 / 2 + 7.0 / 5));
  const Vec expected{{10 * 2 * 3 * 7 / 2.0, 10 * (9 / 2.0 + 1 / 5.0), 10 * -2 * 7 / 5.0}};
  EXPECT_LE((g - expected).norm(), 1e-12);
  EXPECT_EQ(evaluator.gradient(x, g), evaluator.value(x));
  EXPECT_LE((g - expected).norm(), 1e-12);
}

// Nodes of one, two and three unknowns: a hinge between a point in space, a point in the plane, and
// an angle.
TEST(LocalTerm, UnknownsOfMixedBlocks) {
  Cells unknowns(2, 6);
  unknowns << 0, 1, 2, 10, 11, 20, 3, 4, 5, 12, 13, 21;
  const auto term = make_term<6>("mixed", unknowns, [](Index, const auto& z) {
    using std::cos, std::sin;
    const auto turned = z[3] * cos(z[5]) - z[4] * sin(z[5]);
    return (z[0] - turned) * (z[0] - turned) * (1.0 + z[1] * z[1]) + sin(z[2] * z[4]);
  });
  test::Random random(2);
  const DerivativeReport report = check_derivatives(*term, random.vector(22));
  EXPECT_TRUE(report.ok()) << report.message();
}

TEST(LocalTerm, ProjectedHasNoNegativeEigenvalues) {
  const auto saddle =
      make_term<2>("saddle", Cells{{0, 1}}, [](Index, const auto& z) { return 3.0 * z[0] * z[1]; });
  const Problem problem = ProblemBuilder(2).add(saddle, 1).build();
  Evaluator evaluator(problem);
  Vec g, h;
  evaluator.linearize(Vec::Ones(2), Curvature::Projected, g, h);
  for (const double entry : h) EXPECT_NEAR(entry, 1.5, 1e-14);
  evaluator.linearize(Vec::Ones(2), BlendedCurvature::projected(0.5), g, h);
  EXPECT_NEAR(h.minCoeff(), 0.75, 1e-14);
  EXPECT_NEAR(h.maxCoeff(), 2.25, 1e-14);
}

// Elements that depend only on the difference of two nodes are projected by a smaller matrix; with
// an anchor by the whole one.
TEST(LocalTerm, PairsAreProjectedAsOneBlock) {
  test::Random random(5);
  for (const double anchor : {0.0, 0.3}) {
    const auto spring = [anchor](Index, const auto& z) {
      const auto stretch = (z.col(1) - z.col(0)).norm() - 2.0;
      return stretch * stretch + anchor * z(0, 0) * z(1, 1);
    };
    const Problem problem =
        ProblemBuilder(6).add(make_term<2, 3>("spring", Cells{{0, 1}}, spring), 1).build();
    Evaluator evaluator(problem);
    for (int trial = 0; trial < 20; ++trial) {
      const Vec x = random.vector(6, -0.5, 0.5);
      Vec g, exact, found;
      evaluator.linearize(x, Curvature::Exact, g, exact);
      evaluator.linearize(x, BlendedCurvature::projected(0.7), g, found);
      double packed[21];
      for (int i = 0, p = 0; i < 6; ++i)
        for (int j = 0; j <= i; ++j, ++p) packed[p] = exact[problem.pattern().slot(i, j)];
      clamp_eigenvalues(6, 0.7, packed);
      for (int i = 0, p = 0; i < 6; ++i)
        for (int j = 0; j <= i; ++j, ++p)
          EXPECT_NEAR(found[problem.pattern().slot(i, j)], packed[p], 1e-11) << anchor;
    }
  }
}

TEST(LocalTerm, NotANumberIsOutsideOfTheDomain) {
  const auto root = make_term<1>("root", Cells{{0}, {1}, {2}}, [](Index, const auto& z) {
    using std::sqrt;
    return sqrt(z[0]);
  });
  const Problem problem = ProblemBuilder(3).add(root, 1).build();
  EXPECT_EQ(Evaluator(problem).value(Vec{{1, -1, 1}}), std::numeric_limits<double>::infinity());
  const SolveResult result = NewtonMinimizer().minimize(problem, Vec{{1, -1, 1}}, {});
  EXPECT_EQ(result.status, Status::Infeasible);
}

TEST(LocalTerm, ListsOfTheWrongWidth) {
  const auto f = [](Index, const auto& z) { return z(0, 0); };
  EXPECT_THROW((make_term<3, 2>("wide", Cells::Zero(4, 2), f)), Error);
  EXPECT_THROW((make_term<1>("narrow", Cells::Zero(4, 2), f)), Error);
  EXPECT_NO_THROW((make_term<2>("none", Cells(0, 2), f)));
  const auto outside = make_term<1, 2>("outside", Cells{{5}}, f);
  EXPECT_ANY_THROW(ProblemBuilder(11).add(outside, 1));
  EXPECT_NO_THROW(ProblemBuilder(12).add(outside, 1));
}

// A long elastic chain. The lambda throws in call `at`; never if it is negative.
struct ThrowsAt : std::runtime_error {
  explicit ThrowsAt(long call) : std::runtime_error("call " + std::to_string(call)) {}
};
SolveResult solve_chain(long at) {
  const Index links = 2500;  // 20 batches for several threads
  const auto calls = std::make_shared<std::atomic<long>>(0);
  const auto term = make_term<2, 2>("chain", chain(links, 2), [=](Index e, const auto& z) {
    if (const long call = (*calls)++; call == at) throw ThrowsAt(call);
    const auto stretch = (z.col(1) - z.col(0)).norm() - (1 + 0.1 * (e % 7));
    return stretch * stretch + 0.01 * z.col(0).squaredNorm();
  });
  const Problem problem = ProblemBuilder(2 * (links + 1)).add(term, 1).build();
  test::Random random(3);
  NewtonOptions options;
  options.stopping.max_iterations = 8;
  return NewtonMinimizer(options).minimize(problem, random.vector(2 * (links + 1)), {});
}

TEST(LocalTerm, OneOfTwoConcurrentSolvesThrows) {
  const SolveResult alone = solve_chain(-1);
  for (const long at : {0L, 3000L, 20000L}) {
    SolveResult other;
    std::thread beside([&] { other = solve_chain(-1); });
    EXPECT_THROW(solve_chain(at), ThrowsAt);
    beside.join();
    EXPECT_EQ(other.status, Status::MaxIterations);
    EXPECT_EQ(other.energy, alone.energy);
    EXPECT_EQ(other.y, alone.y);  // to the bit
  }
}

// Compares complex numbers of duals (docs/terms.md) with the formula in real numbers.
TEST(LocalTerm, ComplexNumbersOfDuals) {
  const Cells pair{{0, 1}};
  const auto by_complex = make_term<2, 2>("complex", pair, [](Index, const auto& z) {
    using T = typename std::decay_t<decltype(z)>::Scalar;
    const std::complex<T> a(z(0, 0), z(1, 0)), b(z(0, 1), z(1, 1));
    return norm(a * a / b - conj(b));
  });
  const auto by_hand = make_term<2, 2>("real", pair, [](Index, const auto& z) {
    const auto x = z(0, 0), y = z(1, 0), u = z(0, 1), v = z(1, 1);
    const auto n = u * u + v * v, p = x * x - y * y, q = 2.0 * x * y;
    const auto re = (p * u + q * v) / n - u, im = (q * u - p * v) / n + v;
    return re * re + im * im;
  });
  const Vec x{{0.8, -0.3, 1.1, 0.6}};
  const DerivativeReport report = check_derivatives(*by_complex, x);
  EXPECT_TRUE(report.ok()) << report.message();
  Vec g[2], h[2];
  double f[2];
  int k = 0;
  for (const auto& term : {by_complex, by_hand}) {
    const Problem problem = ProblemBuilder(4).add(term, 1).build();
    f[k] = Evaluator(problem).linearize(x, Curvature::Exact, g[k], h[k]);
    ++k;
  }
  EXPECT_NEAR(f[0], f[1], 1e-14 * f[1]);
  EXPECT_LE((g[0] - g[1]).norm(), 1e-13 * g[1].norm());
  EXPECT_LE((h[0] - h[1]).norm(), 1e-13 * h[1].norm());
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
