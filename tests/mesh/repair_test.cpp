// For every defect of a mesh, repair() makes a surface of all of its faces.
#include "majorant/mesh/repair.h"

#include <random>

#include "expected_error.h"
#include "mesh/list_edits.h"
#include "mesh/repair_checks.h"
#include "mesh/surfaces_of_any_genus.h"

namespace majorant {
namespace {

using Faces = std::vector<std::vector<Index>>;

PolygonMesh with_faces(PolygonMesh mesh, const Faces& more) {
  mesh.polygons.append(more);
  return mesh;
}

PolygonMesh moebius(int n, int width) {
  std::vector<Vector3> positions;
  for (int k = 0; k < n; ++k)
    for (int j = 0; j <= width; ++j) {
      const double t = 2 * kPi * k / n, w = 0.6 * j / width - 0.3, r = 1 + w * std::cos(t / 2);
      positions.push_back({r * std::cos(t), r * std::sin(t), w * std::sin(t / 2)});
    }
  Faces faces;
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < width; ++j) {
      const auto there = [&](int i) { return k + 1 < n ? (k + 1) * (width + 1) + i : width - i; };
      const Index a = k * (width + 1) + j, b = a + 1, c = there(j), d = there(j + 1);
      faces.push_back({a, c, b});
      faces.push_back({b, c, d});
    }
  return polygon_mesh(positions, faces);
}

TEST(Repair, LeavesGoodMeshesAlone) {
  PolygonMesh far = grid(4, bumpy);
  far.positions.insert(far.positions.begin() + 3, Vector3(7, 7, 7));  // no face uses it
  for (Index& v : far.polygons.indices()) v += v >= 3;
  for (Vector3& p : far.positions) p += Vector3(100, -200, 0);
  for (const PolygonMesh& mesh :
       {grid(5, bumpy), torus(8, 6, 0), torus(8, 6, 1), cone(5, true), tetrahedron(), far,
        voxel_surface(box(2, 3, 1)), textured(grid(3), [](const Vector3&) { return 0; })}) {
    const RepairedSurface out = repaired(mesh);
    EXPECT_TRUE(out.repairs.empty()) << describe(out.repairs.front());
    const SurfaceMesh required = SurfaceMesh::from_polygons(mesh);
    EXPECT_EQ(out.mesh->positions(), required.positions());
    EXPECT_EQ(out.mesh->faces(), required.faces());
    EXPECT_EQ(out.mesh->corner_texcoords(), required.corner_texcoords());
    EXPECT_EQ(out.mesh->boundary_loops(), required.boundary_loops());
    EXPECT_EQ(out.mesh->area(), required.area());
    for (Index v = 0; v < required.vertex_count(); ++v)
      EXPECT_EQ(out.mesh->input_vertex(v), required.input_vertex(v));
  }
}

TEST(Repair, RefusesAMeshWithoutFaces) {
  expect_contains(error_message(ErrorKind::Unsupported, [] { repair(polygon_mesh({}, {})); }),
                  {"inline.obj", "no faces"});
}

TEST(Repair, SplitsVerticesWhereSheetsTouch) {
  // Two spheres with one common vertex, and a boundary that passes a vertex twice.
  PolygonMesh balls = both(octahedron(), octahedron());
  for (Index& v : balls.polygons.indices()) v = v == 11 ? 0 : v;
  RepairedSurface out = repaired(balls);
  EXPECT_EQ(shape_of(out), (Shape{2, 0, 4}));
  EXPECT_EQ(count_of(out, RepairKind::SplitVertex), 1);
  EXPECT_EQ(out.repairs[0].places[0], (std::array<Index, 2>{0, -1}));
  EXPECT_EQ(out.mesh->input_vertex(out.mesh->vertex_count() - 1), 0);  // copies come last

  PolygonMesh holes = grid(6, bumpy);  // two squares that touch in a corner
  erase_lists(holes.polygons, 42, 2);
  erase_lists(holes.polygons, 28, 2);
  out = repaired(holes);
  EXPECT_EQ(shape_of(out), (Shape{1, 2, 0}));
  EXPECT_EQ(count_of(out, RepairKind::SplitVertex), 1);
}

TEST(Repair, AFinStandsOnASheetThatStaysWhole) {
  PolygonMesh fin = cube_sphere(3);
  fin.positions.push_back(2 * fin.positions[fin.polygons[0][0]]);
  const auto last = static_cast<Index>(fin.positions.size()) - 1;
  fin.polygons.push_back({fin.polygons[0][0], fin.polygons[0][1], last});
  const RepairedSurface out = repaired(fin);
  EXPECT_EQ(shape_of(out), (Shape{2, 1, 3}));
  EXPECT_EQ(count_of(out, RepairKind::SplitEdge), 1);
}

// Two cubes that share an edge, in any orientation, and cells of one solid that share an edge,
// where components do not determine the pairs of sides. The results are closed. Sheets that cross
// are opened.
TEST(Repair, SolidsThatShareAnEdgeArePaired) {
  const auto paired = [](const PolygonMesh& mesh) {
    return repair(mesh, {.crowded_edges = CrowdedEdges::Paired});
  };
  const PolygonMesh cubes = voxel_surface({{0, 0, 0}, {0, 0, 1}, {1, 1, 0}, {1, 1, 1}});
  EXPECT_EQ(shape_of(paired(cubes)), (Shape{2, 0, 4}));
  EXPECT_GT(repair(cubes).mesh->topology().boundary_loops, 0);
  PolygonMesh inside_out = cubes;
  for (const auto polygon : inside_out.polygons) std::ranges::reverse(polygon);
  EXPECT_EQ(shape_of(paired(inside_out)), (Shape{2, 0, 4}));
  // The cells at (0, 0) and (1, 1) are connected through cells above and below.
  std::set<Voxel> ring = box(2, 2, 4);
  for (const int z : {1, 2}) {
    ring.erase({1, 0, z});
    ring.erase({0, 1, z});
  }
  EXPECT_EQ(shape_of(paired(voxel_surface(ring))), (Shape{1, 0, 0}));
  PolygonMesh sheets;
  sheets.positions = {{0, 0, 0},  {0, 0, 1}, {1, 0, 0}, {1, 0, 1},  {-1, 0, 0},
                      {-1, 0, 1}, {0, 1, 0}, {0, 1, 1}, {0, -1, 0}, {0, -1, 1}};
  sheets.polygons = {{0, 2, 3, 1}, {4, 0, 1, 5}, {0, 6, 7, 1}, {8, 0, 1, 9}};
  EXPECT_EQ(shape_of(paired(sheets)), shape_of(repair(sheets)));
}

// A triangle with two corners at one position is removed; a polygon loses a corner.
TEST(Repair, EdgesWithoutLengthAreCollapsed) {
  PolygonMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 1, 0}, {2, 0, 0}, {2, 1, 0}};
  mesh.polygons = {{0, 1, 2, 3}, {1, 4, 2}, {1, 5, 6, 4}};
  const RepairedSurface out = repair(mesh, {.short_edges = ShortEdges::Collapsed});
  EXPECT_EQ(shape_of(out), (Shape{1, 1, 1}));
  EXPECT_EQ(count_of(out, RepairKind::CollapsedEdge), 1);
  EXPECT_EQ(describe(out.repairs.front()), "1 edge of no length collapsed (edge (3, 5))");
  EXPECT_EQ(out.mesh->face_count(), 4);
  EXPECT_EQ(out.mesh->input_face(3), 2);  // of the file
  EXPECT_EQ(out.welded[4], 2);
  EXPECT_EQ(out.polygon_corner.row(3).maxCoeff(), 3);
  EXPECT_EQ(count_of(repair(mesh), RepairKind::RegularizedFace), 1);
}

