// Planar meshes deformed by handles and pins.
#include "expected_error.h"
#include "majorant/certify/global_injectivity.h"
#include "majorant/parametrization/solve/parametrize.h"
#include "parametrization/solve/parametrize_expectations.h"

namespace majorant {
namespace {

// Returns the rectangle [0, 4] x [0, 1].
PolygonMesh bar() {
  PolygonMesh mesh = grid(12);
  for (Vector3& p : mesh.positions) p.x() *= 4;
  return mesh;
}

Index vertex_at(const SurfaceMesh& mesh, double x, double y) {
  Index v = 0;
  (mesh.positions().leftCols(2).rowwise() - Eigen::RowVector2d(x, y))
      .rowwise()
      .squaredNorm()
      .minCoeff(&v);
  return v;
}

// Pins the left end, and the right one turned by `angle` around (4, 0.5) and translated.
std::vector<Pin> turned_end(const SurfaceMesh& mesh, double angle) {
  std::vector<Pin> points;
  for (const double y : {0.0, 1.0 / 3, 2.0 / 3, 1.0}) {
    points.push_back({vertex_at(mesh, 0, y), Vector2(0, y)});
    const Vector2 end(2.4 - std::sin(angle) * (y - 0.5), 1.8 + std::cos(angle) * (y - 0.5));
    points.push_back({vertex_at(mesh, 4, y), end});
  }
  return points;
}

double distance(const BezierMap& map, const std::vector<Pin>& points) {
  double most = 0;
  for (const Pin& p : points)
    most = std::max(most, (map.control_points().segment<2>(2 * p.vertex) - *p.target).norm());
  return most;
}

ParametrizationResult run(const BezierMap& rest, const ParametrizationOptions& o) {
  RunRecord record;
  return deform(rest, o, record);
}

TEST(Deform, SoftHandlesAreReachedNearlyAndPinsExactly) {
  const BezierMap rest = planar_map(surface(bar()));
  const std::vector<Pin> targets = turned_end(rest.mesh(), 2);
  for (const MapInjectivity injectivity : {MapInjectivity::Local, MapInjectivity::Global})
    for (int n = 1; n <= 3; ++n) {
      ParametrizationOptions o = degree(n);
      o.map.injectivity = injectivity;
      o.map.handles = targets;
      const ParametrizationResult soft = run(rest, o);
      expect_valid(soft, n);
      EXPECT_EQ(static_cast<int>(soft.status), static_cast<int>(Status::Converged));
      EXPECT_LE(distance(*soft.map, targets), 0.01 * std::sqrt(17.0));
      EXPECT_NEAR(soft.handle_distance, distance(*soft.map, targets), 1e-12);
      std::swap(o.map.handles, o.map.pins);
      const ParametrizationResult hard = run(rest, o);
      expect_valid(hard, n);
      EXPECT_EQ(static_cast<int>(hard.status), static_cast<int>(Status::Converged));
      EXPECT_LE(distance(*hard.map, targets), 1e-14);
      EXPECT_GE(hard.measures.value, soft.measures.value - 1e-6);
      if (injectivity != MapInjectivity::Global) continue;
      for (const auto* r : {&soft, &hard})
        EXPECT_EQ(static_cast<int>(check_boundary(*r->map).result),
                  static_cast<int>(ProofStatus::Proven));
    }
}

TEST(Deform, TargetsAtTheVerticesChangeNothing) {
  const BezierMap rest = planar_map(surface(bar()));
  ParametrizationOptions o = degree(2);
  for (const double x : {0.0, 2.0, 4.0}) o.map.pins.push_back({vertex_at(rest.mesh(), x, 0), {}});
  const ParametrizationResult r = run(rest, o);
  expect_valid(r, 2);
  EXPECT_NEAR(r.measures.value, 4, 1e-12);
  EXPECT_LE((r.map->control_points() - rest.elevated().control_points()).lpNorm<Eigen::Infinity>(),
            1e-7);
}

TEST(Deform, HandlesAndPinsTogether) {
  const BezierMap rest = planar_map(surface(bar()));
  ParametrizationOptions o = degree(2);
  o.map.pins = {{vertex_at(rest.mesh(), 0, 0), Vector2(0, 0)},
                {vertex_at(rest.mesh(), 0, 1), Vector2(0, 1)}};
  o.map.handles = {{vertex_at(rest.mesh(), 4, 1), Vector2(3, 3)}};
  const ParametrizationResult r = run(rest, o);
  expect_valid(r, 2);
  EXPECT_LE(distance(*r.map, o.map.pins), 1e-14);
  EXPECT_LE(distance(*r.map, o.map.handles), 0.05);
}

TEST(PlanarMap, IsTheIdentity) {
  const BezierMap rest = planar_map(surface(bar()));
  for (Index v = 0; v < rest.mesh().vertex_count(); ++v)
    EXPECT_EQ(rest.control_points().segment<2>(2 * v),
              rest.mesh().positions().row(v).head<2>().transpose());
}

TEST(PlanarMap, OfReversedFacesIsSeenFromBelow) {
  PolygonMesh mesh = bar();
  for (const auto polygon : mesh.polygons) std::swap(polygon[0], polygon[1]);
  const BezierMap rest = planar_map(surface(mesh));
  for (Index v = 0; v < rest.mesh().vertex_count(); ++v) {
    EXPECT_EQ(rest.control_points()[2 * v], -rest.mesh().positions()(v, 0));
    EXPECT_EQ(rest.control_points()[2 * v + 1], rest.mesh().positions()(v, 1));
  }
  EXPECT_EQ(static_cast<int>(check_boundary(rest).result), static_cast<int>(ProofStatus::Proven));
  ParametrizationOptions o = degree(1);
  o.map.handles = {{0, Vector2(0.1, -0.1)}};
  expect_valid(run(rest, o), 1);
}

TEST(PlanarMap, RefusesSurfacesThatAreNotPlanar) {
  PolygonMesh mesh = bar();
  for (Vector3& p : mesh.positions) p.z() = 7;  // any plane z = const
  planar_map(surface(mesh));
  mesh.positions[20].z() += 1e-3;
  expect_contains(error_message(ErrorKind::Unsupported, [&] { planar_map(surface(mesh)); }),
                  {"inline.obj", "vertex 21", "off the plane"});
  mesh = bar();
  mesh.positions[4 * 13 + 5].x() += 0.7;  // beyond its neighbour, at distance 1/3
  expect_contains(error_message(ErrorKind::Unsupported, [&] { planar_map(surface(mesh)); }),
                  {"inline.obj", "face", "inverted"});
}

TEST(Deform, PinsThatCannotBeReachedAreNamed) {
  const BezierMap rest = planar_map(surface(bar()));
  const Cells& faces = rest.mesh().faces();
  ParametrizationOptions o = degree(1);  // two corners of a face exchanged: it would be inverted
  const Index a = faces(40, 0), b = faces(40, 1), c = faces(40, 2);
  const auto place = [&](Index v) { return Vector2(rest.control_points().segment<2>(2 * v)); };
  o.map.pins = {{a, place(b)}, {b, place(a)}, {c, place(c)}};
  const std::string message = error_message(ErrorKind::Infeasible, [&] { run(rest, o); });
  expect_contains(message, {"inline.obj", "no valid way to the pins' targets", "vertex "});
  EXPECT_TRUE(message.find("vertex " + std::to_string(a) + " ") != std::string::npos ||
              message.find("vertex " + std::to_string(b) + " ") != std::string::npos ||
              message.find("vertex " + std::to_string(c) + " ") != std::string::npos)
      << message;
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
