#include "majorant/quads/internal/t_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/io/read_mesh.h"
#include "majorant/mesh/repair.h"
#include "majorant/parametrization/initialization/start.h"
#include "majorant/quads/internal/border.h"
#include "majorant/quads/internal/extraction.h"
#include "majorant/quads/internal/quantization.h"
#include "majorant/quads/internal/resolved_surface.h"
#include "majorant/quads/quad_mesh.h"
#include "parametrization/fields/closed_surfaces.h"
#include "public_data.h"

namespace majorant {
namespace {

std::map<std::string, SurfaceMesh> surfaces() {
  std::map<std::string, SurfaceMesh> all;
  all.emplace("sphere", SurfaceMesh::from_polygons(sphere(8)));
  all.emplace("cube", SurfaceMesh::from_polygons(cube(6)));
  all.emplace("torus", SurfaceMesh::from_polygons(torus(24, 16, 0)));
  if (const auto folder = public_data("closed"); !folder.empty())
    for (const char* name : {"spot_1654.obj", "skull_g2_10312.obj", "torus_g1_4608.obj"})
      all.emplace(name, SurfaceMesh::from_polygons(read_mesh((folder / name).string())));
  return all;
}

BezierMap start_of(const SurfaceMesh& mesh) {
  RunRecord record;
  return make_seamless(mesh, {}, record).map;
}

TEST(SeamlessLattice, TransitionsHoldWithoutError) {
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(sphere(8));
  const BezierMap map = start_of(mesh);
  const SeamlessLattice lattice(mesh, map);
  double area = 0;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto corner = [&](int k) {
      return Vector2(map.control_uv().row(map.mesh().faces()(f, k)).transpose());
    };
    area += cross(corner(1) - corner(0), corner(2) - corner(0));
  }
  const double exact = static_cast<double>(lattice.twice_area()) * lattice.unit() * lattice.unit();
  EXPECT_NEAR(exact, area, 1e-9 * area);
  int seams = 0;
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    const Index o = mesh.opposite(h);
    seams += lattice.turns(h) != 0;
    const LatticePoint p{12345, -678};
    EXPECT_EQ(lattice.beyond(o, lattice.beyond(h, p)), p);
    EXPECT_EQ(lattice.beyond(h, lattice.corner(h)), lattice.corner(next(o)));
  }
  EXPECT_GT(seams, 0);
}

// A sheet of 8 by 8 squares, of which one column is squeezed to so many steps of the lattice.
TEST(SeamlessLattice, LinesMayBeSomeHundredStepsApart) {
  const ResolvedSurface resolved = resolve_feature_edges(SurfaceMesh::from_polygons(grid(8)));
  const auto& positions = resolved.mesh.positions();
  const double from = positions.col(0).minCoeff(), to = positions.col(0).maxCoeff();
  constexpr double kSteps = 300;
  const double step = std::ldexp(1.0, -37);  // of a layout of 7 by 8
  Vec uv(2 * resolved.mesh.vertex_count());
  for (Index v = 0; v < resolved.mesh.vertex_count(); ++v) {
    const double x = 8 * (positions(v, 0) - from) / (to - from);
    const double squeezed = std::clamp(x - 3, 0.0, 1.0) * (kSteps * step - 1);
    uv.segment<2>(2 * v) = Vector2(x + squeezed, 8 * (positions(v, 1) - from) / (to - from));
  }
  SeamlessLattice lattice(
      resolved.mesh,
      BezierMap::linear(std::make_shared<const SurfaceMesh>(resolved.mesh), std::move(uv)));
  EXPECT_EQ(trace_t_mesh(lattice).patches.size(), 1);
}

