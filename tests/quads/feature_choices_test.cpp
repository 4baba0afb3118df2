#include "majorant/quads/internal/feature_choices.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "majorant/quads/features.h"
#include "parametrization/fields/closed_surfaces.h"

namespace majorant {
namespace {

TEST(FeatureChoices, WithoutFeaturesThereIsOne) {
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(sphere(8));
  const std::vector<FeatureChoice> choices =
      feature_choices(mesh, {}, FeatureSource::Detected, 100);
  ASSERT_EQ(choices.size(), 1u);
  EXPECT_TRUE(choices[0].features.empty());
  EXPECT_EQ(choices[0].attempts.back().purpose, AttemptPurpose::Suggested);
}

// From all lines to none, each set once; then the fallbacks: the sharp lines, and none again.
TEST(FeatureChoices, GoFromSharpLinesToNone) {
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(cube(6));
  const std::vector<char> features = sharp_edges(mesh, kCornerTurn);
  ASSERT_TRUE(has_any(features));
  for (const FeatureSource source : {FeatureSource::Detected, FeatureSource::Given}) {
    const std::vector<FeatureChoice> choices = feature_choices(mesh, features, source, 600);
    ASSERT_EQ(choices.size(), 4u);
    EXPECT_EQ(choices[0].features, features);
    EXPECT_EQ(choices[0].acceptance, ChoiceAcceptance::WithinCount);
    EXPECT_EQ(choices[0].max_count, 1200);
    EXPECT_FALSE(has_any(choices[1].features));
    EXPECT_EQ(choices[1].acceptance, ChoiceAcceptance::Always);
    EXPECT_EQ(choices[2].features, features);
    EXPECT_FALSE(has_any(choices[3].features));
    for (const std::size_t k : {2, 3}) EXPECT_EQ(choices[k].acceptance, ChoiceAcceptance::Fallback);
    EXPECT_EQ(choices[3].attempts.front().purpose, AttemptPurpose::Last);
    const auto grows = [](const QuadAttempt& a) { return a.purpose == AttemptPurpose::Growing; };
    EXPECT_EQ(std::any_of(choices[0].attempts.begin(), choices[0].attempts.end(), grows),
              source == FeatureSource::Given);
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
