#include "majorant/quads/internal/integer_grid_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <random>
#include <string>

#include "majorant/certify/inverse_map.h"
#include "majorant/constraints/local_injectivity.h"
#include "majorant/framework/error.h"
#include "majorant/maps/rest_shapes_of.h"
#include "majorant/quads/features.h"
#include "majorant/quads/internal/aligned_map.h"
#include "majorant/quads/internal/extraction.h"
#include "majorant/quads/internal/quantization.h"
#include "majorant/quads/quad_mesh.h"
#include "parametrization/fields/closed_surfaces.h"

namespace majorant {
namespace {

// A surface with whole numbers for its T-mesh, as quad_mesh() makes them.
struct Quantized {
  ResolvedSurface resolved;
  std::unique_ptr<BezierMap> map;
  std::unique_ptr<SeamlessLattice> lattice;
  TMesh t_mesh;
  std::vector<Index> edges;
  double edge_length = 0;

  Quantized(const SurfaceMesh& mesh, const std::vector<char>& features, double count)
      : resolved(resolve_feature_edges(mesh, features)) {
    RunRecord record;
    map = std::make_unique<BezierMap>(aligned_map(resolved, {}, record).map);
    lattice = std::make_unique<SeamlessLattice>(resolved.mesh, *map, resolved.is_feature);
    t_mesh = trace_t_mesh(*lattice);
    const double length = std::sqrt(static_cast<double>(lattice->twice_area()) / 2 / count);
    std::vector<double> required;
    for (const TArc& arc : t_mesh.arcs)
      required.push_back(static_cast<double>(arc.length()) / length);
    std::vector<Index> least(t_mesh.arcs.size(), 0);
    for (;;) {
      edges = Quantization(t_mesh, required, least).numbers(SearchEffort::First);
      const std::vector<Index> more = QuadConnectivity(t_mesh, edges).joining_arcs();
      if (more.empty()) break;
      for (const Index arc : more) least[arc] = edges[arc] + 1;
    }
    edge_length = std::ldexp(std::round(std::ldexp(length * lattice->unit(), 16)), -16);
  }

