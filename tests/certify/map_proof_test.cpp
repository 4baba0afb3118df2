// Proofs of files; a data file gets its name only after its proof.
#include "majorant/certify/map_proof.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "io/io_test_helpers.h"
#include "majorant/io/atomic_file.h"
#include "majorant/io/io.h"
#include "majorant/io/read_mesh.h"
#include "majorant/maps/map_file.h"
#include "majorant/parametrization/initialization/start.h"
#include "majorant/parametrization/tessellation/tessellate_map.h"

namespace majorant {
namespace {

// Returns n x n quads of two triangles each, a curved sheet whose map is the identity of (x, y).
PolygonMesh sheet(int n) {
  PolygonMesh mesh;
  mesh.file = "sheet";
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) mesh.positions.emplace_back(i, j, std::sin(i) * std::cos(j));
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const Index a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
      mesh.polygons.push_back({a, b, d});
      mesh.polygons.push_back({a, d, c});
    }
  return mesh;
}

MapFile map_of(const PolygonMesh& mesh, int degree) {
  auto surface = std::make_shared<const SurfaceMesh>(SurfaceMesh::from_polygons(mesh));
  Vec uv(2 * surface->vertex_count());
  for (Index v = 0; v < surface->vertex_count(); ++v)
    uv.segment<2>(2 * v) = surface->positions().row(v).head<2>();
  BezierMap map = BezierMap::linear(surface, uv);
  while (map.degree() < degree) map = map.elevated();
  return to_map_file(map);
}

// Returns the map with separate points for every cell.
MapFile unshared(const MapFile& map) {
  MapFile out = map;
  const auto all = map.cells.reshaped<Eigen::RowMajor>();
  out.points = map.points(all, Eigen::all);
  out.uv = map.uv(all, Eigen::all);
  out.input_vertex = map.input_vertex(all);
  for (Index k = 0; k < out.cells.size(); ++k) out.cells.data()[k] = k;
  return out;
}

ProofRequest of(const PolygonMesh& surface) {
  ProofRequest request;
  request.surface = &surface;
  request.overlap = ProofRequest::Overlap::Forbidden;
  return request;
}

TEST(MapProof, EverythingIsProven) {
  const PolygonMesh mesh = sheet(3);
  for (int degree = 1; degree <= 4; ++degree)
    for (const MapFile& file : {map_of(mesh, degree), unshared(map_of(mesh, degree))}) {
      const MapProof proof(file, "file", of(mesh));
      EXPECT_EQ(proof.verdict(), ProofStatus::Proven) << proof.first_defect();
      EXPECT_EQ(proof.surface.answer, ProofStatus::Proven);
      EXPECT_EQ(proof.injective.answer, ProofStatus::Proven);
      EXPECT_EQ(proof.cuts.others, 0);
    }
  const MapProof alone(map_of(mesh, 2), "file", {});
  EXPECT_EQ(alone.verdict(), ProofStatus::Proven);
  EXPECT_EQ(alone.surface.answer, ProofStatus::NotRequested);
  EXPECT_EQ(alone.injective.answer, ProofStatus::NotRequested);
}

TEST(MapProof, ATearOfOneBitIsFoundAndAllowedAsACut) {
  const PolygonMesh mesh = sheet(3);
  for (int degree = 1; degree <= 3; ++degree) {
    MapFile file = unshared(map_of(mesh, degree));
    const Index corner = file.cells(8, 1);  // of an inner vertex
    file.uv(corner, 0) = std::nextafter(file.uv(corner, 0), 9.0);
    ProofRequest request;
    const MapProof torn(file, "file", request);
    EXPECT_EQ(torn.continuous.answer, ProofStatus::Violated);
    EXPECT_NE(torn.continuous.detail.find("edge ("), std::string::npos);
    request.cuts = CutRule::Seams;  // nearly equal: a seam
    EXPECT_EQ(MapProof(file, "file", request).continuous.answer, ProofStatus::Proven);
    file.uv(corner, 0) += 1e-3;
    EXPECT_EQ(MapProof(file, "file", request).continuous.answer, ProofStatus::Violated);
    request.cuts = CutRule::Free;
    const MapProof free(file, "file", request);
    EXPECT_NE(free.continuous.answer, ProofStatus::Violated);
    EXPECT_GT(free.cuts.others, 0);
    EXPECT_GT(free.cuts.length, 0);
  }
}

