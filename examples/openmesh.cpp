// OpenMesh in, OpenMesh out: texture coordinates on the half-edges of a mesh of a program's own,
// which is read, simplified or edited with OpenMesh before. Here a vertex is taken out, and the
// mesh mapped before its garbage is collected.
//
// Sample run:
//   example_openmesh examples/meshes/cap.obj
#include "majorant/parametrization/adapters/openmesh.h"

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <iostream>

#include "majorant/framework/error.h"

struct Traits : OpenMesh::DefaultTraitsDouble {
  typedef OpenMesh::Vec2d TexCoord2D;  // floats by default
};
using Mesh = OpenMesh::PolyMesh_ArrayKernelT<Traits>;

int main(int argc, char** argv) try {
  Mesh mesh;
  if (argc < 2 || !OpenMesh::IO::read_mesh(mesh, argv[1])) {
    std::cerr << "usage: example_openmesh MESH\n";
    return 2;
  }
  mesh.request_vertex_status();
  mesh.request_edge_status();
  mesh.request_face_status();
  for (const auto v : mesh.vertices())
    if (mesh.is_boundary(v)) {
      mesh.delete_vertex(v);
      break;
    }

  const majorant::ParametrizationResult result = majorant::parametrize(mesh);
  std::cout << majorant::status_name(result.status) << ", energy " << result.measures.value << "\n";
  if (!result.map) return 1;
  for (const auto h : mesh.fh_range(*mesh.faces_begin()))
    std::cout << "vertex " << h.to().idx() << ": uv " << mesh.texcoord2D(h) << "\n";
  return result.measures.locally_injective ? 0 : 1;
} catch (const majorant::Error& error) {
  std::cerr << error.what() << "\n";
  return 1;
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
