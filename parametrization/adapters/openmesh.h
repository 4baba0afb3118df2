// An adapter for OpenMesh: takes a TriMesh or PolyMesh and writes its halfedge_texcoords2D. Each
// value belongs to the corner that the half-edge points to. Needs OpenMesh (tested with 9.0), which
// majorant itself does not link.
//
//   OpenMesh::PolyMesh_ArrayKernelT<> mesh;
//   OpenMesh::IO::read_mesh(mesh, "cap.obj");
//   const ParametrizationResult result = parametrize(mesh);
//   for (const auto h : mesh.halfedges())
//     if (!mesh.is_boundary(h)) std::cout << mesh.texcoord2D(h) << "\n";
//
// Elements that are deleted but not yet collected are skipped. Messages number vertices as their
// handles do, and faces in the order of mesh.faces(), which are the handles where none is deleted.
//
// Texture coordinates of OpenMesh's default traits are floats, but only result.map, in doubles, is
// certified. Traits with `typedef OpenMesh::Vec2d TexCoord2D;` keep all digits.
//
// For meshes with defects, use polygons_of(mesh) and repair().
#pragma once

#include <OpenMesh/Core/Mesh/PolyConnectivity.hh>
#include <OpenMesh/Core/Utils/vector_traits.hh>
#include <concepts>
#include <memory>

#include "majorant/parametrization/adapters/corner_uv.h"
#include "majorant/parametrization/solve/parametrize.h"

namespace majorant {

template <class Mesh>
concept OpenMeshMesh = std::derived_from<Mesh, OpenMesh::PolyConnectivity>;

// Returns the mesh as polygons, vertices numbered as their handles, for repair(), unwrap() and
// custom initial maps.
template <OpenMeshMesh Mesh>
PolygonMesh polygons_of(const Mesh& mesh) {
  PolygonMesh out;
  out.positions.assign(mesh.n_vertices(), Vector3::Zero());  // of deleted ones: no face has them
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    static_assert(OpenMesh::vector_traits<std::decay_t<decltype(p)>>::size_ == 3);
    out.positions[static_cast<std::size_t>(v.idx())] = {double(p[0]), double(p[1]), double(p[2])};
  }
  std::vector<Index> polygon;
  for (const auto f : mesh.faces()) {
    polygon.clear();
    for (const auto h : mesh.fh_range(f)) polygon.push_back(mesh.to_vertex_handle(h).idx());
    out.polygons.push_back(polygon);
  }
  return out;
}

// Writes the map to the texture coordinates of half-edges. map: of the surface made from
// polygons_of(mesh), or of a chart of it; the mesh must be unchanged. Half-edges of other faces
// keep their values. Throws the errors of corner_uv().
template <OpenMeshMesh Mesh>
void set_texcoords(Mesh& mesh, const BezierMap& map) {
  const auto uv = corner_uv(polygons_of(mesh), map);
  if (!mesh.has_halfedge_texcoords2D()) mesh.request_halfedge_texcoords2D();
  using TexCoord = typename Mesh::TexCoord2D;
  using Number = typename OpenMesh::vector_traits<TexCoord>::value_type;
  auto polygon = uv.begin();
  for (const auto f : mesh.faces()) {
    auto corner = polygon++->begin();
    for (const auto h : mesh.fh_range(f)) {
      const Vector2& here = *corner++;
      if (here.allFinite())
        mesh.set_texcoord2D(h,
                            TexCoord(static_cast<Number>(here[0]), static_cast<Number>(here[1])));
    }
  }
}

// Parametrizes the mesh as parametrize() does a SurfaceMesh, and sets texture coordinates if the
// result is valid. Pins and handles refer to vertices of the SurfaceMesh; these are the handles
// where every vertex has a face and none is deleted.
template <OpenMeshMesh Mesh>
ParametrizationResult parametrize(Mesh& mesh, const ParametrizationOptions& options = {}) {
  ParametrizationResult result = parametrize(
      std::make_shared<const SurfaceMesh>(SurfaceMesh::from_polygons(polygons_of(mesh))), options);
  if (result.map && result.status != Status::Failed) set_texcoords(mesh, *result.map);
  return result;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