// 1e-9 is relative to the diagonal of the layout, not to its larger side, as in tests/checker.
TEST(MapProof, SidesOfASeamMayBeOffByRoundingToNineDigits) {
  const PolygonMesh mesh = sheet(3);
  const MapFile file = unshared(map_of(mesh, 1));
  const double diagonal = (file.uv.colwise().maxCoeff() - file.uv.colwise().minCoeff()).norm();
  ProofRequest request;
  request.cuts = CutRule::Seams;
  for (const auto& [off, answer] :
       {std::pair{0.95e-9, ProofStatus::Proven}, {1.05e-9, ProofStatus::Violated}})
    for (const Index axis : {0, 1}) {
      MapFile torn = file;
      torn.uv(torn.cells(8, 1), axis) += off * diagonal;
      EXPECT_EQ(MapProof(torn, "file", request).continuous.answer, answer) << off << " " << axis;
    }
}

TEST(MapProof, OnlyCutEdgesMayDiffer) {
  const PolygonMesh mesh = sheet(3);
  for (int degree = 1; degree <= 2; ++degree) {
    MapFile file = unshared(map_of(mesh, degree));
    // vertex 1 of cell (0, 1, 5), where (1, 5) is an inner edge
    const Index corner = file.cells(0, 1);
    file.uv(corner, 1) -= 1e-3;
    ProofRequest request;
    request.cuts = CutRule::Free;
    request.cut_edges.emplace();
    const MapProof torn(file, "file", request);
    EXPECT_EQ(torn.continuous.answer, ProofStatus::Violated);
    EXPECT_NE(torn.continuous.detail.find("the sides of 1 inner edge differ where it is not said"),
              std::string::npos)
        << torn.continuous.detail;
    request.cut_edges = {{{5, 1}, {7, 8}, {99, 100}}};
    EXPECT_EQ(MapProof(file, "file", request).continuous.answer, ProofStatus::Proven);
    request.cuts = CutRule::Nothing;  // no cuts are allowed
    EXPECT_EQ(MapProof(file, "file", request).continuous.answer, ProofStatus::Violated);
    request.cuts = CutRule::Seams;
    EXPECT_EQ(MapProof(file, "file", request).continuous.answer, ProofStatus::Violated);
  }
}

// In a sheet that occurs twice, two edges have the same vertices and differ by number only.
TEST(MapProof, AnEdgeOfTwoSheetsMayDifferTwiceIfListedTwice) {
  PolygonMesh mesh = sheet(1);
  const MapFile one = unshared(map_of(mesh, 1));
  MapFile file = one;
  file.points.resize(12, 3);
  file.uv.resize(12, 2);
  file.input_vertex.resize(12);
  file.cells.resize(4, 3);
  file.points << one.points, one.points;
  file.uv << one.uv, one.uv;
  file.input_vertex << one.input_vertex, one.input_vertex;
  file.cells << one.cells, one.cells.array() + 6;
  for (const Index p : {6, 7, 8, 9, 10, 11}) file.uv(p, 0) += 5;
  file.input_face = Eigen::VectorXi::LinSpaced(4, 0, 3);
  for (const Index cell : {1, 3}) file.uv(file.cells(cell, 2), 1) += 1;  // corner 2: vertex 2
  ProofRequest request;
  request.cuts = CutRule::Free;
  EXPECT_EQ(MapProof(file, "file", request).cuts.others, 0);  // no edge of the diagonal moved
  for (const Index cell : {1, 3}) file.uv(file.cells(cell, 0), 0) -= 0.1;
  EXPECT_EQ(MapProof(file, "file", request).cuts.others, 2);
  request.cut_edges = {{{0, 3}}};
  EXPECT_EQ(MapProof(file, "file", request).continuous.answer, ProofStatus::Violated);
  request.cut_edges = {{{0, 3}, {3, 0}}};
  EXPECT_EQ(MapProof(file, "file", request).continuous.answer, ProofStatus::Proven);
}

TEST(MapProof, InvertedCellsAreNamed) {
  const PolygonMesh mesh = sheet(3);
  MapFile file = map_of(mesh, 3);
  file.uv(file.cells(7, 9), 0) += 5;  // the inner control point
  const MapProof proof(file, "file", of(mesh));
  EXPECT_EQ(proof.positive.answer, ProofStatus::Violated);
  EXPECT_NE(proof.positive.detail.find("cell 7"), std::string::npos);
  EXPECT_EQ(proof.not_positive, std::vector<Index>{7});
  EXPECT_EQ(proof.angles.answer, ProofStatus::Undecided);
  EXPECT_EQ(proof.verdict(), ProofStatus::Violated);
}

// Unused points do not increase tolerances.
TEST(MapProof, UnusedPointsWidenNoTolerance) {
  const PolygonMesh mesh = sheet(3);
  MapFile file = map_of(mesh, 2);
  const Index last = file.points.rows();
  file.points.conservativeResize(last + 1, 3);
  file.uv.conservativeResize(last + 1, 2);
  file.input_vertex.conservativeResize(last + 1);
  file.points.row(last).setConstant(1e12);
  file.uv.row(last).setConstant(1e12);
  file.input_vertex[last] = -1;
  EXPECT_EQ(MapProof(file, "file", of(mesh)).verdict(), ProofStatus::Proven);
  file.points(file.cells(0, 3), 2) += 0.01;  // inside an edge: off the flat triangle
  EXPECT_EQ(MapProof(file, "file", of(mesh)).flat.answer, ProofStatus::Violated);
}

