// Pins and fixed boundaries.
#include <gtest/gtest.h>

#include "majorant/constraints/constraints.h"
#include "majorant/framework/elimination.h"
#include "majorant/framework/error.h"
#include "support.h"

namespace majorant {
namespace {

TEST(FixedPoints, RowsNameCoordinateAndNode) {
  ConstraintRows rows;
  FixedPoints({{12, {0.1, -0.2}}, {3, {5, 6}}}).append_rows(rows);
  ASSERT_EQ(rows.size(), 4u);
  const Index unknowns[] = {24, 25, 6, 7};
  const double targets[] = {0.1, -0.2, 5, 6};
  for (std::size_t r = 0; r < 4; ++r) {
    ASSERT_EQ(rows.end(r) - rows.begin(r), 1);
    EXPECT_EQ(rows.begin(r)->unknown, unknowns[r]);
    EXPECT_EQ(rows.begin(r)->coefficient, 1);
    EXPECT_EQ(rows.rhs(r), targets[r]);
  }
  EXPECT_NE(rows.label(0).find("u of node 12"), std::string::npos);
  EXPECT_NE(rows.label(3).find("v of node 3"), std::string::npos);
}

TEST(FixedPoints, AtHoldsTheCoordinatesExactly) {
  test::Random random(1);
  const Vec x = random.vector(20);
  ConstraintRows rows;
  FixedPoints::at({1, 4, 9}, x).append_rows(rows);
  const Elimination z(20, rows);
  EXPECT_EQ(z.reduced_size(), 14);
  double residual = -1;
  Vec back;
  z.expand(z.reduce(x, &residual), back);
  EXPECT_EQ(back, x);
  EXPECT_EQ(residual, 0);
  z.expand(random.vector(14), back);
  for (const Index node : {1, 4, 9}) EXPECT_EQ(back.segment<2>(2 * node), x.segment<2>(2 * node));
}

TEST(FixedPoints, TheSamePinTwiceIsFineTwoTargetsAreNot) {
  ConstraintRows same, different;
  FixedPoints({{1, {0.1, 0.2}}, {1, {0.1, 0.2}}}).append_rows(same);
  EXPECT_EQ(Elimination(4, same).rank(), 2);
  FixedPoints({{1, {0.1, 0.2}}, {1, {0.1, 0.3}}}).append_rows(different);
  try {
    const Elimination z(4, different);
    FAIL() << "accepted";
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("v of node 1"), std::string::npos) << e.what();
  }
}

TEST(FixedPoints, NodesOutsideAreRefused) {
  ConstraintRows rows;
  FixedPoints({{7, {0, 0}}}).append_rows(rows);
  EXPECT_ANY_THROW(Elimination(4, rows));
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
