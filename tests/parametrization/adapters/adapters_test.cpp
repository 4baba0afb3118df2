// Requirements of all adapters, on one surface in three data structures: a quad, a triangle and a
// pentagon around a vertex, one deleted element, and a vertex without faces.
#include <gtest/gtest.h>

#if __has_include(<OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>)
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>

#include "majorant/parametrization/adapters/openmesh.h"
#define HAS_OPENMESH
#endif
#if __has_include(<CGAL/Surface_mesh.h>)
#include <CGAL/Simple_cartesian.h>

#include "majorant/parametrization/adapters/cgal.h"
#define HAS_CGAL
#endif

#include "expected_error.h"
#include "majorant/parametrization/adapters/eigen.h"
#include "majorant/parametrization/initialization/start.h"

namespace majorant {
namespace {

const std::vector<Vector3> kPositions{{0, 0, 0},   {9, 9, 9},  {1, 0, 0.2}, {1, 1, 0},
                                      {0, 1, 0.1}, {-1, 0, 0}, {-1, -1, 0}, {0, -1, 0.3},
                                      {1, -1, 0},  {7, 7, 7}};
const std::vector<std::vector<Index>> kPolygons{
    {0, 2, 3, 4}, {0, 4, 5}, {0, 5, 6, 7}, {2, 0, 7, 8}};
constexpr std::size_t kDeleted = 1;  // number of the deleted polygon

PolygonMesh expected_polygons() {
  PolygonMesh out;
  out.positions = kPositions;
  for (std::size_t p = 0; p < kPolygons.size(); ++p)
    if (p != kDeleted) out.polygons.push_back(kPolygons[p]);
  return out;
}

// Returns uv by (polygon, vertex), as the library computes them without an adapter.
std::vector<std::vector<Vector2>> expected_uv() {
  const PolygonMesh polygons = expected_polygons();
  return corner_uv(
      polygons,
      *parametrize(std::make_shared<const SurfaceMesh>(SurfaceMesh::from_polygons(polygons)), {})
           .map);
}

// Returns uv by vertex; data structures begin faces with different corners.
Vector2 uv_at(const std::vector<std::vector<Vector2>>& uv, std::size_t polygon, Index vertex) {
  const IndexLists polygons = expected_polygons().polygons;
  const auto corners = polygons[polygon];
  const auto k = std::find(corners.begin(), corners.end(), vertex) - corners.begin();
  return uv[polygon][static_cast<std::size_t>(k)];
}

TEST(CornerUv, AllOfThePolygons) {
  const auto uv = expected_uv();
  ASSERT_EQ(uv.size(), 3u);
  for (const auto& polygon : uv)
    for (const Vector2& point : polygon) EXPECT_TRUE(point.allFinite());
  EXPECT_EQ(uv_at(uv, 0, 2), uv_at(uv, 2, 2));  // copies of one vertex have equal uv
}

TEST(CornerUv, IsNaNOutsideOfTheChart) {
  PolygonMesh two = expected_polygons();
  const auto map =
      parametrize(std::make_shared<const SurfaceMesh>(SurfaceMesh::from_polygons(two)), {}).map;
  two.polygons.push_back({1, 8, 9});
  const auto uv = corner_uv(two, *map);
  EXPECT_TRUE(uv[2][0].allFinite());
  EXPECT_TRUE(uv[3][0].hasNaN());
}

TEST(CornerUv, RefusesOtherMeshesAndPolygonsThatASeamCrosses) {
  const PolygonMesh polygons = expected_polygons();
  const auto mesh = std::make_shared<const SurfaceMesh>(SurfaceMesh::from_polygons(polygons));
  const BezierMap map = *parametrize(mesh, {}).map;
  PolygonMesh other = polygons;
  other.polygons.resize(other.polygons.size() - 1);
  expect_contains(error_message(ErrorKind::Usage, [&] { corner_uv(other, map); }),
                  {"face 2", "there is no such face"});
  other = polygons;
  const IndexLists before = other.polygons;
  other.polygons = {};
  for (const std::size_t p : {1, 0, 2}) other.polygons.push_back(before[p]);
  expect_contains(error_message(ErrorKind::Usage, [&] { corner_uv(other, map); }),
                  {"the face lacks this vertex"});

  std::vector<char> is_cut(to_size(mesh->half_edge_count()), 0);
  for (Index h = 0; h < mesh->half_edge_count(); ++h)
    if (const Index o = mesh->opposite(h); o >= 0 && mesh->input_face(h / 3) == 0)
      is_cut[h] = is_cut[o] = mesh->input_face(o / 3) == 0;
  const auto cut = std::make_shared<const SurfaceMesh>(mesh->cut_along(is_cut, nullptr));
  Vec uv = Vec::Zero(2 * cut->vertex_count());
  for (Index v = 0; v < cut->vertex_count(); ++v) uv[2 * v] = v;  // separates copies
  expect_contains(error_message(ErrorKind::Unsupported,
                                [&] { corner_uv(polygons, BezierMap::linear(cut, uv)); }),
                  {"face 0", "a seam runs across the polygon"});
}

TEST(Eigen, AnyScalarsAndOrders) {
  const RowMatrix V = (RowMatrix(5, 3) << 0, 0, 0, 1, 0, 0, 1, 1, 0.5, 0, 1, 0, 8, 8, 8).finished();
  const Cells F = (Cells(2, 3) << 0, 1, 2, 0, 2, 3).finished();
  const auto mesh = std::make_shared<const SurfaceMesh>(SurfaceMesh::from_arrays(V, F));
  const Points2 expected = parametrize(mesh, {}).map->corner_uv();
  const Eigen::MatrixXf columns = V.cast<float>();
  const Eigen::Matrix<long, Eigen::Dynamic, 3> of_long = F.cast<long>();
  const Eigen::Matrix<unsigned, 2, 3> of_unsigned = F.cast<unsigned>();
  EXPECT_EQ(corner_uv(of_long, *parametrize(columns, of_long).map), expected);
  EXPECT_EQ(corner_uv(of_unsigned, *parametrize(V, of_unsigned).map), expected);
  const Cells quad = (Cells(1, 4) << 0, 1, 2, 3).finished();
  EXPECT_EQ(corner_uv(quad, *parametrize(V, quad).map).rows(), 4);
}

TEST(Eigen, ErrorsComeThrough) {
  Eigen::MatrixXd V = Eigen::MatrixXd::Zero(3, 3);
  V(1, 0) = V(2, 1) = 1;
  using LongFaces = Eigen::Matrix<long, 1, 3>;
  for (const long wrong : {-1l, 3l, (1l << 32) + 2})
    expect_contains(
        error_message(ErrorKind::Usage, [&] { parametrize(V, LongFaces(0, 1, wrong)); }),
        {"face 0 has vertex " + std::to_string(wrong) + ", there are 3"});
  expect_contains(
      error_message(ErrorKind::Usage,
                    [&] { parametrize(Eigen::MatrixXd::Zero(3, 2), LongFaces(0, 1, 2)); }),
      {"positions have 2 columns"});
  expect_contains(
      error_message(ErrorKind::Unsupported, [&] { parametrize(V, LongFaces(0, 1, 1)); }),
      {"face 0", "a vertex occurs twice"});
}

#ifdef HAS_OPENMESH
struct Doubles : OpenMesh::DefaultTraitsDouble {
  typedef OpenMesh::Vec2d TexCoord2D;
};

template <class Mesh>
Mesh open_mesh() {
  Mesh mesh;
  mesh.request_vertex_status();
  mesh.request_edge_status();
  mesh.request_face_status();
  for (const Vector3& p : kPositions)
    mesh.add_vertex(typename Mesh::Point(static_cast<typename Mesh::Scalar>(p[0]),
                                         static_cast<typename Mesh::Scalar>(p[1]),
                                         static_cast<typename Mesh::Scalar>(p[2])));
  for (const auto& polygon : kPolygons) {
    std::vector<OpenMesh::VertexHandle> handles(polygon.begin(), polygon.end());
    mesh.add_face(handles);
  }
  mesh.delete_face(mesh.face_handle(kDeleted), false);
  return mesh;
}

TEST(OpenMesh, TexcoordsBeforeAndAfterGarbageCollection) {
  using Mesh = OpenMesh::PolyMesh_ArrayKernelT<Doubles>;
  Mesh mesh = open_mesh<Mesh>();
  const auto uv = expected_uv();
  for (const bool collects : {false, true}) {
    if (collects) mesh.garbage_collection();
    const ParametrizationResult result = parametrize(mesh);
    EXPECT_EQ(result.status, Status::Converged);
    std::size_t polygon = 0;
    for (const auto f : mesh.faces()) {
      const auto corners = f.halfedges().to_vector();
      EXPECT_EQ(corners.size(), 4u);
      for (const auto h : corners) {
        const Vector2 here = {mesh.texcoord2D(h)[0], mesh.texcoord2D(h)[1]};
        const PolygonMesh here_too = polygons_of(mesh);
        const auto place = here_too.polygons[polygon];
        const Index of_corner =
            static_cast<Index>(std::find(place.begin(), place.end(), h.to().idx()) - place.begin());
        // OpenMesh chooses the first corner of a face, which may change its triangulation.
        EXPECT_EQ(here, corner_uv(polygons_of(mesh), *result.map)[polygon][of_corner]);
        if (!collects) {
          EXPECT_NEAR((here - uv_at(uv, polygon, h.to().idx())).norm(), 0, 1e-6);
        }
      }
      ++polygon;
    }
    EXPECT_EQ(polygon, 3u);
  }
}

TEST(OpenMesh, FloatsAndErrors) {
  using Mesh = OpenMesh::PolyMesh_ArrayKernelT<>;
  Mesh mesh = open_mesh<Mesh>();
  EXPECT_EQ(parametrize(mesh).status, Status::Converged);
  EXPECT_TRUE(mesh.has_halfedge_texcoords2D());
  mesh.delete_face(mesh.face_handle(0), false);  // two faces with a common edge remain
  mesh.delete_face(mesh.face_handle(2), false);
  mesh.delete_face(mesh.face_handle(3), false);
  expect_contains(error_message(ErrorKind::Unsupported, [&] { parametrize(mesh); }),
                  {"the mesh has no faces"});
}
#else
TEST(OpenMesh, Texcoords) { GTEST_SKIP() << "no OpenMesh"; }
#endif

#ifdef HAS_CGAL
TEST(Cgal, TexcoordsBeforeAndAfterGarbageCollection) {
  using Point = CGAL::Simple_cartesian<double>::Point_3;
  CGAL::Surface_mesh<Point> mesh;
  using Vertex = CGAL::SM_Vertex_index;
  for (const Vector3& p : kPositions) mesh.add_vertex(Point(p[0], p[1], p[2]));
  for (const auto& polygon : kPolygons) {
    std::vector<Vertex> handles;
    for (const Index v : polygon) handles.emplace_back(static_cast<unsigned>(v));
    mesh.add_face(handles);
  }
  CGAL::Euler::remove_face(mesh.halfedge(CGAL::SM_Face_index(kDeleted)), mesh);
  ASSERT_TRUE(mesh.has_garbage());
  const auto expected = expected_uv();
  for (const bool collects : {false, true}) {
    if (collects) mesh.collect_garbage();
    const ParametrizationResult result = parametrize(mesh);
    EXPECT_EQ(result.status, Status::Converged);
    const auto uv = texcoords_of(mesh);
    std::size_t polygon = 0;
    for (const auto f : mesh.faces()) {
      for (const auto h : mesh.halfedges_around_face(mesh.halfedge(f))) {
        const Vector2 here = {uv[h].x(), uv[h].y()};
        const PolygonMesh here_too = polygons_of(mesh);
        const auto place = here_too.polygons[polygon];
        const Index v = static_cast<Index>(mesh.target(h).idx());
        const auto k = std::find(place.begin(), place.end(), v) - place.begin();
        EXPECT_EQ(here,
                  corner_uv(polygons_of(mesh), *result.map)[polygon][static_cast<std::size_t>(k)]);
        if (!collects) {
          EXPECT_NEAR((here - uv_at(expected, polygon, v)).norm(), 0, 1e-6);
        }
      }
      ++polygon;
    }
    EXPECT_EQ(polygon, 3u);
  }
}
#else
TEST(Cgal, Texcoords) { GTEST_SKIP() << "no CGAL"; }
#endif

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