  GridTranslations grid() const { return {*map, *lattice, t_mesh, edges, edge_length}; }
  std::optional<BezierMap> whole(GridDegrees degrees) const {
    return integer_grid_map(*map, *lattice, grid(), degrees, {});
  }
};

double to_whole(double x) { return std::abs(x - std::round(x)); }

// Cones and corners differ by whole numbers, up to kRealPart of what they were.
void expect_whole(const Quantized& of, const BezierMap& map) {
  std::optional<Vector2> origin;
  for (Index h = 0; h < of.resolved.mesh.half_edge_count(); ++h) {
    const Index v = of.resolved.mesh.from_vertex(h);
    bool is_node = false;
    for (const TNode& node : of.t_mesh.nodes) is_node |= node.vertex == v;
    if (!is_node) continue;
    const Vector2 at =
        map.control_points().segment<2>(2 * map.mesh().from_vertex(h)) / of.edge_length;
    if (!origin) origin = at;
    EXPECT_LT(to_whole(at.x() - origin->x()), 1e-4) << v;
    EXPECT_LT(to_whole(at.y() - origin->y()), 1e-4) << v;
  }
  EXPECT_TRUE(origin);
}

// All preimages of whole points, by the certified inverse, are vertices of quads.
void expect_same_vertices(const Quantized& of, const BezierMap& map, double tolerance) {
  const IntegerGrid grid(of.resolved, map, of.edge_length, {});
  ExtractedQuads extracted(grid.lattice(), grid.t_mesh(), grid.edges());
  EXPECT_TRUE(QuadConnectivity(grid.t_mesh(), grid.edges()).joining_arcs().empty());
  const PolygonMesh quads = extracted.polygons();
  EXPECT_EQ(static_cast<long>(quads.polygons.size()), quad_count(of.t_mesh, of.edges));
  const QuadCheck check = check_quads(quads, &of.resolved.mesh);
  EXPECT_TRUE(check.is_surface);
  EXPECT_EQ(check.topology.euler_characteristic(),
            of.resolved.mesh.topology().euler_characteristic());
  Index origin = -1;
  for (const TNode& node : of.t_mesh.nodes)
    if (node.vertex >= 0 && origin < 0)
      origin = map.mesh().from_vertex(of.lattice->leaving(node.vertex));
  const Vector2 at = map.control_points().segment<2>(2 * origin) / of.edge_length;
  const Vector2 shift = at - at.array().round().matrix();
  const auto uv = map.control_uv();
  std::vector<Vector2> points;
  const Vector2 low = uv.colwise().minCoeff() / of.edge_length,
                high = uv.colwise().maxCoeff() / of.edge_length;
  for (double u = std::floor(low.x()); u <= high.x(); ++u)
    for (double v = std::floor(low.y()); v <= high.y(); ++v)
      points.push_back(of.edge_length * (Vector2(u, v) + shift));
  Points2 rows(static_cast<Index>(points.size()), 2);
  for (std::size_t k = 0; k < points.size(); ++k) rows.row(static_cast<Index>(k)) = points[k];
  const InverseMap inverse(map);
  const InverseMap::Lists found = inverse.locate_all(rows);
  // Those on the sides of seams may be just beyond them.
  EXPECT_GT(found.preimages.size(), quads.positions.size() / 2);
  for (const Preimage& p : found.preimages) {
    Vector3 place = Vector3::Zero();
    for (int k = 0; k < 3; ++k)
      place += p.barycentric[k] *
               of.resolved.mesh.input_position(of.resolved.mesh.from_vertex(3 * p.face + k));
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vector3& q : quads.positions) nearest = std::min(nearest, (q - place).norm());
    EXPECT_LT(nearest, tolerance * of.edge_length);
  }
}

struct Case {
  SurfaceMesh mesh;
  std::vector<char> features;
  double count;
};

std::map<std::string, Case> cases() {
  std::map<std::string, Case> all;
  const auto add = [&](const std::string& name, const PolygonMesh& polygons, double count) {
    SurfaceMesh mesh = SurfaceMesh::from_polygons(polygons);
    all.emplace(name, Case{std::move(mesh), {}, count});
  };
  add("sphere", sphere(8), 300);
  add("torus", torus(24, 16, 0), 300);
  add("sheet", grid(10, bumpy), 150);
  SurfaceMesh box = SurfaceMesh::from_polygons(cube(6));
  std::vector<char> sharp = sharp_edges(box, kCornerTurn);
  all.emplace("box", Case{std::move(box), std::move(sharp), 250});
  return all;
}

TEST(IntegerGridMap, ConesAreAtIntegersAndIntegerLinesFormQuads) {
  for (const auto& [name, of] : cases()) {
    SCOPED_TRACE(name);
    const Quantized quantized(of.mesh, of.features, of.count);
    for (const int degree : {1, 2}) {
      SCOPED_TRACE(degree);
      const std::optional<BezierMap> map = quantized.whole({degree, degree});
      ASSERT_TRUE(map);
      EXPECT_EQ(map->degree(), degree);
      expect_whole(quantized, *map);
      EXPECT_TRUE(LocalInjectivity(map->shared_space(), 2 * rest_shapes(map->mesh()).measure)
                      .check(map->control_points())
                      .feasible);
      expect_same_vertices(quantized, *map, degree == 1 ? 1e-4 : 0.1);
    }
  }
}

// Triangles that straight edges hold back are freed by curved ones.
void expect_freed(const SurfaceMesh& mesh, double count) {
  const Quantized quantized(mesh, {}, count);
  EXPECT_FALSE(quantized.whole({1, 1}));
  const std::optional<BezierMap> map = quantized.whole({});
  ASSERT_TRUE(map);
  EXPECT_EQ(map->degree(), 2);
  expect_whole(quantized, *map);
  expect_same_vertices(quantized, *map, 0.2);
}

TEST(IntegerGridMap, CurvedTrianglesReachMapsThatStraightOnesDoNot) {
  PolygonMesh rough = sphere(3);
  std::mt19937 random(12);
  std::uniform_real_distribution<double> uniform(-0.75, 0.75);
  for (Vector3& p : rough.positions) p *= 1 + uniform(random);
  expect_freed(SurfaceMesh::from_polygons(rough), 10);
}

TEST(QuadMesh, IsPlacedInTheBetterWay) {
  for (const auto& [name, of] : cases()) {
    SCOPED_TRACE(name);
    const auto made = [&mesh = of.mesh, &features = of.features,
                       count = of.count](QuadPlacing placing) {
      QuadMeshOptions options;
      options.count = static_cast<long>(count);
      options.features = features;
      options.placing = placing;
      RunRecord record;
      return quad_mesh(mesh, options, record);
    };
    const QuadMesh best = made(QuadPlacing::Best);
    EXPECT_NE(best.placed, QuadPlacing::Best);
    for (const QuadPlacing placing : {QuadPlacing::Rectangles, QuadPlacing::IntegerGrid}) {
      const QuadMesh other = made(placing);
      EXPECT_EQ(other.placed, placing);
      EXPECT_EQ(other.degree, 1);
      EXPECT_TRUE(other.check.is_valid());
      EXPECT_EQ(other.check.count, best.check.count);
      EXPECT_EQ(other.check.irregular, best.check.irregular);
      EXPECT_LE(best.check.angle_deviation, other.check.angle_deviation);
    }
  }
}

TEST(QuadMesh, RefusesDegreesOutOfRange) {
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(sphere(3));
  for (const auto& [first, last] : {std::pair{0, 1}, {2, 1}, {1, 9}}) {
    QuadMeshOptions options;
    options.first_degree = first;
    options.last_degree = last;
    RunRecord record;
    EXPECT_THROW(quad_mesh(mesh, options, record), InvalidArgument) << first << " " << last;
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
