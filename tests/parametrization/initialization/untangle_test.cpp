// Untangling: maps with inverted triangles become injective where the constraints allow it.
#include "majorant/parametrization/initialization/untangle.h"

#include <gtest/gtest.h>

#include <random>

#include "expected_error.h"
#include "majorant/constraints/local_injectivity.h"
#include "majorant/parametrization/initialization/start.h"
#include "mesh/surfaces_of_any_genus.h"
#include "mesh/test_meshes.h"

namespace majorant {
namespace {

// A flat grid of n by n squares on the unit square, with the identity as map.
struct Square {
  explicit Square(int n)
      : mesh(SurfaceMesh::from_polygons(grid(n))),
        space(std::make_shared<const BezierTriangleSpace>(mesh.faces(), mesh.vertex_count(), 1)),
        identity(2 * mesh.vertex_count()) {
    spec.rest = std::make_shared<const RestShapes>(flat_triangles(mesh.positions(), mesh.faces()));
    for (Index v = 0; v < mesh.vertex_count(); ++v)
      identity.segment<2>(2 * v) = mesh.positions().row(v).head<2>();
  }
  bool on_boundary(Index v) const {
    const Vector2 p = identity.segment<2>(2 * v);
    return p.minCoeff() == 0 || p.maxCoeff() == 1;
  }
  // Returns the identity with random inner vertices in the square.
  Vec shuffled(unsigned seed) const {
    std::mt19937 random(seed);
    Vec x = identity;
    for (Index v = 0; v < mesh.vertex_count(); ++v)
      if (!on_boundary(v))
        for (const Index k : {2 * v, 2 * v + 1}) x[k] = (random() % 1024) / 1024.0;
    return x;
  }
  void expect_valid(const UntangleResult& result) const {
    EXPECT_TRUE(result.inverted.empty());
    ASSERT_TRUE(result.x.allFinite());
    EXPECT_TRUE(LocalInjectivity(space, 2 * spec.rest->measure).check(result.x).feasible);
    EXPECT_TRUE(AngleSums(space, AngleSums::Vertices::Interior).check(result.x).feasible);
  }

