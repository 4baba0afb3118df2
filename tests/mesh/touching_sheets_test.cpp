// Sheets that touch in a vertex are refused with its number, and nothing is printed.
#include <gtest/gtest.h>

#include "expected_error.h"
#include "mesh/test_meshes.h"

namespace majorant {
namespace {

struct Surface {
  const char* name;
  PolygonMesh mesh;
  Index touching;  // vertex, counted from 1; 0: a valid surface
};

PolygonMesh with_faces(const std::vector<std::vector<Index>>& faces) {
  std::vector<Vector3> positions;
  for (int v = 0; v < 12; ++v)  // no three are collinear
    positions.push_back({std::cos(0.5 * v), std::sin(0.5 * v), 0.1 * v * v});
  return polygon_mesh(positions, faces);
}

std::vector<Surface> odd_surfaces() {
  const std::vector<std::vector<Index>> ball{{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {0, 2, 3}};
  std::vector<std::vector<Index>> balls = ball, ball_and_fin = ball;
  for (const auto& f : ball) {
    balls.push_back({});
    for (const Index v : f) balls.back().push_back(v == 2 ? 2 : v + 4);
  }
  ball_and_fin.insert(ball_and_fin.begin() + 2, {3, 8, 9});
  return {{"disk", grid(4, bumpy), 0},
          {"torus", torus(6, 5, 0), 0},
          {"bow tie", with_faces({{0, 1, 2}, {2, 3, 4}}), 3},
          {"ring", with_faces({{7, 1, 2}, {2, 3, 4}, {4, 5, 7}}), 3},
          {"balls", with_faces(balls), 3},
          {"ball and fin", with_faces(ball_and_fin), 4}};
}

void expect_silence(const Surface& s) {
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  if (s.touching == 0)
    EXPECT_GT(SurfaceMesh::from_polygons(s.mesh).area(), 0);
  else
    expect_contains(
        error_message(ErrorKind::Unsupported, [&] { SurfaceMesh::from_polygons(s.mesh); }),
        {"inline.obj: vertex " + std::to_string(s.touching) + ": sheets of the surface touch"});
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(SurfaceMesh, RefusesSheetsThatTouch) {
  for (const Surface& s : odd_surfaces()) {
    SCOPED_TRACE(s.name);
    expect_silence(s);
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