TEST(Repair, AWallAndItsTwoRoomsComeApart) {
  // A box with a wall across: 8 edges of three faces.
  PolygonMesh rooms = voxel_surface(box(4, 2, 2));
  const auto vertex = [&](double y, double z) {
    for (std::size_t v = 0; v < rooms.positions.size(); ++v)
      if (rooms.positions[v] == Vector3(2, y, z)) return static_cast<Index>(v);
    rooms.positions.push_back({2, y, z});
    return static_cast<Index>(rooms.positions.size()) - 1;
  };
  for (const int y : {0, 1})
    for (const int z : {0, 1})
      rooms.polygons.push_back(
          {vertex(y, z), vertex(y + 1, z), vertex(y + 1, z + 1), vertex(y, z + 1)});
  const RepairedSurface out = repaired(rooms);
  EXPECT_EQ(shape_of(out), (Shape{3, 3, 3}));
  EXPECT_EQ(count_of(out, RepairKind::SplitEdge), 8);
  EXPECT_EQ(count_of(out, RepairKind::SplitVertex), 0);
}

// A tetrahedron with a flap at an edge: the two faces that are connected at both ends stay
// connected.
TEST(Repair, FacesConnectedAtBothEndsStayConnected) {
  PolygonMesh mesh = with_faces(tetrahedron(), {{0, 1, 4}});
  mesh.positions.push_back({3, 3, 0});
  const RepairedSurface out = repaired(mesh);
  EXPECT_EQ(shape_of(out), (Shape{2, 1, 3}));
  EXPECT_EQ(count_of(out, RepairKind::SplitEdge), 1);
}

