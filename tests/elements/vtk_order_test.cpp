// Nodes of hexahedra and wedges have the order of VTK 9.1: PointIndexFromIJK of
// vtkLagrangeHexahedron and vtkLagrangeWedge.
#include <gtest/gtest.h>

#include "majorant/elements/bernstein_space.h"

namespace majorant {
namespace {

using Place = std::array<int, 3>;

template <class Space>
BernsteinElement element_of(int corners, int degree) {
  Cells cell(1, corners);
  for (Index k = 0; k < corners; ++k) cell(0, k) = k;
  return Space(cell, corners, degree).element();
}

TEST(VtkOrder, Hexahedra) {
  const std::vector<Place> quadratic{
      {0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 2}, {2, 0, 2}, {2, 2, 2},
      {0, 2, 2}, {1, 0, 0}, {2, 1, 0}, {1, 2, 0}, {0, 1, 0}, {1, 0, 2}, {2, 1, 2},
      {1, 2, 2}, {0, 1, 2}, {0, 0, 1}, {2, 0, 1}, {2, 2, 1}, {0, 2, 1}, {0, 1, 1},
      {2, 1, 1}, {1, 0, 1}, {1, 2, 1}, {1, 1, 0}, {1, 1, 2}, {1, 1, 1}};
  std::vector<Place> found;
  const BernsteinElement e = element_of<BezierHexahedronSpace>(8, 2);
  for (const Exponents& x : e.functions(e.degrees())) found.push_back({x[1], x[3], x[5]});
  EXPECT_EQ(found, quadratic);
  // Degree 3, the edges in t and the first face.
  const std::vector<Place> cubic{{0, 0, 1}, {0, 0, 2}, {3, 0, 1}, {3, 0, 2}, {3, 3, 1}, {3, 3, 2},
                                 {0, 3, 1}, {0, 3, 2}, {0, 1, 1}, {0, 2, 1}, {0, 1, 2}, {0, 2, 2}};
  found.clear();
  const BernsteinElement c = element_of<BezierHexahedronSpace>(8, 3);
  for (const Exponents& x : c.functions(c.degrees())) found.push_back({x[1], x[3], x[5]});
  EXPECT_TRUE(std::equal(cubic.begin(), cubic.end(), found.begin() + 24));
}

TEST(VtkOrder, Wedges) {
  const std::vector<Place> cubic{
      {0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {0, 0, 3}, {3, 0, 3}, {0, 3, 3}, {1, 0, 0}, {2, 0, 0},
      {2, 1, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}, {1, 0, 3}, {2, 0, 3}, {2, 1, 3}, {1, 2, 3},
      {0, 2, 3}, {0, 1, 3}, {0, 0, 1}, {0, 0, 2}, {3, 0, 1}, {3, 0, 2}, {0, 3, 1}, {0, 3, 2},
      {1, 1, 0}, {1, 1, 3}, {1, 0, 1}, {2, 0, 1}, {1, 0, 2}, {2, 0, 2}, {2, 1, 1}, {1, 2, 1},
      {2, 1, 2}, {1, 2, 2}, {0, 2, 1}, {0, 1, 1}, {0, 2, 2}, {0, 1, 2}, {1, 1, 1}, {1, 1, 2}};
  std::vector<Place> found;
  const BernsteinElement e = element_of<BezierWedgeSpace>(6, 3);
  for (const Exponents& x : e.functions(e.degrees())) found.push_back({x[1], x[2], x[4]});
  EXPECT_EQ(found, cubic);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