  SurfaceMesh mesh;
  std::shared_ptr<const BezierTriangleSpace> space;
  MapSpecification spec;
  Vec identity;
};

TEST(Untangle, ShuffledGridWithFixedBoundary) {
  Square square(8);
  square.spec.boundary = BoundaryCondition::Fixed;
  for (unsigned seed = 0; seed < 10; ++seed) {
    const Vec start = square.shuffled(seed);
    const UntangleResult result = untangle(square.spec, square.space, start, RunRecord());
    square.expect_valid(result);
    EXPECT_GT(result.iterations, 0);
    EXPECT_LT(result.iterations, 200);
    for (Index v = 0; v < square.mesh.vertex_count(); ++v) {
      if (!square.on_boundary(v)) continue;
      EXPECT_EQ(Vector2((result.x - start).segment<2>(2 * v)), Vector2(0, 0)) << v;
    }
  }
}

TEST(Untangle, MirroredGrid) {
  const Square square(6);
  Vec mirrored = square.identity;
  for (Index v = 0; v < square.mesh.vertex_count(); ++v) mirrored[2 * v] *= -1;
  square.expect_valid(untangle(square.spec, square.space, mirrored, RunRecord()));
}

TEST(Untangle, OneFoldedVertexWithPins) {
  Square square(6);
  Vec folded = square.identity;
  folded.segment<2>(2 * 24) += Vector2(0.4, 0.3);
  for (const Index v : {0, 6, 42, 48})
    square.spec.pins.push_back({v, square.identity.segment<2>(2 * v)});
  const UntangleResult result = untangle(square.spec, square.space, folded, RunRecord());
  square.expect_valid(result);
  for (const FixedPoint& pin : square.spec.pins)
    EXPECT_EQ(Vector2(result.x.segment<2>(2 * pin.node)), pin.position);
}

TEST(Untangle, LeavesInjectiveMapsAlone) {
  const Square square(4);
  const UntangleResult result = untangle(square.spec, square.space, square.identity, RunRecord());
  square.expect_valid(result);
  EXPECT_EQ(result.iterations, 0);
  EXPECT_LE((result.x - square.identity).cwiseAbs().maxCoeff(), 1e-15);
}

// A clockwise boundary admits no injective map. The minimum of the energy is the mirror image of an
// injective map, and later rounds take no steps: 11 steps in all, of 2000 allowed.
TEST(Untangle, ImpossibleBoundary) {
  Square square(4);
  square.spec.boundary = BoundaryCondition::Fixed;
  Vec mirrored = square.shuffled(1);
  for (Index v = 0; v < square.mesh.vertex_count(); ++v) mirrored[2 * v] *= -1;
  const UntangleResult result = untangle(square.spec, square.space, mirrored, RunRecord());
  EXPECT_EQ(static_cast<Index>(result.inverted.size()), square.mesh.face_count());
  EXPECT_TRUE(result.x.allFinite());
  EXPECT_GT(result.iterations, 0);
  EXPECT_LT(result.iterations, 100);
}

TEST(Untangle, EndsWithItsTime) {
  Square square(8);
  square.spec.boundary = BoundaryCondition::Fixed;
  const RunRecord record(StopCheck([] { return Directive::TimeLimit; }));
  const UntangleResult result = untangle(square.spec, square.space, square.shuffled(1), record);
  EXPECT_LE(result.iterations, 1);
  EXPECT_FALSE(result.inverted.empty());
}

// ---- Seamless maps ----
void expect_seamless(const SurfaceMesh& mesh, const Start& made, const std::vector<Cone>& cones) {
  const RestShapes rest = flat_triangles(made.map.mesh().positions(), made.map.mesh().faces());
  EXPECT_TRUE(LocalInjectivity(made.map.shared_space(), 2 * rest.measure)
                  .check(made.map.control_points())
                  .feasible);
  EXPECT_TRUE(
      AngleSums(made.map.shared_space(), AngleSums::Vertices::Interior, made.map.shared_seams())
          .check(made.map.control_points())
          .feasible);
  std::vector<int> turns(to_size(mesh.vertex_count()), 4);
  for (const auto& loop : mesh.boundary_loops())
    for (const Index v : loop) turns[v] = 0;
  for (const Cone& cone : cones) turns[cone.vertex] = cone.quarter_turns;
  EXPECT_EQ(made.map.seams().quarter_turns(), turns);
}

// Where the plain field gives no seamless map for random cones, a field with a metric's lengths
// often does.
TEST(MakeSeamless, ScaledFieldsRescueRandomCones) {
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(torus(32, 20, 0));
  int by_field = 0, by_any = 0, by_scaled = 0;
  for (unsigned seed = 0; seed < 6; ++seed) {
    std::mt19937 random(seed);
    std::vector<Cone> cones;
    while (cones.size() < 20) {
      const auto v = static_cast<Index>(random() % static_cast<unsigned>(mesh.vertex_count()));
      const int turns = cones.size() % 2 ? 5 : 3;
      if (std::none_of(cones.begin(), cones.end(), [v](const Cone& c) { return c.vertex == v; }))
        cones.push_back({v, turns});
    }
    SeamlessOptions options;
    options.cones = cones;
    for (const SeamlessMethod method : {SeamlessMethod::Field, SeamlessMethod::Automatic}) {
      options.method = method;
      try {
        const Start made = make_seamless(mesh, options, RunRecord());
        expect_seamless(mesh, made, cones);
        by_scaled += made.method == SeamlessMethod::ScaledField;
        ++(method == SeamlessMethod::Field ? by_field : by_any);
      } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::Invalid) << error.what();
      }
    }
  }
  EXPECT_LT(by_field, by_any);
  EXPECT_EQ(by_scaled, by_any - by_field);
  EXPECT_EQ(by_any, 6);
}

TEST(MakeSeamless, NoConesOnTori) {
  for (const auto& [m, n] : {std::pair{3, 3}, {4, 3}, {12, 8}}) {
    const SurfaceMesh mesh = SurfaceMesh::from_polygons(torus(m, n, 0));
    SeamlessOptions options;
    options.cones.emplace();
    expect_seamless(mesh, make_seamless(mesh, options, RunRecord()), {});
  }
}

// A torus with one cone of index 1/4 and one of -1/4 has no seamless map.
TEST(MakeSeamless, ImpossibleConesAreNamed) {
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(torus(12, 8, 0));
  SeamlessOptions options;
  options.cones = std::vector<Cone>{{5, 3}, {60, 5}};
  const std::string message =
      error_message(ErrorKind::Invalid, [&] { make_seamless(mesh, options, RunRecord()); });
  expect_contains(message,
                  {"inline.obj", "no injective seamless map", "cone", "choose other cones"});
  EXPECT_TRUE(message.find(" 5 (270 degrees)") != std::string::npos ||
              message.find(" 60 (450 degrees)") != std::string::npos)
      << message;
}

TEST(MakeSeamless, ConformalNeedsASphereOrADisk) {
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(torus(12, 8, 0));
  SeamlessOptions options;
  options.method = SeamlessMethod::Conformal;
  expect_contains(
      error_message(ErrorKind::Usage, [&] { make_seamless(mesh, options, RunRecord()); }),
      {"sphere or a disk", "SeamlessMethod::ScaledField"});
}

TEST(MakeSeamless, EverySurface) {
  for (const auto& [name, polygons] : surfaces_of_any_genus()) {
    SCOPED_TRACE(name);
    if (name == "coarse torus") continue;  // its field has the two cones that admit no map
    const SurfaceMesh mesh = SurfaceMesh::from_polygons(polygons);
    const Start made = make_seamless(mesh, {}, RunRecord());
    expect_seamless(mesh, made, made.map.seams().cones());
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
