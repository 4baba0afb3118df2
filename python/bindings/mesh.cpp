#include "mesh.h"

#include <pybind11/stl.h>

#include <span>
#include <string>

#include "arrays.h"
#include "majorant/io/read_mesh.h"
#include "module.h"
#include "run.h"

namespace majorant::python {
namespace {

// Concatenated lists of numbers, and the start of each list.
using Lists = std::pair<Integers, Integers>;

IndexLists unpacked(const Lists& lists) {
  const auto& [numbers, starts] = lists;
  IndexLists out;
  out.reserve(static_cast<std::size_t>(starts.size() - 1),
              static_cast<std::size_t>(numbers.size()));
  for (py::ssize_t k = 0; k + 1 < starts.size(); ++k)
    out.push_back(std::span(numbers.data() + starts.at(k), numbers.data() + starts.at(k + 1)));
  return out;
}

Lists packed(const IndexLists& lists) {
  std::vector<Index> starts{0};
  for (const auto list : lists) starts.push_back(starts.back() + static_cast<Index>(list.size()));
  const std::span<const Index> numbers = lists.indices();
  return {Integers(static_cast<py::ssize_t>(numbers.size()), numbers.data()),
          Integers(static_cast<py::ssize_t>(starts.size()), starts.data())};
}

// positions: #V by 3. polygons: at least three valid vertices each. texcoords: #T by 2, with their
// indices by corner, or None. Python has checked all of them.
SharedPolygons mesh_of_arrays(const Doubles& positions, const Lists& polygons,
                              const std::optional<Doubles>& texcoords,
                              const std::optional<Lists>& polygon_texcoords) {
  auto mesh = std::make_shared<PolygonMesh>();
  const auto points = matrix<Points3>(positions);
  for (Eigen::Index v = 0; v < points.rows(); ++v) mesh->positions.emplace_back(points.row(v));
  mesh->polygons = unpacked(polygons);
  if (!texcoords) return mesh;
  const auto uv = matrix<Points2>(*texcoords);
  for (Eigen::Index t = 0; t < uv.rows(); ++t) mesh->texcoords.emplace_back(uv.row(t));
  mesh->polygon_texcoords = unpacked(polygon_texcoords.value());
  return mesh;
}

template <int N>
py::array rows(const std::vector<Eigen::Matrix<double, N, 1>>& vectors) {
  Eigen::Matrix<double, Eigen::Dynamic, N, Eigen::RowMajor> out(vectors.size(), N);
  for (std::size_t k = 0; k < vectors.size(); ++k)
    out.row(static_cast<Eigen::Index>(k)) = vectors[k];
  return moved(std::move(out));
}

SharedPolygons load_mesh(const std::string& path) {
  Run run;
  return run([&] { return std::make_shared<PolygonMesh>(read_mesh(path, run.stop())); });
}

}  // namespace

void bind_meshes(py::module_& module) {
  py::class_<PolygonMesh, SharedPolygons>(module, "Mesh")
      .def_property_readonly("positions", [](const PolygonMesh& m) { return rows(m.positions); })
      .def_property_readonly("polygons", [](const PolygonMesh& m) { return packed(m.polygons); })
      .def_property_readonly("texcoords", [](const PolygonMesh& m) { return rows(m.texcoords); })
      .def_property_readonly("polygon_texcoords",
                             [](const PolygonMesh& m) { return packed(m.polygon_texcoords); })
      .def_readonly("warnings", &PolygonMesh::warnings)
      .def(py::pickle(
          [](const PolygonMesh& m) {
            return py::make_tuple(rows(m.positions), packed(m.polygons), rows(m.texcoords),
                                  packed(m.polygon_texcoords), m.file, m.directives);
          },
          [](const py::tuple& state) {
            SharedPolygons mesh = mesh_of_arrays(state[0].cast<Doubles>(), state[1].cast<Lists>(),
                                                 state[2].cast<Doubles>(), state[3].cast<Lists>());
            mesh->file = state[4].cast<std::string>();
            mesh->directives = state[5].cast<decltype(mesh->directives)>();
            return mesh;
          }));
  module.def("mesh_of_arrays", &mesh_of_arrays, py::arg("positions"), py::arg("polygons"),
             py::arg("texcoords") = py::none(), py::arg("polygon_texcoords") = py::none());
  module.def("read_mesh", &load_mesh, py::arg("path"));
}

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