TEST(MapProof, TinyAndHugeLayouts) {
  const PolygonMesh mesh = sheet(3);
  for (const double scale : {1e-300, 1e-170, 1e150, 1e300}) {
    MapFile file = map_of(mesh, 1);
    file.uv *= scale;
    ProofRequest request;
    request.surface = &mesh;
    const MapProof proof(file, "file", request);
    EXPECT_EQ(proof.verdict(), ProofStatus::Proven) << scale << " " << proof.first_defect();
  }
}

TEST(MapProof, ExactProofsAreStoppedToo) {
  // det J = 0 at one inner point, of degree 6: thousands of pieces with growing integers.
  MapFile file = map_of(sheet(1), 6);
  file.cells = file.cells.topRows(1).eval();
  file.input_face.conservativeResize(1);
  for (Index k = 0; k < file.cells.cols(); ++k) file.uv.row(file.cells(0, k)).setZero();
  file.uv(file.cells(0, 1), 0) = 1;
  int polls = 0;
  ProofRequest request;
  request.stop =
      StopCheck([&] { return ++polls > 3 ? Directive::Interrupt : Directive::Continue; });
  const MapProof proof(file, "file", request);
  EXPECT_NE(proof.verdict(), ProofStatus::Proven);
  EXPECT_LT(polls, 20);
}

TEST(MapProof, AStopLeavesAllAnswersUndecided) {
  const PolygonMesh mesh = sheet(20);
  const MapFile file = map_of(mesh, 2);
  ProofRequest request = of(mesh);
  request.stop = StopCheck([] { return Directive::Interrupt; });
  const MapProof proof(file, "file", request);
  EXPECT_EQ(proof.verdict(), ProofStatus::Undecided);
  EXPECT_EQ(proof.positive.answer, ProofStatus::Undecided);
  EXPECT_EQ(proof.injective.answer, ProofStatus::Undecided);
}

TEST(MapProof, DecimalsThatDifferFromTheirDoubles) {
  const TemporaryFolder folder;
  const auto judge = [&](const char* text) {
    write_file_atomically(folder.file("a.obj"), text);
    return MapProof(read_map(folder.file("a.obj")), "a.obj", {}).positive.answer;
  };
  const std::string v = "v 0 0 0\nv 1 0 0\nv 0 1 0\n", f = "f 1/1 2/2 3/3\n";
  const auto with = [&](const std::string& vt) { return v + vt + f; };
  EXPECT_EQ(judge(with("vt 0 0\nvt 1 0\nvt 0 1\n").c_str()), ProofStatus::Proven);
  EXPECT_EQ(judge(with("vt 0 0\nvt 0.1 0.1\nvt 0.3 0.5\n").c_str()), ProofStatus::Proven);
  EXPECT_EQ(judge(with("vt 0 0\nvt 1 1\nvt 3 3\n").c_str()), ProofStatus::Violated);
  // The decimals are collinear; 3 * fl(0.1) is not fl(0.3).
  EXPECT_EQ(judge(with("vt 0 0\nvt 0.1 1\nvt 0.3 3\n").c_str()), ProofStatus::Undecided);
  EXPECT_EQ(judge(with("vt 0 0\nvt 0.3 3\nvt 0.1 1\n").c_str()), ProofStatus::Undecided);
}

// If a writer loses a digit, the file is not written.
TEST(CertifiedFile, ADroppedDigitIsNotWritten) {
  const TemporaryFolder folder;
  const PolygonMesh mesh = sheet(3);
  MapFile file = map_of(mesh, 1);
  for (Index p = 0; p < file.uv.rows(); ++p) file.uv(p, 0) += 0.123456789 * file.uv(p, 1);
  const std::string text = obj_text(tessellate_map(file, &mesh));
  const std::string path = folder.file("out.obj");
  write_file_atomically(path, text, certification(path, of(mesh)));
  EXPECT_EQ(content_of(path), text);
  std::filesystem::remove(path);

  std::size_t refused = 0, digits = 0;
  const std::size_t first = text.find("vt "), end = text.find("f ");
  for (std::size_t at = first; at < end; ++at) {
    if (!std::isdigit(static_cast<unsigned char>(text[at]))) continue;
    std::string broken = text;
    broken.erase(at, 1);
    ++digits;
    try {
      write_file_atomically(path, broken, certification(path, of(mesh)));
      std::filesystem::remove(path);
    } catch (const Error& e) {
      ++refused;
      EXPECT_EQ(e.kind(), ErrorKind::Invalid);
      EXPECT_NE(std::string(e.what()).find("out.obj is not written"), std::string::npos);
      EXPECT_FALSE(std::filesystem::exists(path));
    }
  }
  // Changes of late digits leave a map valid, those of the first ones invert triangles.
  EXPECT_GT(refused, 15u);
  EXPECT_LT(refused, digits);
}

