// Texture coordinates as a plain start and as a seamless map: seams found, inputs refused.
#include <gtest/gtest.h>

#include "expected_error.h"
#include "majorant/constraints/local_injectivity.h"
#include "majorant/parametrization/initialization/start.h"
#include "majorant/parametrization/solve/parametrize.h"
#include "mesh/list_edits.h"
#include "parametrization/initialization/seamless_cases.h"

namespace majorant {
namespace {

PolygonMesh textured() {
  PolygonMesh mesh = grid(3, bumpy);
  for (const Vector3& p : mesh.positions) mesh.texcoords.push_back({2 * p.x(), p.y() - 1});
  mesh.polygon_texcoords = mesh.polygons;
  return mesh;
}

TEST(TextureMap, IsByVertex) {
  const auto mesh = surface(textured());
  const Vec uv = texture_map(*mesh);
  for (Index v = 0; v < mesh->vertex_count(); ++v)
    EXPECT_EQ(Vector2(uv.segment<2>(2 * v)),
              Vector2(2 * mesh->positions()(v, 0), mesh->positions()(v, 1) - 1));
}

TEST(TextureMap, RefusesSeamsAndMissingCoordinates) {
  PolygonMesh seam = textured();
  seam.texcoords.push_back({5, 5});
  seam.polygon_texcoords[2][1] = 16;  // a corner of vertex 2 in the file: number 3
  expect_contains(error_message(ErrorKind::Unsupported, [&] { texture_map(*surface(seam)); }),
                  {"inline.obj", "vertex 3", "several", "take another start"});
  PolygonMesh missing = textured();
  set_list(missing.polygon_texcoords, 4, {});
  expect_contains(error_message(ErrorKind::Unsupported, [&] { texture_map(*surface(missing)); }),
                  {"inline.obj", "texture coordinates", "take another start"});
}

std::map<int, int> cone_counts(const Seams& seams) {
  std::map<int, int> out;
  for (const Cone& c : seams.cones()) ++out[c.quarter_turns];
  return out;
}

struct Expected {
  const char* name;
  SeamlessCase surface;
  int pieces;
  std::map<int, int> cones;  // quarter turns -> number of cones
};

std::vector<Expected> expected_cases() {
  const Squares corner = polycube({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  std::vector<Expected> out{
      {"cube, six charts", squares_case(unit_cube(), 2, Charts::OnePerSquare), 6, {{3, 8}}},
      {"cube, cross net", squares_case(unit_cube(), 2, Charts::One), 1, {{3, 8}}},
      {"cube, tree", squares_case(unit_cube(), 3, Charts::ConeTree), 1, {{3, 8}}},
      {"torus", squares_case(square_torus(4, 3), 2, Charts::OneWithoutSlits), 1, {}},
      {"genus 1", squares_case(holed_plate(1), 2, Charts::OneWithoutSlits), 1, {{3, 8}, {5, 8}}},
      {"genus 2", squares_case(holed_plate(2), 2, Charts::One), 1, {{3, 8}, {5, 16}}},
      {"corner", squares_case(corner, 2, Charts::OneWithoutSlits), 1, {{3, 13}, {5, 3}, {6, 1}}}};
  for (const int turns : {1, 2, 3, 5, 6, 7, 8})
    out.push_back({"fan", fan_case(turns, 3), 1, {{turns, 1}}});
  for (const int turns : {1, 2, 3, 4, 5, 6, 7})
    out.push_back({"annulus", fan_case(turns, 3, 1), 1, {}});
  return out;
}

TEST(TextureSeams, ReadsChartsTransitionsAndCones) {
  for (const Expected& e : expected_cases()) {
    SCOPED_TRACE(e.name);
    const Start start = seamless_from_texture(*e.surface.mesh);
    const Seams& seams = start.map.seams();
    EXPECT_EQ(start.map.mesh().topology().components, e.pieces);
    EXPECT_EQ(cone_counts(seams), e.cones);
    EXPECT_LE(start.residual, 1e-14);
    EXPECT_LE(start.moved, 1e-13);
    EXPECT_LE(seam_residual(start.map.space(), seams, start.map.control_points()), 1e-14);
    EXPECT_EQ(texture_cuts(*e.surface.mesh), e.surface.is_cut);
    if (e.surface.mesh->topology().boundary_loops > 0) continue;
    int defect = 0;  // Gauss-Bonnet in quarter turns
    for (const Cone& c : seams.cones()) defect += 4 - c.quarter_turns;
    EXPECT_EQ(defect, 4 * e.surface.mesh->topology().euler_characteristic());
  }
}

TEST(TextureSeams, TurnsOfAnAnnulus) {
  for (const int turns : {4, 5, 6, 7}) {
    const Start start = seamless_from_texture(*fan_case(turns, 4, 1).mesh);
    for (const SeamEdge& e : start.map.seams().edges())
      EXPECT_TRUE(e.turns == turns - 4 || e.turns == (8 - turns) % 4) << e.turns;
  }
}

// No two corners share a texture coordinate index.
TEST(TextureSeams, SoupsAreCutWhereValuesDiffer) {
  for (const Squares& s : {unit_cube(), holed_plate(2)}) {
    const SeamlessCase c = squares_case(s, 2, Charts::OneWithoutSlits);
    PolygonMesh soup = c.polygons;
    soup.texcoords.clear();
    for (std::size_t f = 0; f < soup.polygons.size(); ++f)
      for (std::size_t k = 0; k < 3; ++k) {
        soup.polygon_texcoords[f][k] = Index(soup.texcoords.size());
        soup.texcoords.push_back(c.corners.row(Index(f)).segment<2>(2 * Index(k)));
      }
    const auto mesh = surface(soup);
    const Start start = seamless_from_texture(*mesh);
    // Edges whose two sides coincide are not seams.
    const std::vector<char> cuts = texture_cuts(*mesh);
    for (std::size_t h = 0; h < cuts.size(); ++h) EXPECT_LE(cuts[h], c.is_cut[h]);
    EXPECT_EQ(cone_counts(start.map.seams()), cone_counts(c.start().map.seams()));
  }
}

// ---- What is nearly seamless ----

// Returns `c` with one side of its first seam between two faces moved by `by` edge lengths.
SeamlessCase with_mismatch(SeamlessCase c, double by, Index* moved) {
  *moved = 0;
  while (!c.is_cut[*moved]) ++*moved;
  double sum = 0;
  for (Index f = 0; f < c.corners.rows(); ++f)
    for (Index k = 0; k < 3; ++k)
      sum += (c.corners.row(f).segment<2>(2 * k) - c.corners.row(f).segment<2>(2 * ((k + 1) % 3)))
                 .norm();
  const Index v = c.polygons.polygon_texcoords[*moved / 3][*moved % 3];
  c.polygons.texcoords[v] += Vector2(0.6, 0.8) * by * sum / double(3 * c.corners.rows());
  c.mesh = surface(c.polygons);
  return c;
}

TEST(TextureSeams, MismatchesBelowTheToleranceAreProjectedOut) {
  for (const Charts charts : {Charts::OnePerSquare, Charts::OneWithoutSlits}) {
    Index h = 0;
    const SeamlessCase c =
        with_mismatch(squares_case(unit_cube(), 4, charts), 0.6 * kSeamTolerance, &h);
    const Start start = seamless_from_texture(*c.mesh);
    EXPECT_GT(start.residual, 1e-5);
    EXPECT_GT(start.moved, 1e-5);
    EXPECT_LT(start.moved, 2e-3);
    EXPECT_LE(seam_residual(start.map.space(), start.map.seams(), start.map.control_points()),
              1e-13);
    EXPECT_EQ(cone_counts(start.map.seams()), (std::map<int, int>{{3, 8}}));
    ParametrizationOptions options;
    options.map.degree = 1;
    RunRecord record;
    const ParametrizationResult r = parametrize(start.map, options, record);
    EXPECT_EQ(r.status, Status::Converged) << r.message;
  }
}

TEST(TextureSeams, MismatchesAboveTheToleranceNameTheEdge) {
  Index h = 0;
  const SeamlessCase c =
      with_mismatch(squares_case(unit_cube(), 4, Charts::OnePerSquare), 1.8 * kSeamTolerance, &h);
  const std::string message =
      error_message(ErrorKind::Unsupported, [&] { seamless_from_texture(*c.mesh); });
  expect_contains(message, {"inline.obj", "seam at edge (", "tolerance"});
  // One end of the edge is the vertex that was moved.
  const auto open = message.find("edge (") + 6;
  const auto comma = message.find(',', open), close = message.find(')', comma);
  const int a = std::stoi(message.substr(open, comma - open)) - 1;
  const int b = std::stoi(message.substr(comma + 1, close - comma - 1)) - 1;
  EXPECT_TRUE(a == c.mesh->from_vertex(h) || b == c.mesh->from_vertex(h)) << message;
}

// All seams have errors of rounding to six digits, as in files.
TEST(TextureSeams, SixDigitsAreEnough) {
  SeamlessCase c = squares_case(holed_plate(2), 7, Charts::OneWithoutSlits);
  for (Vector2& t : c.polygons.texcoords)
    for (double& value : t) value = std::round(1e6 * (value / 3 + 0.123456789)) * 1e-6;
  const Start start = seamless_from_texture(*surface(c.polygons));
  EXPECT_GT(start.residual, 1e-8);
  EXPECT_LT(start.moved, 1e-5);
}

// ---- What is refused ----

TEST(TextureSeams, FlippedFacesAreInfeasible) {
  SeamlessCase mirrored = squares_case(unit_cube(), 2, Charts::One);
  for (Vector2& t : mirrored.polygons.texcoords) t.x() = -t.x();
  expect_contains(error_message(ErrorKind::Infeasible,
                                [&] { seamless_from_texture(*surface(mirrored.polygons)); }),
                  {"inline.obj", "face 1 ", "not positively oriented"});
  SeamlessCase folded = squares_case(unit_cube(), 4, Charts::OnePerSquare);
  const SurfaceMesh cut = folded.mesh->cut_along(folded.is_cut, nullptr);
  std::vector<char> outside(to_size(cut.vertex_count()), 0);
  for (const auto& loop : cut.boundary_loops())
    for (const Index v : loop) outside[v] = 1;
  const Index v = Index(std::find(outside.begin(), outside.end(), 0) - outside.begin());
  folded.polygons.texcoords[v] += Vector2(0.6, 0.1);
  expect_contains(error_message(ErrorKind::Infeasible,
                                [&] { seamless_from_texture(*surface(folded.polygons)); }),
                  {"face ", "not positively oriented"});
}

TEST(TextureSeams, CornersWithoutCoordinatesAreUnsupported) {
  SeamlessCase c = squares_case(unit_cube(), 2, Charts::One);
  set_list(c.polygons.polygon_texcoords, 5, {});
  expect_contains(
      error_message(ErrorKind::Unsupported, [&] { seamless_from_texture(*surface(c.polygons)); }),
      {"inline.obj", "texture coordinates"});
}

// Edges too short for exact directions hide a vertex whose angles nearly vanish.
TEST(TextureSeams, AnglesThatAreNoMultipleOf90NameTheVertex) {
  SeamlessCase c = fan_case(4, 3);
  for (Index f = 0; f < 12; ++f) {
    const double t = kPi / 180 * 3;  // 12 sectors of 3 degrees
    c.corners.row(f) << 0, 0, 1e-6, 0, 1e-6 * std::cos(t), 1e-6 * std::sin(t);
  }
  for (Index f = 12; f < c.corners.rows(); ++f)
    for (Index k = 0; k < 3; ++k)
      if (c.corners.row(f).segment<2>(2 * k).norm() < 1.5)
        c.corners.row(f).segment<2>(2 * k) *= 1e-6;
  for (Index h = 0; h < c.mesh->half_edge_count(); ++h)
    if (h < 36) c.is_cut[h] = c.is_cut[c.mesh->opposite(h)] = 1;
  expect_contains(error_message(ErrorKind::Unsupported, [&] { c.start(); }),
                  {"vertex 1:", "36 degrees"});
}

// ---- Vertices of 720 degrees ----

// Inside a chart, with seams elsewhere or none at all.
TEST(TextureSeams, AFullTurnTooManyInsideAChart) {
  SeamlessCase c = fan_case(8, 3);
  std::fill(c.is_cut.begin(), c.is_cut.end(), char(0));
  for (const bool cut : {false, true}) {
    if (cut) c = fan_case(8, 3);
    const Start start = c.start();
    ASSERT_EQ(cone_counts(start.map.seams()), (std::map<int, int>{{8, 1}}));
    for (const int n : {1, 2}) {
      ParametrizationOptions options;
      options.map.degree = n;
      RunRecord record;
      const ParametrizationResult r = parametrize(start.map, options, record);
      EXPECT_EQ(r.status, Status::Converged) << r.message;
      EXPECT_TRUE(r.measures.locally_injective);
      EXPECT_NEAR(vertex_angle_sums(r.map->space(), r.map->control_points())[0], 4 * kPi, 1e-9);
    }
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
