#include "majorant/parametrization/packing/pack.h"

#include <gtest/gtest.h>

#include <vector>

#include "expected_error.h"
#include "parametrization/packing/chart_cases.h"

namespace majorant {
namespace {

using test::Random;

void expect_packed(const std::vector<BezierMap>& charts, const PackOptions& options, int samples,
                   const std::string& name) {
  test::expect_valid(charts, pack(charts, options), options, samples, name);
}

TEST(Pack, one_chart_is_turned_into_its_box) {
  const BezierMap chart = test::polygon_chart(test::turned(test::rectangle(2, 1), 0.3, {5, 7}));
  const Packing packing = pack({chart});
  test::expect_valid({chart}, packing, {}, 1, "rectangle");
  EXPECT_NEAR(packing.side, 2, 1e-12);
  EXPECT_NEAR(packing.fill, 0.5, 1e-12);
}

TEST(Pack, polygons_keep_their_distance) {
  Random random(1);
  std::vector<BezierMap> convex, ells, combs, polygons, sizes;
  for (int k = 0; k < 12; ++k) {
    convex.push_back(test::polygon_chart(test::regular(3 + k, random.uniform(0.5, 2))));
    ells.push_back(test::polygon_chart(
        test::turned(test::ell(random.uniform(1, 3), 0.4), random.uniform(0, 6))));
    combs.push_back(test::polygon_chart(test::comb(3 + k % 4, 4)));
  }
  for (int k = 0; k < 300; ++k) {
    polygons.push_back(test::polygon_chart(test::random_polygon(random, random.uniform(0.1, 1))));
    if (k < 60)
      sizes.push_back(
          test::polygon_chart(test::random_polygon(random, std::pow(10, -3 * (k / 59.0)))));
  }
  expect_packed(convex, {}, 1, "convex");
  expect_packed(ells, {}, 1, "L-shapes");
  expect_packed(combs, {}, 1, "combs");
  expect_packed(polygons, {}, 1, "polygons");
  expect_packed(sizes, {}, 1, "sizes");
}

}  // namespace
}  // namespace majorant