TEST(Repair, DuplicatesMakeASurfaceOfTheirOwn) {
  PolygonMesh mesh = grid(4, bumpy);
  for (int k = 8; k < 16; ++k) {  // a row of squares, duplicated in reverse
    mesh.polygons.push_back(mesh.polygons[k]);
    std::ranges::reverse(mesh.polygons.back());
  }
  mesh.polygons.push_back(mesh.polygons[10]);  // and one face a third time
  const RepairedSurface out = repaired(mesh);
  EXPECT_EQ(shape_of(out), (Shape{3, 3, 3}));
  EXPECT_EQ(count_of(out, RepairKind::DuplicateFace), 9);
  EXPECT_EQ(count_of(out, RepairKind::SplitEdge), 0);
  EXPECT_EQ(count_of(out, RepairKind::TurnedFace), 0);

  // A quad is the same face for each diagonal that its texture coordinates select.
  PolygonMesh pair =
      polygon_mesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 3}, {0, 1, 2, 3}});
  pair.texcoords = {{0, 0}, {0.3, 0.7}, {1, 1}, {0, 1}, {0.7, 0.7}, {1, 0}, {1, 1}, {0, 1}};
  pair.polygon_texcoords = {{0, 1, 2, 3}, {4, 5, 6, 7}};
  EXPECT_EQ(shape_of(repaired(pair)), (Shape{2, 2, 2}));
  // Two triangles differ from the quad.
  PolygonMesh quads = polygon_mesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                                   {{0, 1, 2, 3}, {0, 1, 3}, {1, 2, 3}, {3, 2, 1, 0}});
  EXPECT_EQ(count_of(repaired(quads), RepairKind::DuplicateFace), 1);
}

