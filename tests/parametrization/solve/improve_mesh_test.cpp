// Flips in flat parts of a surface decrease the energy and change nothing else.
#include "majorant/parametrization/scaffold/improve_mesh.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <set>

#include "majorant/constraints/constraints.h"
#include "majorant/framework/error.h"
#include "majorant/maps/measure.h"
#include "majorant/parametrization/solve/parametrize.h"
#include "parametrization/scaffold/bezier_mesh_helpers.h"

namespace majorant {
namespace {

const EnergySum kEnergy{{symmetric_dirichlet(), 1.0}};

// Returns a triangulation of the unit square, rotated and translated in space, after `bend`.
std::shared_ptr<const SurfaceMesh> placed(const PlaneTriangulation& t, const Height& bend = flat) {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized()).toRotationMatrix();
  std::vector<Vector3> positions;
  for (Index v = 0; v < t.points.rows(); ++v)
    positions.push_back(
        turn * Vector3(t.points(v, 0), t.points(v, 1), bend(t.points(v, 0), t.points(v, 1))) +
        Vector3(0.3, -0.2, 0.9));
  std::vector<std::vector<Index>> faces;
  for (Index f = 0; f < t.faces.rows(); ++f)
    faces.push_back({t.faces(f, 0), t.faces(f, 1), t.faces(f, 2)});
  return surface(polygon_mesh(positions, faces));
}

// Returns the map that takes points of the square by a deformation, in Bezier triangles of that
// degree.
using Deformation = std::function<Vector2(const Vector2&)>;
BezierMap mapped(const std::shared_ptr<const SurfaceMesh>& mesh, const PlaneTriangulation& t,
                 int degree, const Deformation& deformation) {
  auto space =
      std::make_shared<const BezierTriangleSpace>(mesh->faces(), mesh->vertex_count(), degree);
  const RowMatrix nodes = space->node_positions(t.points);
  Vec x(2 * space->node_count());
  for (Index v = 0; v < nodes.rows(); ++v)
    x.segment<2>(2 * v) = deformation(nodes.row(v).transpose());
  return BezierMap(mesh, std::move(space), std::move(x));
}

Vector2 unchanged(const Vector2& p) { return p; }
Deformation swirl_by(double part) {
  return [part](const Vector2& p) {
    return Vector2(1.6 * p[0] + part * std::sin(2 * p[1]),
                   0.7 * p[1] + 0.6 * part * std::sin(3 * p[0]));
  };
}
const Deformation swirl = swirl_by(0.25);

double mean(const BezierMap& map) {
  Vec face_value;
  return mean_density(map, flat_triangles(map.mesh().positions(), map.mesh().faces()), kEnergy,
                      face_value);
}

std::set<std::pair<double, double>> boundary_points(const BezierMap& map) {
  std::set<std::pair<double, double>> out;
  for (const Index node : map.space().boundary_nodes())
    out.insert({map.control_points()[2 * node], map.control_points()[2 * node + 1]});
  return out;
}

void expect_same_surface(const BezierMap& before, const BezierMap& after) {
  EXPECT_EQ(after.mesh().positions(), before.mesh().positions());
  EXPECT_EQ(after.mesh().face_count(), before.mesh().face_count());
  EXPECT_NEAR(after.mesh().area(), before.mesh().area(), 1e-12 * before.mesh().area());
  EXPECT_EQ(after.mesh().boundary_loops(), before.mesh().boundary_loops());
  EXPECT_EQ(after.mesh().topology().edges, before.mesh().topology().edges);
  EXPECT_EQ(boundary_points(after), boundary_points(before));
  for (Index v = 0; v < before.mesh().vertex_count(); ++v) {
    EXPECT_EQ(after.mesh().input_vertex(v), before.mesh().input_vertex(v));
    EXPECT_EQ(after.control_points().segment<2>(2 * v), before.control_points().segment<2>(2 * v));
  }
  EXPECT_EQ(after.degree(), before.degree());
}

TEST(ImproveMesh, LowersTheEnergyOfPlanarSurfaces) {
  int left_out = 0;
  for (int n = 1; n <= 4; ++n)
    for (unsigned seed = 1; seed <= 3; ++seed)
      for (const PlaneTriangulation& t : {jittered_grid(8, 0.3, seed), inserted_points(60, seed)}) {
        const auto mesh = placed(t);
        const BezierMap map = mapped(mesh, t, n, swirl_by(t.points.rows() > 70 ? 0.25 : 0.0005));
        // thin triangles under a coarse rotation field
        if (!measure_map(map, kEnergy).locally_injective) {
          ++left_out;
          continue;
        }
        const ImprovedMap improved = improve_mesh(map, kEnergy);
        EXPECT_GT(improved.flips.performed, 5) << n;
        EXPECT_LE(improved.flips.performed, improved.flips.intended);
        expect_same_surface(map, improved.map);
        const MapMeasures measures = measure_map(improved.map, kEnergy);
        EXPECT_TRUE(measures.locally_injective);
        EXPECT_LT(measures.value, mean(map));
        RecordProperty("gain_" + std::to_string(n) + "_" + std::to_string(seed) + "_" +
                           std::to_string(t.faces.rows()),
                       std::to_string(mean(map)) + " " + std::to_string(measures.value) + " " +
                           std::to_string(improved.flips.performed));
        // A second run gains nothing.
        const ImprovedMap again = improve_mesh(improved.map, kEnergy);
        EXPECT_EQ(again.flips.performed, 0);
      }
  EXPECT_LE(left_out, 6);
}

// The energy of an isometry does not depend on its triangles, which become Delaunay.
TEST(ImproveMesh, MakesIsometriesDelaunay) {
  for (int n = 1; n <= 3; ++n) {
    const PlaneTriangulation t = inserted_points(60, 4);
    const auto mesh = placed(t);
    const BezierMap map = mapped(mesh, t, n, unchanged);
    const ImprovedMap improved = improve_mesh(map, kEnergy);
    EXPECT_GT(improved.flips.performed, 30);
    expect_same_surface(map, improved.map);
    EXPECT_NEAR(mean(improved.map), 4, 1e-12);
    BezierMesh flat_mesh = bezier_mesh(n, improved.map.mesh().faces(), improved.map.space().cells(),
                                       improved.map.control_points());
    std::vector<char> none;
    EXPECT_EQ(make_delaunay(flat_mesh, none).intended, 0);
    const RowMatrix straight = improved.map.space().node_positions(t.points);
    for (Index v = 0; v < straight.rows(); ++v)
      EXPECT_LT(
          (improved.map.control_points().segment<2>(2 * v).transpose() - straight.row(v)).norm(),
          1e-6);
  }
}

TEST(ImproveMesh, LeavesCurvedSurfacesAlone) {
  const PlaneTriangulation t = jittered_grid(8, 0.2, 5);
  const auto mesh = placed(t, bumpy);
  const BezierMap map = mapped(mesh, t, 2, swirl);
  const ImprovedMap improved = improve_mesh(map, kEnergy);
  EXPECT_EQ(improved.flips.intended, 0);
  EXPECT_EQ(improved.map.shared_mesh(), map.shared_mesh());
  EXPECT_EQ(improved.map.control_points(), map.control_points());
}

// A roof of two flat sides. Its ridge and all other positions in space stay.
TEST(ImproveMesh, KeepsRidges) {
  const PlaneTriangulation t = jittered_grid(8, 0, 6);
  const auto mesh = placed(t, [](double, double y) { return -0.8 * std::abs(y - 0.5); });
  for (int n = 1; n <= 3; ++n) {
    const BezierMap map = mapped(mesh, t, n, swirl);
    const ImprovedMap improved = improve_mesh(map, kEnergy);
    EXPECT_GT(improved.flips.performed, 0);
    expect_same_surface(map, improved.map);
    EXPECT_TRUE(measure_map(improved.map, kEnergy).locally_injective);
    for (Index f = 0; f < mesh->face_count(); ++f) {
      double low = 1, high = 0;
      for (int k = 0; k < 3; ++k) {
        low = std::min(low, t.points(improved.map.mesh().faces()(f, k), 1));
        high = std::max(high, t.points(improved.map.mesh().faces()(f, k), 1));
      }
      EXPECT_FALSE(low < 0.49 && high > 0.51);
      const Index polygon = improved.map.mesh().input_face(f);
      EXPECT_GE(polygon, 0);
      EXPECT_LT(polygon, mesh->face_count());
    }
  }
}

// A slit across the square whose sides stay together; flips near it renumber its edges.
TEST(ImproveMesh, SeamsFollowTheirEdges) {
  const PlaneTriangulation t = jittered_grid(8, 0.2, 7);
  const auto whole = placed(t);
  std::vector<char> is_cut(to_size(whole->half_edge_count()), 0);
  for (Index h = 0; h < whole->half_edge_count(); ++h) {
    const auto row = [&](Index v) { return v / 9; };
    const Index a = whole->from_vertex(h), b = whole->to_vertex(h);
    if (row(a) == 4 && row(b) == 4 && std::min(a, b) % 9 >= 2 && std::max(a, b) % 9 <= 6)
      is_cut[h] = 1;
  }
  std::vector<Index> surface_vertex;
  const auto mesh = std::make_shared<const SurfaceMesh>(whole->cut_along(is_cut, &surface_vertex));
  std::vector<SeamEdge> edges;
  for (Index h = 0; h < whole->half_edge_count(); ++h)
    if (is_cut[h] && h < whole->opposite(h)) edges.push_back({h, whole->opposite(h), 0, -1});
  std::vector<int> quarter_turns(to_size(whole->vertex_count()), 4);
  for (const Index v : whole->boundary_loops().front()) quarter_turns[v] = 0;
  const auto seams =
      std::make_shared<const Seams>(mesh->faces(), surface_vertex, edges, quarter_turns);
  PlaneTriangulation cut{Points2(mesh->vertex_count(), 2), mesh->faces()};
  for (Index v = 0; v < mesh->vertex_count(); ++v)
    cut.points.row(v) = t.points.row(surface_vertex[v]);
  for (int n = 1; n <= 3; ++n) {
    const BezierMap plain = mapped(mesh, cut, n, swirl);
    const BezierMap map(mesh, plain.shared_space(), plain.control_points(), seams);
    ASSERT_LT(measure_map(map, kEnergy).seam_residual, 1e-14);
    const ImprovedMap improved = improve_mesh(map, kEnergy);
    EXPECT_GT(improved.flips.performed, 5);
    expect_same_surface(map, improved.map);
    ASSERT_EQ(improved.map.seams().edges().size(), edges.size());
    for (const SeamEdge& edge : improved.map.seams().edges()) {
      EXPECT_LT(improved.map.mesh().opposite(edge.side), 0);
      EXPECT_LT(improved.map.mesh().opposite(edge.opposite), 0);
    }
    const MapMeasures measures = measure_map(improved.map, kEnergy);
    EXPECT_LT(measures.seam_residual, 1e-14);
    EXPECT_TRUE(measures.locally_injective);
    EXPECT_LT(measures.value, mean(map));
  }
}

TEST(ImproveMesh, ImprovesTheFollowingSolve) {
  const PlaneTriangulation t = jittered_grid(10, 0.35, 8);
  ParametrizationOptions options;
  options.map.boundary = BoundaryCondition::Fixed;
  options.map.degree = 1;
  const ParametrizationResult first = parametrize(placed(t), options);
  ASSERT_TRUE(first.map);
  const ImprovedMap improved = improve_mesh(*first.map, kEnergy);
  EXPECT_LT(mean(improved.map), mean(*first.map));
  RunRecord record;
  const ParametrizationResult second = parametrize(improved.map, options, record);
  ASSERT_TRUE(second.map);
  EXPECT_LT(second.measures.value, mean(improved.map));
  RecordProperty("values", std::to_string(first.measures.value) + " " +
                               std::to_string(mean(improved.map)) + " " +
                               std::to_string(second.measures.value));
}

TEST(ImproveMesh, IsAnOptionOfParametrize) {
  const PlaneTriangulation t = jittered_grid(10, 0.35, 8);
  ParametrizationOptions options;
  options.map.boundary = BoundaryCondition::Fixed;
  options.map.degree = 1;
  const ParametrizationResult kept = parametrize(placed(t), options);
  EXPECT_FALSE(kept.other_triangles);
  EXPECT_EQ(kept.flips.performed, 0);
  options.solve.triangles = Triangles::Flipped;
  const ParametrizationResult flipped = parametrize(placed(t), options);
  const ImprovedMap expected = improve_mesh(*kept.map, kEnergy);
  EXPECT_TRUE(flipped.other_triangles);
  EXPECT_GT(flipped.flips.performed, 0);
  EXPECT_EQ(flipped.flips.performed, expected.flips.performed);
  EXPECT_EQ(flipped.map->mesh().faces(), expected.map.mesh().faces());
  EXPECT_EQ(flipped.measures.value, mean(expected.map)) << "measured anew";
  EXPECT_LT(flipped.measures.value, kept.measures.value);
  EXPECT_EQ(flipped.value_quadrature, kept.value_quadrature);
  options.map.face_weight = Vec::Ones(flipped.map->mesh().face_count());
  EXPECT_THROW(parametrize(placed(t), options), Error);
}

TEST(ImproveMesh, RefusesMapsWithFolds) {
  const PlaneTriangulation t = jittered_grid(3, 0, 1);
  const auto mesh = placed(t);
  EXPECT_THROW(
      improve_mesh(mapped(mesh, t, 2, [](const Vector2& p) { return Vector2(p[0], -p[1]); }),
                   kEnergy),
      InvalidArgument);
  EXPECT_THROW(improve_mesh(mapped(mesh, t, 2, unchanged), {}), InvalidArgument);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