TEST(CertifiedFile, AnotherSurfaceATearAndAnOverlapAreNotWritten) {
  const TemporaryFolder folder;
  const PolygonMesh mesh = sheet(3);
  const MapFile good = map_of(mesh, 2);
  const std::string path = folder.file("out.vtu");
  const auto message = [&](const MapFile& file, const ProofRequest& required) {
    const std::string text = error_message(
        ErrorKind::Invalid, [&] { write_vtu(path, file, certification(path, required)); });
    EXPECT_FALSE(std::filesystem::exists(path));
    return text;
  };
  EXPECT_NE(message(good, of(sheet(2))).find("surface"), std::string::npos);
  MapFile torn = unshared(good);
  torn.uv(torn.cells(8, 1), 0) += 1e-6;
  EXPECT_NE(message(torn, of(mesh)).find("not continuous"), std::string::npos);
  // the left column covers the others a second time: cut there, positive
  MapFile folded = unshared(good);
  ProofRequest free = of(mesh);
  free.cuts = CutRule::Free;
  for (Index c = 0; c < folded.cells.rows(); ++c)
    if (c % 6 < 2)
      for (Index k = 0; k < folded.cells.cols(); ++k) folded.uv(folded.cells(c, k), 0) += 1;
  EXPECT_NE(message(folded, free).find("not globally injective"), std::string::npos);
}

// Returns twelve triangles around vertex 0 with angles of 30 degrees, which are 90 degrees in the
// map.
PolygonMesh cone_of_1080_degrees() {
  PolygonMesh mesh;
  mesh.file = "cone";
  mesh.positions.emplace_back(0, 0, 0);
  mesh.texcoords.emplace_back(0, 0);
  const Vector2 steps[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  for (Index k = 0; k < 12; ++k) {
    const double angle = k * std::acos(-1.0) / 6;
    mesh.positions.emplace_back(std::cos(angle), std::sin(angle), 0);
    mesh.texcoords.push_back(steps[k % 4]);
    mesh.polygons.push_back({0, k + 1, (k + 1) % 12 + 1});
  }
  mesh.polygon_texcoords = mesh.polygons;
  return mesh;
}

TEST(MapProof, ConesKnownFromClaimsNeedAFormatWithClaims) {
  const TemporaryFolder folder;
  const PolygonMesh mesh = cone_of_1080_degrees();
  MapFile map = to_map_file(mesh);
  const ProofRequest seams{.surface = &mesh, .cuts = CutRule::Seams};
  ASSERT_EQ(MapProof(map, "cone", seams).first_defect(), "");
  const std::string vtu = folder.file("a.vtu"), obj = folder.file("a.obj");
  map.claims = R"({"seams": true})";
  write_vtu(vtu, map, certification(vtu, seams));
  const auto refusal = [&](const std::string& path, const auto& write) {
    expect_contains(error_message(ErrorKind::Invalid, write),
                    {path, "vertex 0", "1080", "tell a cone", ".vtu"});
    EXPECT_FALSE(std::filesystem::exists(path));
  };
  refusal(obj, [&] { write_obj(obj, map, &mesh, {}, certification(obj, seams)); });
  const std::string unsaid = folder.file("b.vtu");
  map.claims.clear();
  refusal(unsaid, [&] { write_vtu(unsaid, map, certification(unsaid, seams)); });
}

TEST(MapProof, ClaimedCutsBindTheWriter) {
  const TemporaryFolder folder;
  const PolygonMesh mesh = sheet(3);
  MapFile file = unshared(map_of(mesh, 1));
  file.uv(file.cells(0, 1), 1) -= 1e-3;  // at the inner edge (1, 5)
  const ProofRequest free{.surface = &mesh, .cuts = CutRule::Free};
  const std::string path = folder.file("a.vtu");
  file.claims = R"({"cuts": [[1, 5]]})";
  write_vtu(path, file, certification(path, free));
  EXPECT_TRUE(std::filesystem::remove(path));
  file.claims = R"({"cuts": []})";
  expect_contains(
      error_message(ErrorKind::Invalid, [&] { write_vtu(path, file, certification(path, free)); }),
      {path, "(1, 5)", "not said to be cut"});
  EXPECT_FALSE(std::filesystem::exists(path));
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
