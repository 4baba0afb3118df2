// For all options every piece is planar; polygons are not divided; requested cuts are made.
#include "majorant/parametrization/seams/choose_cuts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <set>

#include "expected_error.h"
#include "majorant/mesh/marked_creases.h"
#include "majorant/mesh/repair.h"
#include "majorant/parametrization/seams/visibility.h"
#include "mesh/list_edits.h"
#include "mesh/obj_file.h"
#include "parametrization/seams/cut_checks.h"
#include "public_data.h"

namespace majorant {
namespace {

// Returns whether the two faces at the half-edge, by the sums of their corners, are on two sides.
bool is_between(const SurfaceMesh& mesh, Index h, bool (*is_on)(const Vector3&)) {
  const auto side = [&](Index face) {
    Vector3 sum = Vector3::Zero();
    for (Index k = 0; k < 3; ++k) sum += mesh.positions().row(mesh.faces()(face, k)).transpose();
    return is_on(sum);
  };
  return mesh.opposite(h) >= 0 && side(face_of(h)) != side(face_of(mesh.opposite(h)));
}

TEST(ChooseCuts, LeavesPlanarPieces) {
  std::vector<std::pair<std::string, PolygonMesh>> inputs{
      {"torus", torus(24, 12, 0)},
      {"torus with holes", torus(24, 12, 3)},
      {"genus 2", bar_with_holes(2, 2)},
      {"cube", voxel_surface(box(3, 3, 3))},
      {"capped tube", voxel_surface(box(1, 1, 20))},
      {"sphere, 12 holes", sphere_with_holes(8, 12)},
      {"tetrahedron", tetrahedron()},
      {"disk", grid(6, bumpy)}};
  for (const auto& [name, input] : inputs) {
    const SurfaceMesh mesh = SurfaceMesh::from_polygons(input);
    for (const CutMethod method : {CutMethod::Automatic, CutMethod::Sharp, CutMethod::Given}) {
      SCOPED_TRACE(name + ", method " + std::to_string(static_cast<int>(method)));
      const SurfaceCuts cuts = choose_cuts(mesh, cuts_by(method));
      expect_planar_pieces(mesh, cuts);
      if (method == CutMethod::Automatic) {
        EXPECT_EQ(cuts.components.at(0).pieces, 1);
      }
    }
  }
}

TEST(ChooseCuts, CutsEveryComponent) {
  PolygonMesh two = cube_sphere(4);
  const auto count = static_cast<Index>(two.positions.size());
  const PolygonMesh other = torus(16, 8, 0);
  for (const Vector3& p : other.positions) two.positions.push_back(p + Vector3(9, 0, 0));
  append_lists(two.polygons, other.polygons, count);
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(two, {}, Components::Any);
  const SurfaceCuts cuts = choose_cuts(mesh, {});
  expect_planar_pieces(mesh, cuts);
  ASSERT_EQ(cuts.components.size(), 2u);
  EXPECT_EQ(cuts.components[0].genus, 0);
  EXPECT_EQ(cuts.components[1].genus, 1);
  EXPECT_EQ(cuts.components[1].first_face, cuts.components[0].faces);
}

TEST(ChooseCuts, LeavesPolygonsWhole) {
  for (const PolygonMesh& input : {cube_sphere(6), limbs(8), bar_with_holes(2, 1)}) {
    const SurfaceMesh mesh = SurfaceMesh::from_polygons(input);
    for (const CutMethod method : {CutMethod::Automatic, CutMethod::Sharp, CutMethod::Given}) {
      const SurfaceCuts cuts = choose_cuts(mesh, cuts_by(method));
      for (Index h = 0; h < mesh.half_edge_count(); ++h)
        if (cuts.is_cut[h]) {
          EXPECT_NE(mesh.input_face(face_of(h)), mesh.input_face(face_of(mesh.opposite(h))));
        }
    }
  }
}

TEST(ChooseCuts, AreSymmetricOnSymmetricSurfaces) {
  const SurfaceMesh mesh = mirrored_limbs();
  for (const double stretch : {1.015, 1.02}) {
    SCOPED_TRACE(stretch);
    CutOptions options;
    options.max_stretch = stretch;
    const SurfaceCuts cuts = choose_cuts(mesh, options);
    expect_planar_pieces(mesh, cuts);
    EXPECT_EQ(cuts.components.at(0).pieces, 1);
    EXPECT_LE(cuts.components.at(0).estimated_stretch, stretch);
    EXPECT_GE(mirrored_part(mesh, cuts.is_cut), 0.9);
  }
}

// The stretch of maps is a little above the estimate, and a second cut of a large surface takes
// long.
TEST(ChooseCuts, LargeSurfacesAimBelowTheLimit) {
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(limbs(60));
  ASSERT_GT(mesh.vertex_count(), 20000);
  const CutOptions options;
  const SurfaceCuts cuts = choose_cuts(mesh, options);
  const auto excess = [](double stretch) { return stretch * stretch - 1; };
  const double part =
      excess(cuts.components.front().estimated_stretch) / excess(options.max_stretch);
  EXPECT_LE(part, 0.95);
  EXPECT_GT(part, 0.8);
}

// Also if the symmetry plane is the most visible part.
TEST(ChooseCuts, HiddenCutsAreSymmetricOnSymmetricSurfaces) {
  const std::filesystem::path folder = public_data("closed");
  if (folder.empty()) GTEST_SKIP() << kNoPublicData;
  for (const char* name : {"blub_1886.obj", "spot_1654.obj"}) {
    const PolygonMesh polygons = obj_file(folder / name);
    const RepairedSurface surface = repair(polygons);
    const SurfaceMesh& mesh = *surface.mesh;
    CutOptions options;
    options.preferences.creases = marked_creases(polygons, surface);
    options.preferences.weight = hiding_weights(mesh, ambient_visibility(mesh));
    EXPECT_GE(mirrored_part(mesh, choose_cuts(mesh, options).is_cut), 0.95) << name;
  }
}

// Returns the number of cut vertices for each vertex of the surface: 1 where no cut passes.
std::vector<int> places(const SurfaceMesh& mesh, const std::vector<char>& is_cut) {
  std::vector<Index> uncut;
  mesh.cut_along(is_cut, &uncut);
  std::vector<int> count(to_size(mesh.vertex_count()), 0);
  for (const Index v : uncut) ++count[v];
  return count;
}

TEST(ChooseCuts, CutsAvoidTheVerticesThatStayWhole) {
  for (const PolygonMesh& input : {cube_sphere(6), limbs(8), torus(24, 12, 0)}) {
    const SurfaceMesh mesh = SurfaceMesh::from_polygons(input);
    CutOptions options;
    options.max_stretch = 1.005;
    const std::vector<int> before = places(mesh, choose_cuts(mesh, options).is_cut);
    for (Index v = 0; v < mesh.vertex_count(); ++v)
      if (before[v] > 1 && options.whole.size() < 6 && v % 2 == 0) options.whole.push_back(v);
    ASSERT_FALSE(options.whole.empty());
    const SurfaceCuts cuts = choose_cuts(mesh, options);
    expect_planar_pieces(mesh, cuts);
    const std::vector<int> after = places(mesh, cuts.is_cut);
    for (const Index v : options.whole) EXPECT_EQ(after[v], 1) << v;
  }
  CutOptions outside;
  outside.whole = {99999};
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(tetrahedron());
  expect_contains(error_message(ErrorKind::Usage, [&] { choose_cuts(mesh, outside); }),
                  {"vertex 99999"});
}

TEST(ChooseCuts, UnfoldsDevelopableSurfaces) {
  const SurfaceMesh cube = SurfaceMesh::from_polygons(voxel_surface(box(4, 4, 4)));
  const SurfaceCuts cuts = choose_cuts(cube, {});
  EXPECT_NEAR(cuts.length, 7 * 4, 1e-12);
  EXPECT_NEAR(cuts.components.at(0).estimated_stretch, 1, 1e-9);
  // Neither a flat disk nor a flat ring needs a cut.
  const SurfaceMesh ring = SurfaceMesh::from_polygons(grid_without(8, {3 * 8 + 1}));
  EXPECT_EQ(choose_cuts(ring, {}).edges, 0);
}

TEST(ChooseCuts, EnoughTakesTheFirstSufficientCut) {
  PolygonMesh polygons = limbs(8);
  for (Vector3& p : polygons.positions)  // breaks the mirror symmetry
    for (int k = 0; k < 3; ++k)
      if (p[k] > 0) p[k] *= 1.3 + 0.3 * k;
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(polygons);
  CutOptions at_once;
  at_once.enough = StopCheck([] { return Directive::TimeLimit; });
  const SurfaceCuts first = choose_cuts(mesh, at_once), best = choose_cuts(mesh, {});
  expect_planar_pieces(mesh, first);
  EXPECT_GT(first.length, 1.05 * best.length);
  const StopCheck stop([] { return Directive::Interrupt; });
  EXPECT_THROW(choose_cuts(mesh, at_once, stop), Stopped);
}

TEST(ChooseCuts, RefusesWeightsThatAreNoFactors) {
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(tetrahedron());
  CutOptions options;
  for (const double wrong : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    options.preferences.weight.assign(to_size(mesh.half_edge_count()), 1);
    options.preferences.weight[5] = wrong;
    expect_contains(error_message(ErrorKind::Usage, [&] { choose_cuts(mesh, options); }),
                    {"weight of half-edge 5"});
  }
  options.preferences.weight.assign(3, 1);
  expect_contains(error_message(ErrorKind::Usage, [&] { choose_cuts(mesh, options); }),
                  {"3 weights for 12 half-edges"});
}

TEST(ChooseCuts, CreasesCostAQuarter) {
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(cube_sphere(8));
  CutOptions options;
  options.preferences.creases.assign(to_size(mesh.half_edge_count()), 0);
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    options.preferences.creases[h] =
        is_between(mesh, h, [](const Vector3& p) { return p.z() > 0; });
  EXPECT_NEAR(cost_of_cuts(mesh, options.preferences, options.preferences.creases),
              0.25 * cost_of_cuts(mesh, {}, options.preferences.creases), 1e-9);
  const auto along = [&](const SurfaceCuts& cuts) {
    double length = 0;
    for (Index h = 0; h < mesh.half_edge_count(); ++h)
      if (cuts.is_cut[h] && options.preferences.creases[h]) length += 0.5 * mesh.edge_length(h);
    return length / cuts.length;
  };
  EXPECT_GT(along(choose_cuts(mesh, options)), along(choose_cuts(mesh, {})) + 0.15);
}

TEST(ChooseCuts, MoreStretchNeedsNoMoreSeam) {
  for (const PolygonMesh& input : {limbs(8), limbs(12), torus(24, 12, 0), cube_sphere(8)}) {
    const SurfaceMesh mesh = SurfaceMesh::from_polygons(input);
    double last = std::numeric_limits<double>::infinity();
    for (const double stretch : {1.01, 1.02, 1.05, 1.1, 1.3}) {
      CutOptions options;
      options.max_stretch = stretch;
      const SurfaceCuts cuts = choose_cuts(mesh, options);
      EXPECT_LE(cuts.length, last * (1 + 1e-12)) << stretch;
      last = cuts.length;
    }
  }
}

TEST(ChooseCuts, DependsOnTheShapeOnly) {
  // Without symmetries, which would allow several best cuts.
  const PolygonMesh input = transformed(limbs(8), [](const Vector3& p) -> Vector3 {
    return {p.x() + 0.31 * p.y() * p.y(), 1.2 * p.y() + 0.17 * p.z(), 0.9 * p.z() - 0.23 * p.x()};
  });
  const SurfaceCuts cuts = choose_cuts(SurfaceMesh::from_polygons(input), {});
  EXPECT_EQ(cuts.is_cut, choose_cuts(SurfaceMesh::from_polygons(input), {}).is_cut);
  for (const double scale : {1e-6, 1e6}) {
    const auto scaled =
        transformed(input, [scale](const Vector3& p) -> Vector3 { return scale * p; });
    const SurfaceCuts other = choose_cuts(SurfaceMesh::from_polygons(scaled), {});
    EXPECT_EQ(other.is_cut, cuts.is_cut);
    EXPECT_NEAR(other.length, scale * cuts.length, 1e-9 * scale * cuts.length);
  }
}

TEST(ChooseCuts, GivenEdges) {
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(voxel_surface(box(2, 2, 2)));
  CutOptions options = cuts_by(CutMethod::Given);
  for (Index h = 0; h < mesh.half_edge_count(); ++h)  // around the centre
    if (mesh.positions()(mesh.from_vertex(h), 2) == 1 &&
        mesh.positions()(mesh.to_vertex(h), 2) == 1)
      options.edges.push_back(
          {mesh.input_vertex(mesh.from_vertex(h)), mesh.input_vertex(mesh.to_vertex(h))});
  const SurfaceCuts cuts = choose_cuts(mesh, options);
  expect_planar_pieces(mesh, cuts);
  EXPECT_EQ(cuts.edges, 8);
  EXPECT_EQ(cuts.added_edges, 0);
  EXPECT_EQ(cuts.components.at(0).pieces, 2);
  options.edges.resize(0);
  EXPECT_GT(choose_cuts(mesh, options).added_edges, 1);  // a closed surface needs cuts
}

TEST(ChooseCuts, RefusesPairsThatAreNoEdge) {
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(voxel_surface(box(1, 1, 1)));
  CutOptions options = cuts_by(CutMethod::Given);
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    if (mesh.input_face(face_of(h)) == mesh.input_face(face_of(mesh.opposite(h))))
      options.edges = {{mesh.from_vertex(h), mesh.to_vertex(h)}};
  expect_contains(error_message(ErrorKind::Usage, [&] { choose_cuts(mesh, options); }),
                  {"inside a polygon", std::to_string(options.edges[0][0])});
  options.edges = {{3, 17}};
  expect_contains(error_message(ErrorKind::Usage, [&] { choose_cuts(mesh, options); }),
                  {"3 and 17", "joined by no edge"});
  options = {};
  options.max_stretch = 1;
  expect_contains(error_message(ErrorKind::Usage, [&] { choose_cuts(mesh, options); }),
                  {"stretch"});
  expect_contains(error_message(ErrorKind::Unsupported,
                                [&] { choose_cuts(mesh, cuts_by(CutMethod::Texture)); }),
                  {"texture coordinates"});
}

TEST(ChooseCuts, TextureIslands) {
  PolygonMesh input = voxel_surface(box(2, 2, 2));
  for (const auto& polygon : input.polygons) {  // one chart for each side of the cube
    Vector3 a = input.positions[polygon[0]], c = input.positions[polygon[2]];
    Index axis = 0;
    (c - a).cwiseAbs().minCoeff(&axis);
    const Index island = 2 * axis + (a[axis] > 0);
    input.polygon_texcoords.push_back(polygon);
    for (Index& vt : input.polygon_texcoords.back())
      vt += island * static_cast<Index>(input.positions.size());
  }
  input.texcoords.assign(6 * input.positions.size(), Vector2(0, 0));
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(input);
  const SurfaceCuts cuts = choose_cuts(mesh, cuts_by(CutMethod::Texture));
  expect_planar_pieces(mesh, cuts);
  EXPECT_EQ(cuts.components.at(0).pieces, 6);
  EXPECT_NEAR(cuts.length, 24, 1e-12);
  EXPECT_EQ(cuts.untextured_faces, 0);
  // Two adjacent sides without coordinates form one piece; so do three around a corner, which needs
  // a cut through the corner.
  for (const auto& [sides, pieces] : {std::pair{2, 5}, {3, 4}}) {
    PolygonMesh partial = input;
    partial.polygon_texcoords = {};
    for (const auto texture : input.polygon_texcoords) {
      const Index island = texture[0] / static_cast<Index>(input.positions.size());
      const bool is_left_out = island % 2 == 0 && island < 2 * sides;
      partial.polygon_texcoords.push_back(is_left_out ? std::span<const Index>() : texture);
    }
    const SurfaceMesh some = SurfaceMesh::from_polygons(partial);
    const SurfaceCuts less = choose_cuts(some, cuts_by(CutMethod::Texture));
    expect_planar_pieces(some, less);
    EXPECT_EQ(less.untextured_faces, 4 * sides);
    EXPECT_EQ(less.components.at(0).pieces, pieces);
    EXPECT_EQ(less.added_length > 0, sides == 3);
  }
}

TEST(ChooseCuts, SharpEdges) {
  const SurfaceMesh cube = SurfaceMesh::from_polygons(voxel_surface(box(10, 10, 10)));
  const SurfaceCuts cuts = choose_cuts(cube, cuts_by(CutMethod::Sharp));
  expect_planar_pieces(cube, cuts);
  EXPECT_EQ(cuts.components.at(0).pieces, 6);
  EXPECT_NEAR(cuts.length, 120, 1e-9);
  // Few charts, and none of a single face, although every edge is sharp.
  const SurfaceMesh small = SurfaceMesh::from_polygons(cube_sphere(4));
  CutOptions options = cuts_by(CutMethod::Sharp);
  options.sharp_angle = 1;
  const SurfaceCuts few = choose_cuts(small, options);
  EXPECT_LE(few.components.at(0).pieces, 2 + small.face_count() / 200);
  for (const SurfaceMesh& piece : pieces_of(small, few.is_cut)) EXPECT_GT(piece.face_count(), 1);
}

// Returns a cube without one side.
SurfaceMesh open_box(int n) {
  PolygonMesh box = voxel_surface({{0, 0, 0}});
  if (n > 1) box = cube_sphere(n);
  const auto is_lid = [&](const std::vector<Index>& polygon) {
    double least = 1e9, most = -1e9;
    for (const Vector3& p : box.positions) most = std::max(most, p.z());
    for (const Index v : polygon) least = std::min(least, box.positions[v].z());
    return least > 0.5 * most;
  };
  change_lists(box.polygons, [&](auto& all) { std::erase_if(all, is_lid); });
  box.polygon_lines.clear();
  return SurfaceMesh::from_polygons(box);
}

bool is_any(const std::vector<char>& flags) {
  return std::find(flags.begin(), flags.end(), 1) != flags.end();
}

TEST(CutChart, InTwoConnectedParts) {
  for (const SurfaceMesh& chart :
       {open_box(1), open_box(6), SurfaceMesh::from_polygons(grid(6)),
        SurfaceMesh::from_polygons(grid(1)), SurfaceMesh::from_polygons(sphere_with_holes(8, 12)),
        SurfaceMesh::from_polygons(polygon_mesh(
            {{0, 0, 0}, {1, 0, 0}, {2, 1, 0}, {1, 2, 0}, {0, 1, 0}}, {{0, 1, 2, 3, 4}}))}) {
    const std::vector<char> flags = cut_in_two(chart, {});
    const std::vector<SurfaceMesh> parts = pieces_of(chart, flags);
    ASSERT_EQ(parts.size(), 2u);
    for (const SurfaceMesh& part : parts) EXPECT_NO_THROW(part.require_planar());
    std::set<Index> polygons[2];
    for (std::size_t k = 0; k < 2; ++k)
      for (Index f = 0; f < parts[k].face_count(); ++f) polygons[k].insert(parts[k].input_face(f));
    const bool is_one_polygon = chart.input_face(0) == chart.input_face(chart.face_count() - 1);
    for (const Index p : polygons[0]) EXPECT_TRUE(is_one_polygon || !polygons[1].contains(p));
  }
}

// Parts around ends have half of the area each. A chart with a flat part and a bent end is divided
// at the bend by planes, but in halves by ends.
TEST(CutChart, InHalvesAroundEnds) {
  const SurfaceMesh chart = SurfaceMesh::from_polygons(
      grid(24, [](double x, double) { return x > 0.9 ? 3 * (x - 0.9) : 0.0; }));
  const auto smaller_part = [&](PartsAround centres) {
    const std::vector<SurfaceMesh> parts = pieces_of(chart, cut_in_two(chart, {}, centres));
    EXPECT_EQ(parts.size(), 2u);
    return std::min(parts.front().area(), parts.back().area()) / chart.area();
  };
  EXPECT_LT(smaller_part(PartsAround::Planes), 0.3);
  EXPECT_GT(smaller_part(PartsAround::Ends), 0.4);
}

// A bump of two equal sides: planes leave the choice, and its parts meet where cuts are cheap.
TEST(CutChart, InTwoPartsWhereCutsAreCheap) {
  const SurfaceMesh chart = SurfaceMesh::from_polygons(
      grid(16, [](double x, double y) { return 0.3 * std::sin(3 * x) * std::sin(3 * y); }));
  CutPreferences dear;
  const std::vector<char> plain = cut_in_two(chart, {});
  dear.weight.assign(plain.size(), 1);
  for (std::size_t h = 0; h < plain.size(); ++h)
    if (plain[h]) dear.weight[h] = 8;
  EXPECT_LT(cost_of_cuts(chart, dear, cut_in_two(chart, dear)),
            0.5 * cost_of_cuts(chart, dear, plain));
}

TEST(CutChart, AcrossWhereThatIsShort) {
  // Two rectangles in the plane, joined by a strip of 3 of 24 squares.
  std::set<int> gone;
  for (int j = 8; j < 16; ++j)
    for (int i = 0; i < 24; ++i)
      if (i < 10 || i >= 13) gone.insert(j * 24 + i);
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(grid_without(24, gone));
  const std::vector<char> flags = cut_across(mesh, {}, PathsAcross::BetweenEnds);
  const std::vector<SurfaceMesh> parts = pieces_of(mesh, flags);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_NEAR(parts[0].area(), parts[1].area(), 0.1 * mesh.area());
  EXPECT_NEAR(cost_of_cuts(mesh, {}, flags), 3.0 / 24, 1e-12);
}

// Among others from the inner corner of an L to either side; every path divides the chart.
TEST(CutChart, PathsStartAtTheBottomsOfBays) {
  std::set<int> gone;
  for (int j = 4; j < 12; ++j)
    for (int i = 4; i < 12; ++i) gone.insert(j * 12 + i);
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(grid_without(12, gone));
  Vec uv(2 * mesh.vertex_count());
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    uv.segment<2>(2 * v) = mesh.positions().row(v).head<2>().transpose();
  int straight = 0;
  for (const PathAcross& path : paths_across(mesh, {}, uv)) {
    const std::vector<char> flags = cut_along_path(mesh, {}, path);
    const std::vector<SurfaceMesh> parts = pieces_of(mesh, flags);
    ASSERT_EQ(parts.size(), 2u);
    EXPECT_NEAR(path.smaller_area, std::min(parts[0].area(), parts[1].area()), 0.03);
    std::set<Index> all(path.outlines[0].begin(), path.outlines[0].end());
    all.insert(path.outlines[1].begin(), path.outlines[1].end());
    for (const Index v : mesh.boundary_loops()[0]) EXPECT_TRUE(all.count(v));
    const Vector3 ends[2] = {mesh.positions().row(path.outlines[0].front()),
                             mesh.positions().row(path.outlines[1].front())};
    const Vector3 corner(1.0 / 3, 1.0 / 3, 0);
    const bool is_at_corner =
        (ends[0] - corner).norm() < 1e-12 || (ends[1] - corner).norm() < 1e-12;
    straight += is_at_corner && std::abs(path.length - 1.0 / 3) < 1e-12;
  }
  EXPECT_GE(straight, 2);
}

TEST(CutChart, ThroughItsCorners) {
  const SurfaceMesh box = open_box(1);
  const std::vector<char> flags = cut_corners(box, {});
  const std::vector<SurfaceMesh> parts = pieces_of(box, flags);
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0].boundary_flags(), std::vector<char>(to_size(parts[0].vertex_count()), 1));
  EXPECT_EQ(std::count(flags.begin(), flags.end(), 1), 8);
  EXPECT_FALSE(is_any(cut_corners(SurfaceMesh::from_polygons(grid(4)), {})));
}

TEST(CutChart, FurtherUpToTheRequestedDepth) {
  const SurfaceMesh cap = open_box(12);
  const double before = estimated_stretch(cap);
  for (const double aim :
       {1 + 0.5 * (before - 1), 1 + 0.1 * (before - 1), 1 + 0.02 * (before - 1)}) {
    const std::vector<SurfaceMesh> parts = pieces_of(cap, cut_further(cap, {}, aim));
    ASSERT_EQ(parts.size(), 1u);
    EXPECT_LE(estimated_stretch(parts[0]), aim * (1 + 1e-9));
  }
}

// A strip between two squares with area 0, each in a corner.
TEST(ChooseCuts, FacesWithoutAreaAreApart) {
  PolygonMesh mesh = grid(4, bumpy);
  mesh.positions[12] = mesh.positions[13];
  const auto surface = repair(mesh).mesh;
  Index without = 0;
  for (const RestTriangle& t : surface->rest_triangles()) {
    const SurfaceCuts cuts = choose_cuts(*surface, {});
    for (Index h = 3 * t.face; h < 3 * t.face + 3; ++h)
      EXPECT_EQ(cuts.is_cut[h] != 0, surface->opposite(h) >= 0);
    ++without;
  }
  EXPECT_EQ(without, 2);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
