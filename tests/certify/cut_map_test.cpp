#include "majorant/certify/cut_map.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "io/cube_map.h"
#include "io/io_test_helpers.h"
#include "majorant/constraints/constraints.h"
#include "majorant/energies/energy_factory.h"
#include "majorant/io/io.h"
#include "majorant/io/read_mesh.h"
#include "majorant/maps/measure.h"
#include "majorant/parametrization/initialization/start.h"

namespace majorant {
namespace {

BezierMap seamless_map_of(const MapFile& file) { return CutMap(file, "file").map_with_seams(); }

// Returns a cell and one of its edges that is a seam.
std::pair<Index, int> seam_edge(const MapFile& file) {
  for (Index f = 0; f < file.seam_edges.rows(); ++f)
    for (int k = 0; k < 3; ++k)
      if (file.seam_edges(f, k) > 0) return {f, k};
  ADD_FAILURE() << "no seam";
  return {0, 0};
}

TEST(CutMap, ComesBackFromTheFile) {
  for (int degree = 1; degree <= 5; ++degree) {
    const BezierMap map = cube_map(degree);
    const MapFile file = to_map_file(map);
    EXPECT_TRUE(is_cut(file));
    const BezierMap again = seamless_map_of(file);
    EXPECT_EQ(again.control_points(), map.control_points());
    EXPECT_EQ(again.mesh().faces(), map.mesh().faces());
    EXPECT_EQ(again.space().cells(), map.space().cells());
    EXPECT_EQ(again.seams().surface_vertex(), map.seams().surface_vertex());
    EXPECT_EQ(again.seams().quarter_turns(), map.seams().quarter_turns());
    ASSERT_EQ(again.seams().edges().size(), 24u);
    EXPECT_EQ(again.seams().chain_count(), 12);
    for (std::size_t e = 0; e < 24; ++e) {
      const SeamEdge &a = again.seams().edges()[e], &b = map.seams().edges()[e];
      EXPECT_EQ(std::tuple(a.side, a.opposite, a.turns, a.chain),
                std::tuple(b.side, b.opposite, b.turns, b.chain));
    }
    EXPECT_EQ(again.seams().cones().size(), 8u);
    EXPECT_EQ(to_map_file(again).cone, file.cone);
    const MapMeasures measures = measure_map(again, {{symmetric_dirichlet(), 1.0}});
    EXPECT_TRUE(measures.locally_injective);
    EXPECT_NEAR(measures.value, 4, 1e-12);
    EXPECT_LE(measures.seam_residual, 1e-14);
  }
}

TEST(CutMap, ShuffledCellsKeepTheirOrder) {
  MapFile file = to_map_file(cube_map(3));
  file.cells = file.cells.colwise().reverse().eval();
  file.input_face = file.input_face.reverse().eval();
  const BezierMap map = seamless_map_of(file);
  for (Index f = 0; f < file.cells.rows(); ++f)
    for (Index k = 0; k < 3; ++k) {
      const Vector2 uv = map.control_points().segment<2>(2 * map.mesh().faces()(f, k));
      EXPECT_EQ(uv, Vector2(file.uv.row(file.cells(f, k))));
      EXPECT_EQ(map.mesh().input_vertex(map.mesh().faces()(f, k)),
                file.input_vertex[file.cells(f, k)]);
    }
  EXPECT_EQ(map.seams().chain_count(), 12);
}

TEST(CutMap, ArraysSurviveVtu) {
  const TemporaryFolder folder;
  for (int degree = 1; degree <= 4; ++degree) {
    const MapFile file = to_map_file(cube_map(degree));
    write_vtu(folder.file("a.vtu"), file);
    const MapFile again = read_vtu(folder.file("a.vtu"));
    EXPECT_EQ(again.cone, file.cone);
    EXPECT_EQ(again.seam_edges, file.seam_edges);
    write_vtu(folder.file("b.vtu"), again);
    EXPECT_EQ(content_of(folder.file("a.vtu")), content_of(folder.file("b.vtu")));
  }
  MapFile wrong = to_map_file(cube_map(1));
  wrong.seam_edges.conservativeResize(5, 3);
  EXPECT_NE(error_message(ErrorKind::Invalid, [&] { write_vtu(folder.file("c.vtu"), wrong); })
                .find("seam_edges"),
            std::string::npos);
}

TEST(CutMap, AnUncutMapHasNoSeams) {
  MapFile strip = random_strip(2, 4, 7);
  EXPECT_FALSE(is_cut(strip));
  EXPECT_TRUE(seamless_map_of(strip).seams().empty());
  EXPECT_EQ(to_map_file(seamless_map_of(strip)).seam_edges.size(), 0);
}

// If the file does not identify copies of a vertex, points at equal positions are copies.
TEST(CutMap, PointsAtOnePlaceAreOneVertex) {
  for (int degree = 1; degree <= 3; ++degree) {
    MapFile file = to_map_file(cube_map(degree));
    const BezierMap known = seamless_map_of(file);
    file.input_vertex.setConstant(-1);
    const BezierMap map = seamless_map_of(file);
    EXPECT_EQ(map.seams().edges().size(), known.seams().edges().size());
    EXPECT_EQ(map.seams().cones().size(), 8u);
  }
}

TEST(CutMap, SidesAreComparedByTheirValues) {
  for (int degree = 1; degree <= 3; ++degree) {
    MapFile file = to_map_file(cube_map(degree));
    const CutMap cube(file, "file");
    const std::vector<char> cuts = cube.cuts();
    EXPECT_EQ(std::count(cuts.begin(), cuts.end(), 1), 48);
    for (Index h = 0; h < cube.surface().half_edge_count(); ++h)
      EXPECT_EQ(cube.is_unshared(h), cube.differs(h));
    // Separate points with equal uv are joined; a difference of one bit separates them.
    MapFile strip = random_strip(degree, 4, 7);
    MapFile soup = strip;
    soup.points = strip.points(strip.cells.reshaped<Eigen::RowMajor>(), Eigen::all);
    soup.uv = strip.uv(strip.cells.reshaped<Eigen::RowMajor>(), Eigen::all);
    soup.input_vertex = strip.input_vertex(strip.cells.reshaped<Eigen::RowMajor>());
    for (Index k = 0; k < soup.cells.size(); ++k) soup.cells.data()[k] = k;
    const CutMap joined(soup, "file");
    Index inner = -1;
    for (Index h = 0; h < joined.surface().half_edge_count(); ++h) {
      EXPECT_FALSE(joined.differs(h));
      if (joined.surface().opposite(h) < 0) continue;
      EXPECT_TRUE(joined.is_unshared(h));
      inner = h;
    }
    ASSERT_GE(inner, 0);
    const Index point = soup.cells(inner / 3, inner % 3);
    soup.uv(point, 0) = std::nextafter(soup.uv(point, 0), 1e9);
    EXPECT_TRUE(CutMap(soup, "file").differs(inner));
  }
}

TEST(CutMap, SidesThatDoNotFitAreNamed) {
  for (int degree = 1; degree <= 4; ++degree) {
    MapFile file = to_map_file(cube_map(degree));
    const auto [cell, k] = seam_edge(file);
    const auto on_edge = bezier_edge_points(degree, k);
    const Index point = file.cells(cell, on_edge[static_cast<std::size_t>(degree / 2)]);
    file.uv(point, 0) += 0.01;
    const std::string message = error_message(ErrorKind::Invalid, [&] { seamless_map_of(file); });
    EXPECT_NE(message.find("edge ("), std::string::npos) << message;
    // Mismatches below the limit of refusal are measured.
    file.uv(point, 0) += 1e-6 - 0.01;
    const BezierMap map = seamless_map_of(file);
    EXPECT_NEAR(measure_map(map, {{symmetric_dirichlet(), 1.0}}).seam_residual, 1e-6, 1e-9);
    const SeamMismatch worst = worst_seam_edge(map.space(), map.seams(), map.control_points());
    const SeamEdge edge = map.seams().edges()[static_cast<std::size_t>(worst.edge)];
    EXPECT_TRUE(edge.side / 3 == cell || edge.opposite / 3 == cell || degree == 1);
  }
}

TEST(CutMap, ObjWeldsTheSurfaceAndNamesCones) {
  const TemporaryFolder folder;
  const PolygonMesh input = cube();
  for (const int degree : {1, 3}) {
    write_obj(folder.file("a.obj"), to_map_file(cube_map(degree)), &input, {.refine = degree});
    const PolygonMesh mesh = read_mesh(folder.file("a.obj"));
    for (std::size_t v = 0; v < input.positions.size(); ++v)
      EXPECT_EQ(mesh.positions[v], input.positions[v]);
    EXPECT_EQ(SurfaceMesh::from_polygons(mesh).topology().boundary_loops, 0);
    EXPECT_EQ(seamless_from_texture(SurfaceMesh::from_polygons(mesh)).map.seams().chain_count(),
              12);
    const std::string text = content_of(folder.file("a.obj"));
    std::size_t cones = 0;
    for (std::size_t at = 0; (at = text.find("# cone vertex ", at)) != std::string::npos; ++at)
      ++cones;
    EXPECT_EQ(cones, 8u);
    EXPECT_EQ(seamless_map_of(to_map_file(mesh)).seams().cones().size(), 8u);
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
