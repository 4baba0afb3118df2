// A map in parts within one process: refusals and counts are those of parametrize() for the whole
// map.
#include "apps/mpi/parametrize_parts.h"

#include <gtest/gtest.h>

#include "expected_error.h"
#include "majorant/mesh/repair.h"
#include "mesh/test_meshes.h"

namespace majorant {
namespace {

std::shared_ptr<const MeshPart> one_part(const SurfaceMesh& mesh) {
  return std::make_shared<const MeshPart>(
      distributed(&mesh, std::vector<int>(to_size(mesh.face_count()), 0), one_process()));
}

// Returns x and y of a grid's vertices.
Vec from_above(const SurfaceMesh& mesh) {
  const RowMatrix xy = mesh.positions().leftCols<2>();
  return xy.reshaped<Eigen::RowMajor>();
}

class Parts : public testing::Test {
 protected:
  ParametrizationResult whole() const {
    RunRecord record;
    return parametrize(BezierMap::linear(mesh_, uv_), options_, record);
  }
  ParametrizationResult parts() const {
    RunRecord record;
    return parametrize_parts(one_part(*mesh_), uv_, options_, record);
  }
  void expect_refused_alike(ErrorKind kind) const {
    const std::string message = error_message(kind, [&] { whole(); });
    EXPECT_FALSE(message.empty());
    EXPECT_EQ(error_message(kind, [&] { parts(); }), message);
  }
  void expect_solved_alike() const {
    const ParametrizationResult a = whole();
    const ParametrizationResult b = parts();
    EXPECT_EQ(a.status, b.status) << b.message;
    EXPECT_NEAR(a.measures.value, b.measures.value, 1e-12 * a.measures.value);
    EXPECT_EQ(a.injectivity_tests, b.injectivity_tests);
    EXPECT_EQ(a.handle_distance, b.handle_distance);
  }

  std::shared_ptr<const SurfaceMesh> mesh_ =
      std::make_shared<const SurfaceMesh>(SurfaceMesh::from_polygons(grid(4, bumpy)));
  Vec uv_ = from_above(*mesh_);
  ParametrizationOptions options_;
};

TEST_F(Parts, VerticesHeldTwiceAreRefused) {
  options_.map.handles = {{12, Vector2(0.5, 0.5)}, {12, Vector2(0.6, 0.5)}};
  expect_refused_alike(ErrorKind::Unsupported);
  options_.map.handles = {{12, Vector2(0.5, 0.5)}};
  options_.map.pins = {{12, {}}};
  expect_refused_alike(ErrorKind::Unsupported);
  options_.map.handles = {};
  options_.map.pins = {{12, {}}, {12, {}}};
  expect_refused_alike(ErrorKind::Unsupported);
}

TEST_F(Parts, HandlesOutOfReachAreRefused) {
  options_.map.handles = {{12, Vector2(1e31, 0)}};
  expect_refused_alike(ErrorKind::Unsupported);
}

TEST_F(Parts, VerticesThatDoNotExistAreRefused) {
  for (auto* points : {&options_.map.pins, &options_.map.handles}) {
    *points = {{25, {}}};
    expect_refused_alike(ErrorKind::Usage);
    points->clear();
  }
}

TEST_F(Parts, PinsAwayFromTheStartAreRefused) {
  options_.map.pins = {{12, Vector2(2, 2)}};
  const std::string message = error_message(ErrorKind::Infeasible, [&] { parts(); });
  expect_contains(message,
                  {"the pin of vertex ", " away from (0.5, 0.5), its place in the initial map"});
}

TEST_F(Parts, OptionsOutOfRangeAreRefused) {
  const ParametrizationOptions fine = options_;
  const auto refuse = [&](const auto& change) {
    options_ = fine;
    change(options_);
    expect_refused_alike(ErrorKind::Usage);
  };
  refuse([](auto& o) { o.map.degree = 9; });
  refuse([](auto& o) { o.map.energy.clear(); });
  refuse([](auto& o) { o.map.handle_weight = 0; });
  refuse([](auto& o) { o.map.face_weight = Vec::Ones(3); });
  refuse([](auto& o) { o.solve.tolerance = 0; });
  refuse([](auto& o) { o.solve.elevation_tolerance = -1; });
  refuse([](auto& o) { o.solve.injectivity_depth = -1; });
}

// The bisection depth may exceed the default.
TEST_F(Parts, AllDepthsOfProofsAreCounted) {
  options_.map.degree = 2;
  expect_solved_alike();
  options_.solve.injectivity_depth = 30;
  expect_solved_alike();
  EXPECT_EQ(parts().injectivity_tests.size(), 31u);
}

TEST_F(Parts, HandlesEndAtTheSameDistance) {
  options_.map.handles = {{12, Vector2(0.6, 0.4)}, {0, {}}};
  expect_solved_alike();
}

// A surface of one point: the triangles that replace its faces have a size.
TEST_F(Parts, SurfacesWithoutAnExtentHaveAScale) {
  PolygonMesh point = polygon_mesh({{2, 1, 3}, {2, 1, 3}, {2, 1, 3}}, {{0, 1, 2}});
  mesh_ = repair(point).mesh;
  ASSERT_EQ(mesh_->rest_triangles().size(), 1u);
  uv_.resize(6);
  for (Index k = 0; k < 3; ++k) uv_.segment<2>(2 * k) = mesh_->rest_triangles().front().corners[k];
  options_.map.degree = 1;
  expect_solved_alike();
}

// Faces without an area have other rest triangles, also in parts.
TEST_F(Parts, FacesWithoutAreaKeepTheirRestTriangles) {
  PolygonMesh flat_face = grid(4, bumpy);
  flat_face.positions[12] = flat_face.positions[13];
  mesh_ = repair(flat_face).mesh;
  ASSERT_EQ(mesh_->rest_triangles().size(), 2u);
  const auto part = one_part(*mesh_);
  ASSERT_EQ(part->mesh->rest_triangles().size(), 2u);
  EXPECT_EQ(part->mesh->area(), mesh_->area());
  EXPECT_EQ(part->mesh->file(), mesh_->file());
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
