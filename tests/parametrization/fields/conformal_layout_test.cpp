// Layouts of conformal metrics: corners agree, transitions of seams are quarter turns, areas are
// kept.
#include <filesystem>

#include "expected_error.h"
#include "majorant/parametrization/fields/conformal_metric.h"
#include "majorant/parametrization/fields/internal/intrinsic_triangulation.h"
#include "mesh/obj_file.h"
#include "parametrization/fields/closed_surfaces.h"
#include "public_data.h"

namespace majorant {
namespace {

Vector2 corner(const CornerPoints& uv, Index c) {
  return uv.row(face_of(c)).segment<2>(2 * corner_of(c)).transpose();
}
Vector2 edge(const CornerPoints& uv, Index h) { return corner(uv, next(h)) - corner(uv, h); }

double signed_area(const CornerPoints& uv, Index f) {
  const Vector2 b = edge(uv, 3 * f), c = -edge(uv, 3 * f + 2);
  return 0.5 * cross(b, c);
}

// Expects a layout of an exact metric: equal doubles at both sides of uncut edges, and edge lengths
// of the metric, so that both images of a cut edge have equal length.
void expect_layout(const SurfaceMesh& mesh, const ConformalMetric& metric,
                   const std::vector<char>& is_cut) {
  const CornerPoints uv = lay_out(mesh, metric, is_cut);
  ASSERT_EQ(uv.rows(), mesh.face_count());
  const Vec log_lengths = IntrinsicTriangulation(mesh).log_lengths(metric.log_factor);
  double area = 0;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    EXPECT_GT(signed_area(uv, f), 0) << "face " << f;
    area += signed_area(uv, f);
  }
  EXPECT_NEAR(area / mesh.area(), 1, 1e-12);
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    EXPECT_NEAR(edge(uv, h).norm() / std::exp(log_lengths[h]), 1, 1e-9) << "half-edge " << h;
    const Index o = mesh.opposite(h);
    if (o < 0 || is_cut[h]) continue;
    EXPECT_EQ(corner(uv, h), corner(uv, next(o)));
    EXPECT_EQ(corner(uv, next(h)), corner(uv, o));
  }
}

// Expects transitions by multiples of 90 degrees at all cut edges.
void expect_quarter_turns(const SurfaceMesh& mesh, const CornerPoints& uv,
                          const std::vector<char>& is_cut) {
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    const Index o = mesh.opposite(h);
    if (o < 0 || !is_cut[h]) continue;
    const Vector2 here = edge(uv, h), there = -edge(uv, o);
    EXPECT_NEAR(here.norm() / there.norm(), 1, 1e-9);
    const double turn = std::atan2(here.y(), here.x()) - std::atan2(there.y(), there.x());
    EXPECT_NEAR(std::remainder(turn, kPi / 2), 0, 1e-8) << "half-edge " << h;
  }
}

TEST(LayOut, CubeUnfolds) {
  const auto mesh = surface(cube(3));
  const auto turns = quarter_turns_at(*mesh, cube_corners(Vector3::Constant(1.5), 1.5), 3);
  const ConformalMetric metric = conformal_metric(*mesh, turns);
  const auto is_cut = cut_through_cones(*mesh, turns);
  expect_layout(*mesh, metric, is_cut);
  const CornerPoints uv = lay_out(*mesh, metric, is_cut);
  expect_quarter_turns(*mesh, uv, is_cut);
  for (Index f = 0; f < mesh->face_count(); ++f) EXPECT_NEAR(signed_area(uv, f), 0.5, 1e-12);
}

TEST(LayOut, SphereWithConesIsSeamless) {
  const auto mesh = surface(sphere(8));
  std::vector<Vector3> points = cube_corners(Vector3::Zero(), 1);
  for (const int turns : {3, 2}) {
    // the corners of a tetrahedron
    if (turns == 2) points = {points[0], points[3], points[5], points[6]};
    const auto required = quarter_turns_at(*mesh, points, turns);
    const ConformalMetric metric = conformal_metric(*mesh, required);
    const auto is_cut = cut_through_cones(*mesh, required);
    expect_layout(*mesh, metric, is_cut);
    expect_quarter_turns(*mesh, lay_out(*mesh, metric, is_cut), is_cut);
  }
}

