// CGAL: a Surface_mesh in, its property map "h:uv" of half-edges out, each at the corner that its
// half-edge points to, as CGAL's own parametrizations name it. Needs CGAL (tested with 5.5), whose
// Surface_mesh is under the GPL; majorant itself does not use it.
//
//   using Point = CGAL::Simple_cartesian<double>::Point_3;
//   CGAL::Surface_mesh<Point> mesh;
//   CGAL::IO::read_polygon_mesh("cap.obj", mesh);
//   const ParametrizationResult result = parametrize(mesh);
//   const auto uv = texcoords_of(mesh);
//   for (const auto h : mesh.halfedges())
//     if (!mesh.is_border(h)) std::cout << uv[h] << "\n";
//
// Elements that are removed and not collected yet are passed over. Messages count vertices as their
// descriptors do, faces as mesh.faces() gives them: as their descriptors where none is removed.
//
// Not for meshes with defects: polygons_of(mesh) and repair().
#pragma once

#include <CGAL/Kernel_traits.h>
#include <CGAL/Surface_mesh.h>

#include <memory>

#include "majorant/parametrization/adapters/corner_uv.h"
#include "majorant/parametrization/solve/parametrize.h"

namespace majorant {

// Vertices by the numbers of their descriptors. For repair(), unwrap() and starts of one's own.
template <class Point>
PolygonMesh polygons_of(const CGAL::Surface_mesh<Point>& mesh) {
  PolygonMesh out;
  out.positions.assign(mesh.num_vertices(), Vector3::Zero());  // of removed ones: no face has them
  for (const auto v : mesh.vertices()) {
    const Point& p = mesh.point(v);
    out.positions[v.idx()] = {CGAL::to_double(p.x()), CGAL::to_double(p.y()),
                              CGAL::to_double(p.z())};
  }
  std::vector<Index> polygon;
  for (const auto f : mesh.faces()) {
    polygon.clear();
    for (const auto h : mesh.halfedges_around_face(mesh.halfedge(f)))
      polygon.push_back(static_cast<Index>(mesh.target(h).idx()));
    out.polygons.push_back(polygon);
  }
  return out;
}

// The property map "h:uv", which is added where there is none.
template <class Point>
auto texcoords_of(CGAL::Surface_mesh<Point>& mesh) {
  using Uv = typename CGAL::Kernel_traits<Point>::Kernel::Point_2;
  return mesh.template add_property_map<CGAL::SM_Halfedge_index, Uv>("h:uv").first;
}

// map: of the surface that polygons_of(mesh) became, or of a chart of it; the mesh is the same
// still. Half-edges of other faces keep what they have. Throws as corner_uv().
template <class Point>
void set_texcoords(CGAL::Surface_mesh<Point>& mesh, const BezierMap& map) {
  const auto uv = corner_uv(polygons_of(mesh), map);
  auto texcoords = texcoords_of(mesh);
  auto polygon = uv.begin();
  for (const auto f : mesh.faces()) {
    auto corner = polygon++->begin();
    for (const auto h : mesh.halfedges_around_face(mesh.halfedge(f))) {
      const Vector2& here = *corner++;
      if (here.allFinite()) texcoords[h] = {here[0], here[1]};
    }
  }
}

// As parametrize() of a SurfaceMesh; texture coordinates are set where the result is valid.
// Vertices of pins and handles are those of the SurfaceMesh: numbers of descriptors where every
// vertex has a face and none is removed.
template <class Point>
ParametrizationResult parametrize(CGAL::Surface_mesh<Point>& mesh,
                                  const ParametrizationOptions& options = {}) {
  ParametrizationResult result = parametrize(
      std::make_shared<const SurfaceMesh>(SurfaceMesh::from_polygons(polygons_of(mesh))), options);
  if (result.map && result.status != Status::Failed) set_texcoords(mesh, *result.map);
  return result;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
