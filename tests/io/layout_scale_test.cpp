#include "majorant/io/layout_scale.h"

#include "io_test_helpers.h"
#include "majorant/elements/quadrature.h"

namespace majorant {
namespace {

double integrated_area(const MapFile& file, Index c, const Quadrature& rule) {
  double area = 0;
  for (Index l = 0; l < rule.size(); ++l) {
    const Eigen::MatrixX2d g =
        bernstein_gradients(file.degree, Barycentric(rule.points.row(l).transpose()));
    Eigen::Matrix2d j = Eigen::Matrix2d::Zero();
    for (Index k = 0; k < g.rows(); ++k) j += Vector2(file.uv.row(file.cells(c, k))) * g.row(k);
    area += rule.weights[l] * j.determinant() / 2;
  }
  return area;
}

TEST(LayoutScale, AreasOfCurvedCellsAreExact) {
  for (int degree = 1; degree <= 8; ++degree) {
    const MapFile file = random_strip(degree, 4, 3);
    const Quadrature rule = composite_rule(radon_rule(), degree <= 3 ? 1 : 32);
    for (Index c = 0; c < 4; ++c) {
      const double expected = integrated_area(file, c, rule);
      EXPECT_NEAR(image_area(file, c), expected, degree <= 3 ? 1e-14 : 1e-7) << degree;
    }
  }
}

TEST(LayoutScale, IsReadFromClaims) {
  MapFile file = random_strip(2, 3, 1);
  file.claims = "{}";
  EXPECT_EQ(layout_scale(file), 1);
  file.claims = R"({"normalized": null})";
  EXPECT_EQ(layout_scale(file), 1);
  file.claims = R"({"normalized": {"origin": [0, 0], "size": 12.5}})";
  EXPECT_EQ(layout_scale(file), 12.5);
  EXPECT_FALSE(has_assumed_scale(file));
}

TEST(LayoutScale, WithoutClaimsAreasAreEqual) {
  MapFile file;
  file.points.resize(4, 3);
  file.points << 0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0;  // area 4
  file.cells.resize(2, 3);
  file.cells << 0, 1, 2, 0, 2, 3;
  file.uv = file.points.leftCols<2>() / 6;
  EXPECT_TRUE(has_assumed_scale(file));
  EXPECT_DOUBLE_EQ(layout_scale(file), 6);
  file.uv.col(0) *= -1;  // a mirror image has the same scale
  EXPECT_DOUBLE_EQ(layout_scale(file), 6);
  file.uv.setZero();
  EXPECT_EQ(layout_scale(file), 1);
}

TEST(LayoutScale, DamagedClaimsAreNotBelieved) {
  MapFile file = random_strip(1, 1, 1);
  for (const char* claims : {"[1]", "{", R"({"normalized": 1})", R"({"normalized": {}})",
                             R"({"normalized": {"size": "2"}})", R"({"normalized": {"size": 0}})",
                             R"({"normalized": {"size": -1}})"}) {
    file.claims = claims;
    expect_contains(error_message(ErrorKind::Unreadable, [&] { layout_scale(file); }),
                    {"majorant_claims", "damaged"});
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