TEST(LayOut, TorusIsAParallelogram) {
  const auto mesh = surface(torus(24, 12, 0));
  const std::vector<int> turns(to_size(mesh->vertex_count()), 4);
  const ConformalMetric metric = conformal_metric(*mesh, turns);
  const auto is_cut = cut_through_cones(*mesh, turns);
  expect_layout(*mesh, metric, is_cut);
  // On a torus without cones, the layout is only translated around handles.
  expect_quarter_turns(*mesh, lay_out(*mesh, metric, is_cut), is_cut);
}

TEST(LayOut, DiskNeedsNoCut) {
  for (const auto& mesh : {surface(grid(9, bumpy)), generated("cap"), surface(cone(5, false))}) {
    const std::vector<int> turns(to_size(mesh->vertex_count()), 4);
    const ConformalMetric metric = conformal_metric(*mesh, turns);
    expect_layout(*mesh, metric, std::vector<char>(to_size(mesh->half_edge_count()), 0));
  }
}

TEST(LayOut, RefusesSurfacesThatAreNoDisks) {
  const auto mesh = surface(cube(2));
  const auto turns = quarter_turns_at(*mesh, cube_corners(Vector3::Constant(1), 1), 3);
  const ConformalMetric metric = conformal_metric(*mesh, turns);
  std::vector<char> is_cut(to_size(mesh->half_edge_count()), 0);
  expect_contains(error_message(ErrorKind::Usage, [&] { lay_out(*mesh, metric, is_cut); }),
                  {"inline.obj", "not a disk", "0 boundary loops"});
  is_cut[7] = 1;
  expect_contains(error_message(ErrorKind::Usage, [&] { lay_out(*mesh, metric, is_cut); }),
                  {"inline.obj", "one side only"});
  is_cut.pop_back();
  expect_contains(error_message(ErrorKind::Usage, [&] { lay_out(*mesh, metric, is_cut); }),
                  {"inline.obj", "143", "144"});
}

// Public models with eight cones: seams fit up to rounding, few faces are inverted.
TEST(LayOut, PublicModels) {
  const std::filesystem::path folder = public_data("closed");
  if (folder.empty()) GTEST_SKIP() << kNoPublicData;
  for (const char* name : {"spot_1654", "blub_1886", "goathead_5522", "scorpion_12626"}) {
    SCOPED_TRACE(name);
    const auto mesh = surface(obj_file((folder / (std::string(name) + ".obj")).string()));
    ASSERT_EQ(mesh->topology().euler_characteristic(), 2);
    std::vector<int> turns(to_size(mesh->vertex_count()), 4);
    for (const Index v : spread_vertices(*mesh, 8)) turns[v] = 3;
    const ConformalMetric metric = conformal_metric(*mesh, turns);
    EXPECT_LT(metric.angle_error, 1e-11);
    EXPECT_EQ(metric.open_faces, 0);
    EXPECT_LE(metric.broken_faces, 5);
    const auto is_cut = cut_through_cones(*mesh, turns);
    const CornerPoints uv = lay_out(*mesh, metric, is_cut);
    const double rounding = 1e-14 * uv.cwiseAbs().maxCoeff();
    double area = 0;
    for (Index f = 0; f < mesh->face_count(); ++f) area += std::abs(signed_area(uv, f));
    EXPECT_NEAR(area / mesh->area(), 1, 1e-12);
    for (Index h = 0; h < mesh->half_edge_count(); ++h) {
      const Index o = mesh->opposite(h);
      if (!is_cut[h]) continue;
      const Vector2 here = edge(uv, h), there = -edge(uv, o);
      EXPECT_NEAR(here.norm(), there.norm(), 1e-9 * here.norm() + rounding);
      // Edges are parallel or perpendicular.
      EXPECT_LT(std::min(std::abs(cross(here, there)), std::abs(here.dot(there))),
                here.norm() * (1e-8 * there.norm() + rounding));
    }
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
