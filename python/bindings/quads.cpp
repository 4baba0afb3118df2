#include <pybind11/stl.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arrays.h"
#include "majorant/apps/jobs/quad_job.h"
#include "majorant/framework/error.h"
#include "majorant/framework/minimizer.h"
#include "majorant/framework/parallel.h"
#include "mesh.h"
#include "module.h"
#include "options.h"
#include "run.h"

namespace majorant::python {
namespace {

// The quad mesh, with the conditions that are proven when the mesh is written.
struct Quads {
  PolygonMesh mesh;
  std::shared_ptr<const SurfaceMesh> surface;
  std::vector<char> features;
  std::vector<Index> patch_of;
  std::string report;
};
using SharedQuads = std::shared_ptr<Quads>;

std::vector<Cone> cones_of(const std::vector<std::pair<Index, int>>& turns_of_vertices) {
  std::vector<Cone> cones;
  for (const auto& [vertex, turns] : turns_of_vertices) cones.push_back({vertex, turns});
  return cones;
}

SharedQuads make_quads(const SharedPolygons& given, const py::dict& keywords,
                       const py::object& callback) {
  using Edges = std::vector<std::array<Index, 2>>;
  Run run(keyword<double>(keywords, "time_limit"), StoppingRules().max_iterations, callback);
  const int threads = keyword<int>(keywords, "threads");
  const bool is_strict = keyword<bool>(keywords, "strict");
  const auto words = keyword<std::string>(keywords, "feature_words");
  const auto edges = keyword<std::optional<Edges>>(keywords, "feature_edges");
  QuadJob job(run.record());
  job.options_json = Json::parse(keyword<std::string>(keywords, "as_json"));
  job.options.count = keyword<std::optional<long>>(keywords, "count");
  job.options.edge_length = keyword<std::optional<double>>(keywords, "edge_length");
  if (const auto cones =
          keyword<std::optional<std::vector<std::pair<Index, int>>>>(keywords, "cones"))
    job.options.map.cones = cones_of(*cones);
  return run([&] {
    const ThreadCount count(threads);
    job.open(*given);
    if (is_strict && !job.surface.repairs.empty())
      throw Error(ErrorKind::Unsupported,
                  describe(job.surface.repairs.front()) + "; strict=False repairs it so");
    if (!words.empty()) job.options.features = features_of(words, job.polygons, job.surface);
    if (edges) job.options.features = features_of(*edges, "features", job.surface);
    job.read_seconds = job.record.seconds();
    job.solve("cones");
    auto made = std::make_shared<Quads>();
    made->report = json_text(to_json(quad_report(job)));
    made->mesh = std::move(job.quads);
    made->surface = job.surface.mesh;
    made->features = std::move(job.features);
    made->patch_of = std::move(job.patch_of);
    return made;
  });
}

py::array vertices_of(const Quads& quads) {
  RowMatrix vertices(static_cast<Index>(quads.mesh.positions.size()), 3);
  for (Index v = 0; v < static_cast<Index>(vertices.rows()); ++v)
    vertices.row(v) = quads.mesh.positions[v];
  return moved(std::move(vertices));
}

py::array faces_of(const Quads& quads) {
  Cells faces(static_cast<Index>(quads.mesh.polygons.size()), 4);
  for (Index q = 0; q < static_cast<Index>(faces.rows()); ++q)
    for (Index k = 0; k < 4; ++k) faces(q, k) = quads.mesh.polygons[q][k];
  return moved(std::move(faces));
}

void save_quads(const SharedQuads& quads, const std::string& path) {
  Run run;
  run([&] {
    write_quads(path, quads->mesh, *quads->surface, quads->features, quads->patch_of);
    return true;
  });
}

}  // namespace

void bind_quads(py::module_& module) {
  py::class_<Quads, SharedQuads>(module, "Quads")
      .def_property_readonly("vertices", &vertices_of)
      .def_property_readonly("faces", &faces_of)
      .def_property_readonly("report", [](const Quads& quads) { return quads.report; });
  module.def("quad_mesh", &make_quads, py::arg("mesh"), py::arg("keywords"), py::arg("callback"));
  module.def("save_quads", &save_quads, py::arg("quads"), py::arg("path"));
}

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
