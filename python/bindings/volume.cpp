// Volume meshes of the class VolumeMesh: reading, conversion from arrays, check, optimization,
// writing.
#include <pybind11/stl.h>

#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "arrays.h"
#include "majorant/apps/jobs/volume_report.h"
#include "majorant/framework/error.h"
#include "majorant/framework/parallel.h"
#include "majorant/io/volume_files.h"
#include "majorant/volumes/turned_cells.h"
#include "module.h"
#include "options.h"
#include "run.h"

namespace majorant::python {
namespace {

using SharedVolume = std::shared_ptr<VolumeMesh>;
constexpr int kListed = 10;  // upper bound on elements that a report lists

SharedVolume read_volume(const std::string& path) {
  Run run;
  return run([&] { return std::make_shared<VolumeMesh>(read_volume_mesh(path, run.stop())); });
}

// points: #P by 3. blocks: (plural_of() the shape, degree, nodes in VTK's order). Python has
// checked both.
SharedVolume make_volume(const Doubles& points,
                         const std::vector<std::tuple<std::string, int, Integers>>& blocks) {
  auto mesh = std::make_shared<VolumeMesh>();
  mesh->file = "mesh";
  mesh->points = matrix<Points3>(points);
  std::int64_t number = 0;
  for (const auto& [name, degree, nodes] : blocks) {
    CellBlock& block = mesh->blocks.emplace_back();
    for (const CellShape shape : {CellShape::Segment, CellShape::Triangle, CellShape::Quad,
                                  CellShape::Tetrahedron, CellShape::Wedge, CellShape::Hexahedron})
      if (plural_of(shape) == name) block.type = {shape, degree};
    block.nodes = matrix<Cells>(nodes);
    for (Index k = 0; k < block.size(); ++k) block.numbers.push_back(number++);
    block.regions.assign(block.numbers.size(), 0);
  }
  return mesh;
}

// Returns [(shape, degree, nodes, numbers, regions)].
py::list blocks_of(const SharedVolume& mesh) {
  py::list out;
  for (const CellBlock& block : mesh->blocks)
    out.append(py::make_tuple(
        std::string(plural_of(block.type.shape)), block.type.degree, moved(Cells(block.nodes)),
        py::array_t<std::int64_t>(static_cast<py::ssize_t>(block.numbers.size()),
                                  block.numbers.data()),
        py::array_t<int>(static_cast<py::ssize_t>(block.regions.size()), block.regions.data())));
  return out;
}

SharedVolume with_points(const SharedVolume& mesh, const Doubles& points) {
  auto out = std::make_shared<VolumeMesh>(*mesh);
  out->points = matrix<Points3>(points);
  return out;
}

// Returns the section "mesh" of the report of `majorant mesh check`, and its status.
std::pair<std::string, std::string> check_volume(const SharedVolume& mesh, double time_limit) {
  Run run(time_limit, 0, py::none());
  return run([&] {
    const VolumeCheck check = check_volume_mesh(*mesh, run.stop());
    return std::pair<std::string, std::string>(status_of(check),
                                               json_text(mesh_section(*mesh, check, kListed)));
  });
}

py::tuple optimize_volume(const SharedVolume& mesh, const py::dict& keywords,
                          const py::object& callback) {
  VolumeOptions options;
  for (const auto& [name, weight] :
       keyword<std::vector<std::pair<std::string, double>>>(keywords, "energy")) {
    const NamedEnergy* energy = find_volume_energy(name, mesh->dimension());
    if (energy == nullptr)
      throw Error(ErrorKind::Usage, "energy: no energy of volumes is called '" + name + "'");
    options.energy.push_back({energy->make, weight});
  }
  const auto boundary = keyword<std::string>(keywords, "boundary"),
             target = keyword<std::string>(keywords, "target");
  if (boundary == "slide") options.boundary = VolumeBoundary::Slide;
  if (boundary == "free") options.boundary = VolumeBoundary::Free;
  if (target == "initial") options.target = VolumeTarget::Initial;
  if (target == "size") options.target = VolumeTarget::Size;
  options.sizes = keyword<std::vector<double>>(keywords, "sizes");
  options.tolerance = keyword<double>(keywords, "tolerance");
  Run run(keyword<double>(keywords, "time_limit"), keyword<int>(keywords, "max_iterations"),
          callback);
  const int threads = keyword<int>(keywords, "threads");
  auto moved_mesh = std::make_shared<VolumeMesh>();
  std::size_t turned = 0;
  VolumeResult result = run([&] {
    const ThreadCount count(threads);
    const std::vector<CellName> cells = turned_cells(*mesh, run.stop());
    turned = cells.size();
    *moved_mesh = with_cells_turned(*mesh, cells, run.stop());
    return optimize_volume_mesh(*moved_mesh, options, run.record());
  });
  moved_mesh->points = std::move(result.points);
  RunReport report = optimized_mesh_report(*moved_mesh, result, run.record(), kListed);
  report.input["turned"] = turned;
  return py::make_tuple(moved_mesh, result.is_valid(), json_text(to_json(report)));
}

// version: "2.2", "4.1", or empty for that of the file. encoding: "binary", or empty for that of
// the file. Returns the parts of the file that are not written.
std::vector<std::string> write_volume(const SharedVolume& mesh, const std::string& path,
                                      const std::string& version, const std::string& encoding) {
  GmshChoice choice;
  if (!version.empty()) choice.version = version == "2.2" ? GmshVersion::Old : GmshVersion::New;
  if (encoding == "binary") choice.encoding = GmshEncoding::Binary;
  Run run;
  return run([&] {
    std::vector<std::string> left_out;
    write_volume_mesh(path, *mesh, choice, &left_out);
    return left_out;
  });
}

}  // namespace

void bind_volumes(py::module_& module) {
  py::class_<VolumeMesh, SharedVolume>(module, "Volume")
      .def_property_readonly(
          "points",
          [](const py::object& self) { return view(self, self.cast<const VolumeMesh&>().points); })
      .def_property_readonly("blocks", &blocks_of);
  module.def("read_volume", &read_volume, py::arg("path"));
  module.def("make_volume", &make_volume, py::arg("points"), py::arg("blocks"));
  module.def("with_points", &with_points, py::arg("mesh"), py::arg("points"));
  module.def("check_volume", &check_volume, py::arg("mesh"), py::arg("time_limit"));
  module.def("optimize_volume", &optimize_volume, py::arg("mesh"), py::arg("keywords"),
             py::arg("callback"));
  module.def("write_volume", &write_volume, py::arg("mesh"), py::arg("path"), py::arg("version"),
             py::arg("encoding"));
}

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
