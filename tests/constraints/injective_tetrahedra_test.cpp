// LocalInjectivity on elements other than triangles uses the element space only.
#include <gtest/gtest.h>

#include "elements/element_maps.h"
#include "majorant/constraints/local_injectivity.h"
#include "majorant/elements/rest_shapes.h"

namespace majorant {
namespace {

using test::Random;

class InjectiveElements : public testing::TestWithParam<test::ElementCase> {
 protected:
  int dim() const { return space_->reference_dim(); }
  std::shared_ptr<const BernsteinSpace> space_ = GetParam().space();
  const RowMatrix nodes_ = space_->node_positions(GetParam().mesh.vertices);
  const RestShapes rest_ = curved_shapes(*space_, nodes_, GetParam().rule);
  const LocalInjectivity checker_{space_, rest_.measure / space_->reference_measure(), 12};
  const Vec x_ = test::unknowns(nodes_);
};

TEST_P(InjectiveElements, TheIdentityHasMarginOne) {
  const Verdict verdict = checker_.check(x_);
  EXPECT_TRUE(verdict.feasible);
  EXPECT_TRUE(verdict.blocking.empty());
  EXPECT_LE(verdict.margin, 1 + 1e-12);
  // On straight quads other than parallelograms det J varies.
  EXPECT_GT(verdict.margin, space_->element().factors.size() == 1 ? 1 - 1e-12 : 0.3);
}

TEST_P(InjectiveElements, ReflectionsAreRefusedEverywhere) {
  RowMatrix mirrored = nodes_;
  mirrored.col(0) *= -1;
  const Verdict verdict = checker_.check(test::unknowns(mirrored));
  EXPECT_FALSE(verdict.feasible);
  EXPECT_EQ(static_cast<Index>(verdict.blocking.size()), space_->element_count());
  EXPECT_LT(verdict.margin, 0);
}

TEST_P(InjectiveElements, BlockingElementsSurroundAnInvertedVertex) {
  Vec x = x_;
  const Index vertex = dim() == 3 ? 13 : 5;  // an inner vertex
  x[dim() * vertex] += 1.3;
  const Verdict verdict = checker_.check(x);
  EXPECT_FALSE(verdict.feasible);
  ASSERT_FALSE(verdict.blocking.empty());
  for (const Index e : verdict.blocking) {
    bool touches = false;
    for (int k = 0; k < space_->nodes_per_element(); ++k)
      touches |= space_->cells()(e, k) == vertex;
    EXPECT_TRUE(touches);
  }
}

TEST_P(InjectiveElements, StepsEndAtTheFirstInversion) {
  Random random(1);
  for (int trial = 0; trial < 3; ++trial) {
    const Vec d = random.vector(static_cast<Index>(x_.size()));
    const StepBound bound = checker_.max_step(x_, d, 5);
    ASSERT_LT(bound.step, 5);
    ASSERT_FALSE(bound.blocking.empty());
    for (const double s : {0.3, 0.9, 0.999})
      EXPECT_TRUE(checker_.check(x_ + s * bound.step * d).feasible) << s;
    EXPECT_FALSE(checker_.check(x_ + 1.001 * bound.step * d).feasible);
    const double half = 0.5 * bound.step;
    EXPECT_EQ(checker_.max_step(x_, d, half).step, half);
  }
}

INSTANTIATE_TEST_SUITE_P(All, InjectiveElements, testing::ValuesIn(test::all_elements()),
                         test::case_name);

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
