#include "majorant/pictures/first_view.h"

#include <Eigen/Geometry>

#include "io/io_test_helpers.h"

namespace majorant {
namespace {

// A cube around the origin, rotated so that its sides face along the axes. The side towards
// `detail` has 2 n^2 triangles, the others 2. The map does not matter.
MapFile detailed_cube(const Vector3& detail, int n) {
  MapFile map;
  std::vector<Vector3> points;
  for (int axis = 0; axis < 3; ++axis)
    for (const double way : {-1.0, 1.0}) {
      Vector3 out = Vector3::Zero(), right = out, up = out;
      out[axis] = way;
      right[(axis + 1) % 3] = way;
      up[(axis + 2) % 3] = 1;
      const int pieces = out == detail ? n : 1;
      for (int i = 0; i < pieces; ++i)
        for (int j = 0; j < pieces; ++j) {
          const auto place = [&](int a, int b) -> Vector3 {
            return out + (2.0 * a / pieces - 1) * right + (2.0 * b / pieces - 1) * up;
          };
          for (const auto& [a, b] :
               {std::pair{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j}, {i + 1, j + 1}, {i, j + 1}})
            points.push_back(place(a, b));
        }
    }
  map.points.resize(static_cast<Index>(points.size()), 3);
  for (std::size_t k = 0; k < points.size(); ++k)
    map.points.row(static_cast<Index>(k)) = points[k].transpose();
  map.uv = map.points.leftCols(2);
  map.cells = Eigen::VectorXi::LinSpaced(static_cast<Index>(points.size()), 0,
                                         static_cast<int>(points.size()) - 1)
                  .reshaped<Eigen::RowMajor>(static_cast<Index>(points.size()) / 3, 3);
  return map;
}

TEST(FirstView, SurfacesWithAFrontAreSeenFromIt) {
  MapFile map = detailed_cube(Vector3::UnitZ(), 1);
  const Eigen::AngleAxisd turn(0.7, Vector3(1, 2, 3).normalized());
  for (Index p = 0; p < map.points.rows(); ++p)
    map.points.row(p) = (turn * Vector3(map.points.row(p))).transpose();
  map.cells = Cells(map.cells.topRows(2));  // the side that faces -x
  EXPECT_LT((first_view(map) - turn * -Vector3::UnitX()).norm(), 1e-12);
}

TEST(FirstView, DetailsAreSeen) {
  for (const Vector3& side :
       {Vector3(0, 0, 1), Vector3(0, 0, -1), Vector3(1, 0, 0), Vector3(-1, 0, 0)}) {
    const Vector3 eye = first_view(detailed_cube(side, 6));
    EXPECT_NEAR(eye.norm(), 1, 1e-12);
    EXPECT_GT(eye.dot(side), 0.5) << side.transpose();
    EXPECT_GT(eye.y(), 0);
  }
}

TEST(FirstView, IsTheFirstIfAllDirectionsLookAlike) {
  MapFile ball = detailed_cube(Vector3::UnitZ(), 1);
  ball.points.rowwise().normalize();
  for (const double scale : {1.0, 0x1p-600, 0x1p600}) {
    MapFile scaled = ball;
    scaled.points *= scale;
    EXPECT_EQ(first_view(scaled), first_view(ball)) << scale;
  }
  EXPECT_GT(first_view(ball).z(), 0);
  MapFile nothing = ball;  // no area from any direction
  nothing.points.setZero();
  EXPECT_NEAR(first_view(nothing).norm(), 1, 1e-12);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