TEST(Repair, AFaceWithAVertexTwiceGetsThreeCorners) {
  const RepairedSurface out = repaired(with_faces(grid(4), {{0, 1, 1}, {7, 7, 7}}));
  EXPECT_EQ(shape_of(out), (Shape{3, 3, 3}));
  EXPECT_EQ(count_of(out, RepairKind::RepeatedVertex), 2);
  EXPECT_EQ(count_of(out, RepairKind::RegularizedFace), 2);
  const PolygonMesh pentagon = polygon_mesh({{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {1, 0.5, 0}},
                                            {{0, 1, 2, 3, 2}});  // a spike inside
  repaired(pentagon);
}

TEST(Repair, TurnsTheSmallerNumberOfFaces) {
  PolygonMesh mesh = both(grid(6, bumpy), cube_sphere(3));
  for (const int k : {3, 4, 5, 60, 80})
    std::reverse(mesh.polygons[k].begin(), mesh.polygons[k].end());
  RepairedSurface out = repaired(mesh);
  EXPECT_EQ(shape_of(out), (Shape{2, 1, 3}));
  EXPECT_EQ(count_of(out, RepairKind::TurnedFace), 5);
  EXPECT_EQ(out.repairs[0].places[3], (std::array<Index, 2>{60, -1}));
  // The first face is in the minority; its corners are 0, 2, 1 afterwards.
  mesh = grid(6, bumpy);
  std::swap(mesh.polygons[0][0], mesh.polygons[0][1]);
  out = repaired(mesh);
  EXPECT_EQ(count_of(out, RepairKind::TurnedFace), 1);
  EXPECT_EQ(out.polygon_corner.row(0), Eigen::RowVector3i(0, 2, 1));
  for (const PolygonMesh& whole : {grid(3), torus(8, 6, 1)}) {
    PolygonMesh reversed = whole;
    reverse_lists(reversed.polygons);
    EXPECT_TRUE(repaired(reversed).repairs.empty());
  }
}

TEST(Repair, CutsAMoebiusStripOnceAcross) {
  const RepairedSurface out = repaired(moebius(40, 4));
  EXPECT_EQ(shape_of(out), (Shape{1, 1, 1}));
  EXPECT_EQ(count_of(out, RepairKind::CutEdge), 4);
  // In every order and with every orientation of faces.
  std::mt19937 random(1);
  for (int k = 0; k < 5; ++k) {
    PolygonMesh mesh = moebius(40, 4);
    change_lists(mesh.polygons, [&](auto& all) { std::shuffle(all.begin(), all.end(), random); });
    for (const auto polygon : mesh.polygons)
      if (random() % 2) std::swap(polygon[0], polygon[2]);
    const RepairedSurface shuffled = repaired(mesh);
    EXPECT_EQ(shape_of(shuffled), (Shape{1, 1, 1}));
    EXPECT_LE(count_of(shuffled, RepairKind::CutEdge), 5);
  }
}

TEST(Repair, CutsAKleinBottle) {
  constexpr int kN = 12;  // a torus, identified with a reflection in one direction
  std::vector<Vector3> positions;
  for (int i = 0; i < kN; ++i)
    for (int j = 0; j < kN; ++j) {
      const double u = 2 * kPi * i / kN, v = 2 * kPi * j / kN;
      const double r = 3 + std::cos(u / 2) * std::sin(v) - std::sin(u / 2) * std::sin(2 * v);
      positions.push_back({r * std::cos(u), r * std::sin(u),
                           std::sin(u / 2) * std::sin(v) + std::cos(u / 2) * std::sin(2 * v)});
    }
  Faces faces;
  for (int i = 0; i < kN; ++i)
    for (int j = 0; j < kN; ++j) {
      const auto at_row = [&](int row, int k) {
        return row < kN ? row * kN + k % kN : (2 * kN - k) % kN;
      };
      faces.push_back({at_row(i, j), at_row(i + 1, j), at_row(i + 1, j + 1), at_row(i, j + 1)});
    }
  const RepairedSurface out = repaired(polygon_mesh(positions, faces));
  EXPECT_EQ(out.mesh->topology().components, 1);
  EXPECT_EQ(out.mesh->topology().euler_characteristic(), 0);
  EXPECT_GT(count_of(out, RepairKind::CutEdge), 0);
}

// If orientations are kept, faces of opposite orientation are disconnected.
TEST(Repair, OrientationAsGivenTurnsNothing) {
  PolygonMesh mesh = grid(6, bumpy);
  std::swap(mesh.polygons[30][0], mesh.polygons[30][1]);
  const RepairedSurface out = repaired(mesh, {.orientation = Orientation::AsGiven});
  EXPECT_EQ(count_of(out, RepairKind::TurnedFace), 0);
  EXPECT_EQ(count_of(out, RepairKind::CutEdge), 3);
  EXPECT_EQ(out.mesh->topology().components, 2);
  for (Index f = 0; f < out.mesh->face_count(); ++f)
    EXPECT_EQ(out.polygon_corner.row(f), Eigen::RowVector3i(0, 1, 2));
}

TEST(Repair, MovesToTheOriginAndBackExactly) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> digit(-1, 1);
  for (const Vector3& offset :
       {Vector3(1e6, -1e6, 0), Vector3(1e12, 3e11, -7e11), Vector3(4.1e9, 0, 5)}) {
    PolygonMesh mesh = grid(6, bumpy);
    for (Vector3& p : mesh.positions)
      p += offset + 1e-3 * Vector3(digit(random), digit(random), digit(random));
    const RepairedSurface out = repaired(mesh);  // which compares positions for equality
    EXPECT_EQ(count_of(out, RepairKind::MovedToOrigin), 1);
    EXPECT_LE(out.mesh->positions().cwiseAbs().maxCoeff(), 6);
    for (Index h = 0; h < out.mesh->half_edge_count(); ++h) {
      const Vector3 there = mesh.positions[out.mesh->input_vertex(out.mesh->to_vertex(h))] -
                            mesh.positions[out.mesh->input_vertex(out.mesh->from_vertex(h))];
      EXPECT_EQ(out.mesh->edge_length(h), there.norm());
    }
    for (const SurfacePiece& piece : out.mesh->split())
      EXPECT_EQ(piece.mesh->input_position(3), out.mesh->input_position(3));
  }
}

