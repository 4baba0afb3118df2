// CGAL in, CGAL out: texture coordinates as the property map "h:uv" of a CGAL::Surface_mesh.
//
// Sample run:
//   example_cgal examples/meshes/cap.obj
#include "majorant/parametrization/adapters/cgal.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>

#include <iostream>

#include "majorant/framework/error.h"

using Mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;

int main(int argc, char** argv) try {
  Mesh mesh;
  if (argc < 2 || !CGAL::IO::read_polygon_mesh(argv[1], mesh)) {
    std::cerr << "usage: example_cgal MESH\n";
    return 2;
  }
  majorant::ParametrizationOptions options;
  options.map.degree = 2;
  const majorant::ParametrizationResult result = majorant::parametrize(mesh, options);
  std::cout << majorant::status_name(result.status) << ", energy " << result.measures.value << "\n";
  if (!result.map) return 1;
  const auto uv = majorant::texcoords_of(mesh);
  for (const auto h : mesh.halfedges_around_face(mesh.halfedge(*mesh.faces_begin())))
    std::cout << "vertex " << mesh.target(h) << ": uv " << uv[h] << "\n";
  return result.measures.locally_injective ? 0 : 1;
} catch (const majorant::Error& error) {
  std::cerr << error.what() << "\n";
  return 1;
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