TEST(TMesh, PatchesAreRectanglesThatTileTheSurface) {
  for (const auto& [name, mesh] : surfaces()) {
    SCOPED_TRACE(name);
    SeamlessLattice lattice(mesh, start_of(mesh));
    const TMesh t_mesh = trace_t_mesh(lattice);
    std::vector<int> uses(2 * t_mesh.arcs.size(), 0);
    WideInteger area = 0;
    for (const TPatch& patch : t_mesh.patches) {
      for (const auto& side : patch.sides)
        for (const Index h : side) ++uses[h];
      area += 2 * WideInteger{patch.width} * patch.height;
    }
    for (const int count : uses) EXPECT_EQ(count, 1);
    EXPECT_TRUE(area == lattice.twice_area());
    for (const TArc& arc : t_mesh.arcs) EXPECT_GT(arc.length(), 0);
    Index cones = 0;
    for (Index v = 0; v < mesh.vertex_count(); ++v) cones += lattice.is_cone(v);
    Index nodes = 0;
    for (const TNode& node : t_mesh.nodes) nodes += node.vertex >= 0;
    EXPECT_EQ(nodes, std::max(cones, 1));
  }
}

TEST(Quantization, OppositeSidesAgreeAndQuadsAreAMesh) {
  for (const auto& [name, mesh] : surfaces()) {
    SCOPED_TRACE(name);
    SeamlessLattice lattice(mesh, start_of(mesh));
    const TMesh t_mesh = trace_t_mesh(lattice);
    for (const long count : {500, 4000}) {
      const double length =
          std::sqrt(static_cast<double>(lattice.twice_area()) / 2 / static_cast<double>(count));
      std::vector<double> required;
      for (const TArc& arc : t_mesh.arcs)
        required.push_back(static_cast<double>(arc.length()) / length);
      const std::vector<Index> edges =
          Quantization(t_mesh, required, std::vector<Index>(t_mesh.arcs.size(), 1))
              .numbers(SearchEffort::First);
      for (const TPatch& patch : t_mesh.patches)
        for (std::size_t s = 0; s < 2; ++s)
          EXPECT_EQ(sum_of(patch.sides[s], edges), sum_of(patch.sides[s + 2], edges));
      for (const Index n : edges) EXPECT_GE(n, 1);
      ExtractedQuads extracted(lattice, t_mesh, edges);
      EXPECT_TRUE(QuadConnectivity(t_mesh, edges).joining_arcs().empty());
      const PolygonMesh quads = extracted.polygons();
      EXPECT_EQ(static_cast<long>(quads.polygons.size()), quad_count(t_mesh, edges));
      const QuadCheck check = check_quads(quads, &mesh);
      EXPECT_EQ(check.topology.euler_characteristic(), mesh.topology().euler_characteristic());
      Index irregular = 0;
      for (const TNode& node : t_mesh.nodes) irregular += node.vertex >= 0 && node.turns != 4;
      EXPECT_EQ(check.irregular, irregular);
    }
  }
}

// Sum (n - wanted)^2 / max(wanted, 1).
double off_of(const std::vector<Index>& edges, const std::vector<double>& required) {
  double sum = 0;
  for (std::size_t a = 0; a < edges.size(); ++a)
    sum += std::pow(edges[a] - required[a], 2) / std::max(required[a], 1.0);
  return sum;
}

TEST(Quantization, GoesOnFromOtherLengthsToTheSameSum) {
  for (const auto& [name, mesh] : surfaces()) {
    if (mesh.face_count() > 2000) continue;
    SCOPED_TRACE(name);
    SeamlessLattice lattice(mesh, start_of(mesh));
    const TMesh t_mesh = trace_t_mesh(lattice);
    const double of_500 = std::sqrt(static_cast<double>(lattice.twice_area()) / 2 / 500);
    const auto required = [&](double length) {
      std::vector<double> edges;
      for (const TArc& arc : t_mesh.arcs)
        edges.push_back(static_cast<double>(arc.length()) / (length * of_500));
      return edges;
    };
    std::vector<Index> least(t_mesh.arcs.size(), 0);
    Quantization goes_on(t_mesh, required(1), least);
    Index raised = 0;
    for (const double length : {1.0, 1.1, 0.9, 3.0, 0.05, 20.0}) {
      goes_on.set_targets(required(length));
      const double off = off_of(goes_on.numbers(SearchEffort::Least), required(length));
      const std::vector<Index> fresh =
          Quantization(t_mesh, required(length), least).numbers(SearchEffort::Least);
      EXPECT_NEAR(off, off_of(fresh, required(length)), 1e-9 * std::max(off, 1.0)) << length;
      least[raised] = fresh[raised] + 2;
      goes_on.raise(raised, least[raised]);
      raised = (raised + 7) % static_cast<Index>(least.size());
    }
  }
}

