// Certified determinants of maps, at points and along paths.
#include "majorant/constraints/local_injectivity.h"

#include <gtest/gtest.h>

#include <limits>

#include "exact_polynomials.h"
#include "majorant/framework/error.h"
#include "majorant/framework/parallel.h"
#include "support.h"

namespace majorant {
namespace {

using test::Random;
using test::Rational;

// Returns the exact determinant by reference coordinates at a rational point of face f.
Rational exact_det(const BezierTriangleSpace& space, const Vec& x, Index f,
                   const test::ExactPoint& p) {
  const int n = space.degree();
  const TriangleIndices &ix = TriangleIndices::of_degree(n),
                        &low = TriangleIndices::of_degree(n - 1);
  Rational d[2][2];
  for (int direction = 0; direction < 2; ++direction)
    for (int c = 0; c < 2; ++c) {
      const auto at = [&](int local) { return Rational(x[2 * space.cells()(f, local) + c]); };
      std::vector<Rational> derivative;
      for (int l = 0; l < low.count(); ++l) {
        const auto [i, j, k] = low.multi(l);
        derivative.push_back(n *
                             (at(direction == 0 ? ix.local(i + 1, j, k) : ix.local(i, j + 1, k)) -
                              at(ix.local(i, j, k + 1))));
      }
      d[direction][c] = test::evaluate(n - 1, derivative, p);
    }
  return d[0][0] * d[1][1] - d[1][0] * d[0][1];
}

class Injectivity : public testing::TestWithParam<int> {
 protected:
  Injectivity()
      : mesh_(test::grid(3, 3, 0.2)),
        space_(std::make_shared<const BezierTriangleSpace>(mesh_.faces, 16, GetParam())),
        checker_(space_, test::rest_determinants(mesh_)),
        x_(test::linear_map(*space_, test::flat(mesh_.positions))) {}

  // Returns the smallest exact determinant over a coarse lattice of every face.
  Rational sampled_minimum(const Vec& x, int m = 3) const {
    Rational lowest = 1000000;
    for (Index f = 0; f < space_->element_count(); ++f)
      for (int i = 0; i <= m; ++i)
        for (int j = 0; j <= m - i; ++j)
          lowest = std::min(
              lowest,
              exact_det(*space_, x, f, {Rational(i, m), Rational(j, m), Rational(m - i - j, m)}));
    return lowest;
  }

  ThreadCount one_{1};  // one thread suffices for these maps
  test::Mesh mesh_;
  std::shared_ptr<const BezierTriangleSpace> space_;
  LocalInjectivity checker_;
  Vec x_;
};

TEST_P(Injectivity, TheIdentityHasMarginOne) {
  const Verdict v = checker_.check(x_);
  EXPECT_TRUE(v.feasible);
  EXPECT_TRUE(v.blocking.empty());
  EXPECT_NEAR(v.margin, 1, 1e-12);
  const Vec bounds = checker_.lower_bounds(x_);
  EXPECT_LE((bounds - Vec::Ones(bounds.size())).cwiseAbs().maxCoeff(), 1e-12);
}

TEST_P(Injectivity, VerdictsOnRandomMapsAreNeverWrong) {
  Random random(static_cast<unsigned>(GetParam()));
  int feasible = 0, infeasible = 0;
  for (int trial = 0; trial < 8; ++trial) {
    const Vec x = x_ + (0.04 + 0.12 * trial) / GetParam() * random.vector(x_.size());
    const Verdict v = checker_.check(x);
    const Vec bounds = checker_.lower_bounds(x);
    (v.feasible ? feasible : infeasible) += 1;
    EXPECT_EQ(v.feasible, v.blocking.empty());
    EXPECT_EQ(v.margin, bounds.minCoeff());
    EXPECT_TRUE(std::is_sorted(v.blocking.begin(), v.blocking.end()));
    for (Index f = 0; f < space_->element_count(); ++f) {
      const bool blocking = std::count(v.blocking.begin(), v.blocking.end(), f) > 0;
      EXPECT_EQ(blocking, !(bounds[f] > 0));
      for (int k = 0; k < 3; ++k) {
        const Rational d = exact_det(*space_, x, f, test::exact_point(random, 12));
        // The bound is scaled by the rest determinant, with two roundings.
        const double scaled = bounds[f] * test::rest_determinants(mesh_)[f];
        EXPECT_GE(d, Rational(scaled - 1e-14 * std::abs(scaled)));
        EXPECT_TRUE(blocking || d > 0);
      }
    }
  }
  EXPECT_GT(feasible, 0);
  EXPECT_GT(infeasible, 0);
}

TEST_P(Injectivity, InvertedElementsAreListed) {
  Vec x = x_;
  // Reflects face 7 by exchanging its local corner positions: only its map and those of its
  // neighbours change.
  const Index a = mesh_.faces(7, 0);
  x.segment<2>(2 * a) += 3 * (x.segment<2>(2 * mesh_.faces(7, 1)) - x.segment<2>(2 * a)) +
                         3 * (x.segment<2>(2 * mesh_.faces(7, 2)) - x.segment<2>(2 * a));
  const Verdict v = checker_.check(x);
  EXPECT_FALSE(v.feasible);
  EXPECT_LE(v.margin, 0);
  EXPECT_TRUE(std::count(v.blocking.begin(), v.blocking.end(), 7));
  for (Index f = 0; f < space_->element_count(); ++f) {
    bool touched = false;
    for (int k = 0; k < 3; ++k) touched |= mesh_.faces(f, k) == a;
    EXPECT_TRUE(touched || !std::count(v.blocking.begin(), v.blocking.end(), f)) << f;
  }
}

TEST_P(Injectivity, CertifiedPathsAreInjective) {
  Random random(100 + static_cast<unsigned>(GetParam()));
  int limited = 0;
  for (int trial = 0; trial < 3; ++trial) {
    const Vec d = random.vector(x_.size());
    const StepBound bound = checker_.max_step(x_, d, 1);
    EXPECT_GT(bound.step, 0);
    EXPECT_LE(bound.step, 1);
    EXPECT_EQ(bound.blocking.empty(), bound.step == 1);
    limited += bound.step < 1;
    for (const double t : {0.3, 0.9, 0.999}) {
      const Vec x = x_ + t * bound.step * d;
      EXPECT_GT(sampled_minimum(x), 0);
      EXPECT_TRUE(t > 0.9 || checker_.check(x).feasible) << t;
    }
    const StepBound capped = checker_.max_step(x_, d, 0.5 * bound.step);
    EXPECT_EQ(capped.step, 0.5 * bound.step);
    EXPECT_TRUE(capped.blocking.empty());
  }
  EXPECT_EQ(limited, 3);
}

// The bound is the first zero of det J up to the depth of bisection.
TEST_P(Injectivity, StepsReachTheLimit) {
  Random random(200 + static_cast<unsigned>(GetParam()));
  for (int trial = 0; trial < 3; ++trial) {
    const Vec d = random.vector(x_.size());
    const StepBound bound = checker_.max_step(x_, d, 10);
    ASSERT_FALSE(bound.blocking.empty());
    const Vec x = x_ + 1.1 * bound.step * d;
    double lowest = 1;
    for (const Index f : bound.blocking)
      for (int i = 0; i <= 30; ++i)
        for (int j = 0; j <= 30 - i; ++j)
          lowest =
              std::min(lowest, test::det_at(*space_, x, f, Barycentric(i, j, 30 - i - j) / 30));
    EXPECT_LT(lowest, 0.01);
  }
}

TEST_P(Injectivity, NonfiniteMapsAreInfeasible) {
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()})
    for (Index k = 0; k < x_.size(); ++k) {
      Vec x = x_;
      x[k] = bad;
      ASSERT_FALSE(checker_.check(x).feasible) << "unknown " << k << " = " << bad;
    }
}

