// Checks of maps, as `majorant check` does them.
#include <string>

#include "majorant/apps/jobs/check_map.h"
#include "map_file.h"
#include "mesh.h"
#include "module.h"
#include "run.h"

namespace majorant::python {
namespace {

// Returns the report of `majorant check` as JSON. surface: a Mesh, or None; cuts: "auto", "none",
// "free".
std::string check_map(const std::string& name, const MapFile& file, const SharedPolygons& surface,
                      const std::string& cuts, bool certify, bool seamless, bool stacked,
                      double time_limit) {
  CheckRequest request;
  request.name = name;
  request.surface = surface.get();
  if (cuts == "none") request.cuts = CheckRequest::Cuts::None;
  if (cuts == "free") request.cuts = CheckRequest::Cuts::Free;
  request.certify = certify;
  request.seamless = seamless;
  request.stacked = stacked;
  request.reported = true;
  Run run(time_limit, 0, py::none());
  return run([&] { return json_text(to_json(MapCheck(file, request, run.record()).report)); });
}

}  // namespace

void bind_check(py::module_& module) {
  module.def("check_map", &check_map, py::arg("name"), py::arg("file"), py::arg("surface"),
             py::arg("cuts"), py::arg("certify"), py::arg("seamless"), py::arg("stacked"),
             py::arg("time_limit"));
}

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
