#include "space.h"

#include "arrays.h"
#include "majorant/maps/rest_shapes_of.h"
#include "majorant/parametrization/initialization/start.h"
#include "mesh.h"
#include "module.h"
#include "run.h"

namespace majorant::python {
namespace {

Space triangle_space(const SharedPolygons& polygons, int degree) {
  Run run;
  return run([&] {
    Space s;
    s.mesh = std::make_shared<const SurfaceMesh>(
        SurfaceMesh::from_polygons(*polygons, run.stop(), Components::Any));
    s.space = std::make_shared<const BezierTriangleSpace>(s.mesh->faces(), s.mesh->vertex_count(),
                                                          degree);
    s.rest = rest_shapes(*s.mesh);
    s.vertices.resize(s.mesh->vertex_count(), 3);
    for (Index v = 0; v < s.mesh->vertex_count(); ++v)
      s.vertices.row(v) = s.mesh->input_position(v).transpose();
    return s;
  });
}

Space tetrahedron_space(const Doubles& vertices, const Integers& cells, int degree) {
  Space s;
  s.vertices = matrix<RowMatrix>(vertices);
  const Cells corners = matrix<Cells>(cells);
  s.space = std::make_shared<const BezierTetrahedronSpace>(
      corners, static_cast<Index>(s.vertices.rows()), degree);
  s.rest = flat_simplices(s.vertices, corners);
  return s;
}

Space quad_space(const Doubles& vertices, const Integers& cells, int degree) {
  Space s;
  s.vertices = matrix<RowMatrix>(vertices);
  s.space = std::make_shared<const BezierQuadSpace>(matrix<Cells>(cells),
                                                    static_cast<Index>(s.vertices.rows()), degree);
  s.rest = curved_shapes(*s.space, s.space->node_positions(s.vertices),
                         s.space->default_rule(RestJacobian::Varying));
  return s;
}

// Returns the map with these images of the vertices that is linear, or bilinear, on every cell.
Vec linear_map(const Space& s, const RowMatrix& images) {
  const RowMatrix nodes = s.space->node_positions(images);
  return Eigen::Map<const Vec>(nodes.data(), nodes.size());
}

RowMatrix tutte_images(const Space& s) {
  Run run;
  return run([&] {
    s.mesh->require_planar();
    const Vec x = tutte_map(*s.mesh, run.stop());
    return RowMatrix(Eigen::Map<const RowMatrix>(x.data(), x.size() / 2, 2));
  });
}

Eigen::VectorXi input_vertices(const Space& s) {
  Eigen::VectorXi numbers(s.space->vertex_count());
  for (Index v = 0; v < numbers.size(); ++v) numbers[v] = s.mesh ? s.mesh->input_vertex(v) : v;
  return numbers;
}

}  // namespace

void bind_spaces(py::module_& module) {
  py::class_<Space>(module, "Space")
      .def_property_readonly("degree", [](const Space& s) { return s.space->degree(); })
      .def_property_readonly("dimension", [](const Space& s) { return s.space->reference_dim(); })
      .def_property_readonly("node_count", [](const Space& s) { return s.space->node_count(); })
      .def_property_readonly(
          "area", [](const Space& s) { return s.mesh ? s.mesh->area() : s.rest.measure.sum(); })
      .def_property_readonly(
          "nodes", [](const Space& s) { return moved(s.space->node_positions(s.vertices)); })
      .def_property_readonly(
          "cells",
          [](const py::object& self) { return view(self, self.cast<Space&>().space->cells()); })
      .def_property_readonly("input_vertices",
                             [](const Space& s) { return moved(input_vertices(s)); })
      .def(
          "linear",
          [](const Space& s, const Doubles& images) {
            return moved(linear_map(s, matrix<RowMatrix>(images)));
          },
          py::arg("images"))
      .def("tutte", [](const Space& s) { return moved(linear_map(s, tutte_images(s))); });
  module.def("triangle_space", &triangle_space, py::arg("mesh"), py::arg("degree"));
  module.def("tetrahedron_space", &tetrahedron_space, py::arg("vertices"), py::arg("cells"),
             py::arg("degree"));
  module.def("quad_space", &quad_space, py::arg("vertices"), py::arg("cells"), py::arg("degree"));
}

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