TEST(QuadMesh, CountAndValidity) {
  for (const auto& [name, mesh] : surfaces()) {
    SCOPED_TRACE(name);
    RunRecord record;
    QuadMeshOptions options;
    options.count = 2000;
    const QuadMesh made = quad_mesh(mesh, options, record);
    EXPECT_TRUE(made.check.is_valid());
    EXPECT_NEAR(static_cast<double>(made.check.count), 2000, kCountClose * 2000);
    EXPECT_LE(made.check.irregular, made.cones);
  }
}

// Cones are weighed by the lengths that they leave uneven, not by how smooth they leave the field.
TEST(QuadMesh, FewerIrregularVerticesThanOfTheSmoothestField) {
  RepairOptions closed;
  closed.welding = Welding::EqualPlaces;
  const RepairedSurface surface =
      repair(read_mesh(MAJORANT_SOURCE_DIR "/examples/meshes/creature.obj"), closed);
  const SurfaceMesh& mesh = *surface.mesh;
  ASSERT_EQ(mesh.topology().boundary_loops, 0);
  const auto made_with = [&](const CrossFieldOptions& field) {
    RunRecord record;
    QuadMeshOptions options;
    options.count = 1500;
    options.features.emplace();
    options.map.field = field;
    return quad_mesh(mesh, options, record).check;
  };
  const QuadCheck even = made_with(QuadMeshOptions().map.field);
  const QuadCheck smooth = made_with({});
  EXPECT_LT(10 * even.irregular, 9 * smooth.irregular);
  EXPECT_LT(even.angle_deviation, smooth.angle_deviation + 0.5);  // degrees
}

// Around it ten times as long as across, and without cones: no arc needs an edge.
SurfaceMesh thin_torus() {
  PolygonMesh mesh = torus(40, 8, 0);
  for (Vector3& p : mesh.positions) p += 8 * Vector3(p.x(), p.y(), 0).normalized();
  return SurfaceMesh::from_polygons(mesh);
}

TEST(QuadMesh, FewQuadsOfASurfaceWithoutCones) {
  const SurfaceMesh mesh = thin_torus();
  for (const long count : {1, 2, 5, 20, 300}) {
    SCOPED_TRACE(count);
    RunRecord record;
    QuadMeshOptions options;
    options.count = count;
    const QuadMesh made = quad_mesh(mesh, options, record);
    EXPECT_TRUE(made.check.is_valid());
    EXPECT_EQ(made.check.irregular, 0);
    const bool is_more =
        static_cast<double>(made.check.count) > (1 + kCountClose) * static_cast<double>(count);
    EXPECT_EQ(made.least_count.has_value(), is_more);
    if (is_more) {
      EXPECT_GE(*made.least_count, 1);
      EXPECT_LE(*made.least_count, made.check.count);
    }
  }
}

TEST(QuadMesh, RefusesInvalidRequests) {
  RunRecord record;
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(sphere(3));
  QuadMeshOptions both;
  both.count = 10;
  both.edge_length = 1;
  EXPECT_THROW(quad_mesh(mesh, both, record), InvalidArgument);
  for (const double length : {1e-4, 1e-6, 1e-200}) {
    QuadMeshOptions tiny;
    tiny.edge_length = length;
    try {
      quad_mesh(mesh, tiny, record);
      FAIL() << length;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::Unsupported) << error.what();
      EXPECT_NE(std::string(error.what()).find("too many"), std::string::npos) << error.what();
    }
  }
  QuadMeshOptions sharp;
  sharp.map.cones = std::vector<Cone>{{0, 1}, {5, 1}, {9, 3}, {12, 3}};
  try {
    quad_mesh(mesh, sharp, record);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::Infeasible);
    EXPECT_NE(std::string(error.what()).find("one quarter turn"), std::string::npos);
  }
  PolygonMesh open = sphere(3);
  open.polygons.resize(open.polygons.size() - 1);
  open.polygon_lines.clear();
  QuadMeshOptions given;
  given.map.cones.emplace();
  try {
    quad_mesh(SurfaceMesh::from_polygons(open), given, record);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::Unsupported);
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