// The diagonal of a quad by its texture coordinates, mirrored or not.
TEST(Repair, SplitsPolygonsWhereTheirTextureAllowsIt) {
  for (const double sign : {1., -1.}) {
    PolygonMesh mesh = polygon_mesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 3}});
    for (const bool along : {false, true}) {
      // A reflex angle in the plane at one corner or at the next one.
      mesh.texcoords = along ? std::vector<Vector2>{{0.7, 0.7}, {1, 0}, {1, 1}, {0, 1}}
                             : std::vector<Vector2>{{0, 0}, {0.3, 0.7}, {1, 1}, {0, 1}};
      for (Vector2& uv : mesh.texcoords) uv.x() *= sign;
      mesh.polygon_texcoords = {{0, 1, 2, 3}};
      const RepairedSurface out = repaired(mesh);
      for (Index f = 0; f < 2; ++f) {
        const auto uv = out.mesh->corner_texcoords().row(f);
        const Vector2 a = uv.segment<2>(0), b = uv.segment<2>(2), c = uv.segment<2>(4);
        EXPECT_GT(sign * cross(b - a, c - a), 0) << sign << along << f;
      }
    }
  }
}

TEST(Repair, SplitsIntoPieces) {
  const RepairedSurface out =
      repaired(both(both(grid(2), cube_sphere(2)), with_faces(grid(3), {{0, 1, 1}})));
  const std::vector<SurfacePiece> pieces = out.mesh->split();
  ASSERT_EQ(pieces.size(), 4u);
  std::vector<Index> times(to_size(out.mesh->face_count()), 0);
  for (const SurfacePiece& piece : pieces) {
    const SurfaceMesh& mesh = *piece.mesh;
    EXPECT_EQ(mesh.topology().components, 1);
    ASSERT_EQ(piece.face.size(), to_size(mesh.face_count()));
    ASSERT_EQ(piece.vertex.size(), to_size(mesh.vertex_count()));
    for (Index f = 0; f < mesh.face_count(); ++f) {
      ++times[piece.face[f]];
      EXPECT_EQ(mesh.input_face(f), out.mesh->input_face(piece.face[f]));
      for (Index k = 0; k < 3; ++k)
        EXPECT_EQ(piece.vertex[mesh.faces()(f, k)], out.mesh->faces()(piece.face[f], k));
    }
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      const Index of_all = piece.vertex[v];
      EXPECT_EQ(Vector3(mesh.positions().row(v)), Vector3(out.mesh->positions().row(of_all)));
      EXPECT_EQ(mesh.input_vertex(v), out.mesh->input_vertex(of_all));
      EXPECT_EQ(mesh.input_vertex(mesh.find_input_vertex(mesh.input_vertex(v))),
                mesh.input_vertex(v));
    }
  }
  EXPECT_EQ(times, std::vector<Index>(times.size(), 1));
  ASSERT_EQ(pieces[3].mesh->rest_triangles().size(), 1u);
  EXPECT_EQ(pieces[3].mesh->rest_triangles()[0].face, 0);
}