TEST_P(Injectivity, ThreadsDoNotChangeResults) {
  Random random(1);
  const Vec x = x_ + 0.1 / GetParam() * random.vector(x_.size()), d = random.vector(x_.size());
  const Vec bounds = checker_.lower_bounds(x);
  const StepBound one = checker_.max_step(x_, d, 1);
  const ThreadCount threads(2);
  EXPECT_EQ(checker_.lower_bounds(x), bounds);
  const StepBound two = checker_.max_step(x_, d, 1);
  EXPECT_EQ(one.step, two.step);
  EXPECT_EQ(one.blocking, two.blocking);
}

INSTANTIATE_TEST_SUITE_P(Degrees, Injectivity, testing::Range(1, 6));

TEST(InjectivityRest, DeterminantsFitAndArePositive) {
  Cells face(1, 3);
  face << 0, 1, 2;
  const auto space = std::make_shared<const BezierTriangleSpace>(face, 3, 1);
  EXPECT_THROW(LocalInjectivity(space, Vec::Ones(2)), InvalidArgument);
  EXPECT_THROW(LocalInjectivity(space, Vec()), InvalidArgument);
  EXPECT_THROW(LocalInjectivity(nullptr, Vec::Ones(1)), InvalidArgument);
  Points2 corners(3, 2);
  corners << 0, 1, 1, 0, 0, 0;  // inverted
  const Vec inverted = test::linear_map(*space, corners);
  EXPECT_FALSE(LocalInjectivity(space, Vec::Ones(1)).check(inverted).feasible);
  for (const double rest : {-1.0, 0.0, std::nan(""), std::numeric_limits<double>::infinity()})
    EXPECT_THROW(LocalInjectivity(space, Vec::Constant(1, rest)), InvalidArgument) << rest;
}

TEST(InjectivityDepth, DeeperBisectionProvesMoreAndIsCounted) {
  Cells face(1, 3);
  face << 0, 1, 2;
  const auto space = std::make_shared<const BezierTriangleSpace>(face, 3, 3);
  Points2 corners(3, 2);
  corners << 1, 0, 0, 1, 0, 0;
  const Vec identity = test::linear_map(*space, corners);
  Random random(3);
  const ThreadCount threads(1);
  int deeper = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Vec x = identity + 0.2 * random.vector(identity.size());
    const LocalInjectivity shallow(space, Vec::Ones(1), 0), deep(space, Vec::Ones(1), 6);
    const Verdict verdict = deep.check(x);
    const bool a = shallow.check(x).feasible, b = verdict.feasible;
    EXPECT_TRUE(b || !a);
    deeper += b && !a;
    ASSERT_EQ(verdict.proven.size(), 7u);
    EXPECT_EQ(verdict.proven[0], a ? 1 : 0);
    long total = 0;
    for (const long c : verdict.proven) total += c;
    EXPECT_EQ(total, b ? 1 : 0);
  }
  EXPECT_GT(deeper, 5);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
