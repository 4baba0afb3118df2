// An adapter for CGAL: takes a Surface_mesh and writes its half-edge property map "h:uv". Each
// value belongs to the corner that the half-edge points to, as in CGAL's own parametrizations.
// Needs CGAL (tested with 5.5). CGAL's Surface_mesh is under the GPL; majorant itself does not use
// it.
//
//   using Point = CGAL::Simple_cartesian<double>::Point_3;
//   CGAL::Surface_mesh<Point> mesh;
//   CGAL::IO::read_polygon_mesh("cap.obj", mesh);
//   const ParametrizationResult result = parametrize(mesh);
//   const auto uv = texcoords_of(mesh);
//   for (const auto h : mesh.halfedges())
//     if (!mesh.is_border(h)) std::cout << uv[h] << "\n";
//
// Elements that are removed but not yet collected are skipped. Messages number vertices as their
// descriptors do, and faces in the order of mesh.faces(), which are the descriptors where none is
// removed.
//
// For meshes with defects, use polygons_of(mesh) and repair().
#pragma once

#include <CGAL/Kernel_traits.h>
#include <CGAL/Surface_mesh.h>

#include <memory>

#include "majorant/parametrization/adapters/corner_uv.h"
#include "majorant/parametrization/solve/parametrize.h"

namespace majorant {

// Returns the mesh as polygons, vertices numbered as their descriptors, for repair(), unwrap() and
// custom initial maps.
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

// Returns the property map "h:uv", which is added if the mesh has none.
template <class Point>
auto texcoords_of(CGAL::Surface_mesh<Point>& mesh) {
  using Uv = typename CGAL::Kernel_traits<Point>::Kernel::Point_2;
  return mesh.template add_property_map<CGAL::SM_Halfedge_index, Uv>("h:uv").first;
}

// Writes the map to "h:uv". map: of the surface made from polygons_of(mesh), or of a chart of it;
// the mesh must be unchanged. Half-edges of other faces keep their values. Throws the errors of
// corner_uv().
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

// Parametrizes the mesh as parametrize() does a SurfaceMesh, and sets texture coordinates if the
// result is valid. Pins and handles refer to vertices of the SurfaceMesh; these are the descriptors
// where every vertex has a face and none is removed.
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