// Components whose faces alternate in the file keep their own rest triangles.
TEST(Repair, PiecesKeepTheirRestTriangles) {
  std::vector<Vector3> line;
  for (int k = 0; k < 7; ++k) line.push_back({1.0 * k * k, 0, 0});
  const RepairedSurface out = repaired(polygon_mesh(line, {{0, 1, 2}, {4, 5, 6}, {1, 0, 3}}));
  const std::vector<SurfacePiece> pieces = out.mesh->split();
  ASSERT_EQ(pieces.size(), 2u);
  for (const SurfacePiece& piece : pieces)
    EXPECT_EQ(piece.mesh->rest_triangles().size(), piece.face.size());
}

// Random combinations of defects: the properties hold for all.
TEST(Repair, HoldsForRandomDamage) {
  std::mt19937 random(3);
  const auto below = [&](std::size_t n) { return static_cast<Index>(random() % n); };
  for (int run = 0; run < 400; ++run) {
    PolygonMesh mesh = run % 4 == 0   ? grid(5, bumpy)
                       : run % 4 == 1 ? voxel_surface(box(2, 2, 1))
                       : run % 4 == 2 ? both(torus(6, 5, 1), octahedron())
                                      : moebius(8, 2);
    const int damages = 1 + below(12);
    for (int k = 0; k < damages; ++k) {
      const auto polygon = mesh.polygons[below(mesh.polygons.size())];
      const Index v = below(mesh.positions.size()), w = below(mesh.positions.size());
      switch (below(7)) {
        case 0:
          std::reverse(polygon.begin(), polygon.end());
          break;
        case 1:
          polygon[below(polygon.size())] = v;
          break;
        case 2:
          mesh.positions[v] = mesh.positions[w];
          break;
        case 3:
          mesh.polygons.push_back(polygon);
          break;
        case 4:
          for (Index& corner : mesh.polygons.indices()) corner = corner == v ? w : corner;
          break;
        case 5:
          mesh.polygons.push_back({v, w, below(mesh.positions.size())});
          break;
        default:
          mesh.polygons.push_back({polygon[0], polygon[1], v, w});
      }
    }
    SCOPED_TRACE(run);
    repaired(mesh);
    repaired(mesh, {.weld = 0});
    repaired(mesh, {.orientation = Orientation::AsGiven});
    if (::testing::Test::HasFailure()) return;
  }
}

TEST(Repair, DescribesItsChanges) {
  EXPECT_EQ(describe({RepairKind::TurnedFace, 1, {{6, -1}}}),
            "1 face turned to agree with its neighbours (face 7)");
  expect_contains(
      describe({RepairKind::SplitEdge, 9, {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {8, 9}, {10, 11}}}),
      {"9 edges", "edge (1, 2), (3, 4)", "(9, 10), ...)"});
  EXPECT_EQ(name_of(RepairKind::MovedToOrigin), "moved_to_origin");
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
