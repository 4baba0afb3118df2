// Unwraps any mesh into charts that do not overlap.
#include <pybind11/stl.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "majorant/apps/jobs/atlas_job.h"
#include "majorant/apps/jobs/map_job.h"
#include "majorant/apps/jobs/obj_layout.h"
#include "majorant/apps/jobs/object_layouts.h"
#include "majorant/apps/jobs/petsc_fallback.h"
#include "majorant/framework/error.h"
#include "map_file.h"
#include "mesh.h"
#include "module.h"
#include "options.h"
#include "run.h"

namespace majorant::python {
namespace {

CutOptions cut_options(const py::dict& keywords) {
  CutOptions cuts;
  using Number = std::optional<double>;
  cuts.max_stretch = keyword<Number>(keywords, "max_stretch").value_or(cuts.max_stretch);
  const auto method = keyword<std::string>(keywords, "cut_method");
  if (method == "uv") cuts.method = CutMethod::Texture;
  if (method == "sharp") cuts.method = CutMethod::Sharp;
  if (method == "sharp")
    cuts.sharp_angle = keyword<Number>(keywords, "sharp_angle").value_or(cuts.sharp_angle);
  if (method != "edges") return cuts;
  cuts.method = CutMethod::Given;
  cuts.edges_source = "seams";
  cuts.edges = keyword<std::vector<std::array<Index, 2>>>(keywords, "cut_edges");
  return cuts;
}

// The edges of `seams` and the islands of `uv` refer to the vertices and faces of the arrays.
RepairOptions repair_options(const py::dict& keywords) {
  RepairOptions settings;
  const auto method = keyword<std::string>(keywords, "cut_method");
  settings.weld = keyword<std::optional<double>>(keywords, "weld_distance");
  settings.welding = method == "uv" || method == "edges" ? Welding::Soups : Welding::EqualPlaces;
  if (keyword<bool>(keywords, "welds_nothing")) settings.welding = Welding::Nothing;
  return settings;
}

// Sets tiles, densities, stacking and keep_shape.
void place_as_requested(AtlasJob& job, const py::dict& keywords) {
  if (keyword<bool>(keywords, "keep_shape")) job.options.islands = Islands::Kept;
  const auto stack = keyword<std::string>(keywords, "stack");
  if (stack != "no") job.options.stacking = stack == "equal" ? Stacking::Equal : Stacking::Mirrored;
  using Area = std::optional<double>;
  if (const auto area = keyword<Area>(keywords, "max_chart_area"))
    job.options.max_chart_area = *area;
  if (!job.options.packing) return;
  job.options.packing->quarter_turns = keyword<bool>(keywords, "quarter_turns");
  const auto upright = keyword<std::string>(keywords, "upright");
  if (upright != "no") job.options.packing->up = Vector3::Unit(upright[0] - 'x');
  if (const int tiles = keyword<int>(keywords, "udim"); tiles > 0)
    job.options.packing->tiles = tiles;
  using Densities = std::optional<std::vector<double>>;
  if (const auto density = keyword<Densities>(keywords, "texel_density"))
    job.texel_density = *density;
}

// Returns the mesh for files of the layout.
std::shared_ptr<PolygonMesh> written_polygons(const AtlasJob& job, const MapFile& file,
                                              const py::dict& keywords) {
  const bool has_tiles = keyword<int>(keywords, "udim") > 0;
  const bool has_groups = keyword<bool>(keywords, "groups");
  if (!has_tiles && !has_groups) return job.polygons;
  PolygonMesh mesh = *job.polygons;
  const std::vector<int> chart = chart_of_polygons(file, mesh);
  if (has_tiles) {
    std::vector<int> tile = chart;
    for (int& number : tile)
      if (number >= 0) number = job.atlas.packing->tiles[to_size(number)];
    mesh = with_tile_materials(std::move(mesh), tile);
  }
  if (has_groups) mesh = with_chart_groups(std::move(mesh), chart);
  return std::make_shared<PolygonMesh>(std::move(mesh));
}

// Opens the job with the options of the keywords.
void open_job(AtlasJob& job, Run& run, PolygonMesh polygons, const py::dict& keywords) {
  const RepairOptions settings = repair_options(keywords);
  if (keyword<bool>(keywords, "keep_seams")) job.old_seams = OldSeams::Cut;
  if (keyword<bool>(keywords, "one_chart")) job.options.limit = StretchLimit::Reported;
  job.options.least_charts = keyword<Index>(keywords, "least_charts");
  job.options.least_fill = keyword<std::optional<double>>(keywords, "least_fill");
  if (const auto to_eye = keyword<std::optional<std::array<double, 3>>>(keywords, "hide_from"))
    job.hide_from = Vector3((*to_eye)[0], (*to_eye)[1], (*to_eye)[2]);
  job.options.cutting_seconds = kCuttingShare * keyword<double>(keywords, "time_limit");
  const bool is_strict = keyword<bool>(keywords, "strict");
  run([&] {
    job.open(std::move(polygons), settings);
    return true;
  });
  if (const Repair* const first = job.first_repair(); first && is_strict)
    throw Error(ErrorKind::Unsupported, describe(*first) + "; strict=False repairs it so");
  job.read_seconds = job.record.seconds();
  job.energy = keyword<std::string>(keywords, "energy_text");
  job.options_json = Json::parse(keyword<std::string>(keywords, "as_json"));
  job.linear_solver = linear_solver_section("direct", OwnSolver::Used, {});
  job.options.cuts = cut_options(keywords);
  job.options.packing.reset();
  if (keyword<bool>(keywords, "pack"))
    job.options.packing = PackOptions{.padding_pixels = keyword<double>(keywords, "padding"),
                                      .resolution = keyword<double>(keywords, "resolution")};
  place_as_requested(job, keywords);
  job.options.chart = read_options(keywords, *job.surface.mesh, job.surface.welded);
}

// Solves and places the charts, with a layout of this size, and proves it.
void solve_job(AtlasJob& job, Run& run, LayoutSize size) {
  const bool is_placed = run([&] {
    job.solve();
    return size == LayoutSize::Model || job.place();
  });
  if (!is_placed)
    throw Error(ErrorKind::Invalid,
                "in the unit square its smallest triangles are too small for doubles; take "
                "scale='model'");
  if (job.atlas.status() == Status::Failed)
    throw Error(ErrorKind::Invalid, "no valid map: failed, " + job.atlas.message());
  run([&] {
    job.prove();
    return true;
  });
}

// Returns the mesh with a directive `o` wherever the object changes. objects: a number per polygon.
PolygonMesh with_objects(PolygonMesh mesh, const std::vector<Index>& objects) {
  for (std::size_t p = 0; p < objects.size(); ++p)
    if (p == 0 || objects[p] != objects[p - 1])
      mesh.directives.emplace_back(static_cast<Index>(p), "o " + std::to_string(objects[p]));
  return mesh;
}

py::tuple unwrap_objects(const PolygonMesh& given, const py::dict& keywords, Run& run) {
  const auto polygons = std::make_shared<PolygonMesh>(
      with_objects(given, keyword<std::vector<Index>>(keywords, "objects")));
  UnwrappedObjects objects =
      unwrap_objects(*polygons, run.record(), [&](PolygonMesh object, AtlasJob& job) {
        open_job(job, run, std::move(object), keywords);
        solve_job(job, run, LayoutSize::UnitSquare);
      });
  const std::string report = json_text(to_json(objects_report(objects, *polygons)));
  return py::make_tuple(std::make_shared<MapFile>(map_of_objects(std::move(objects.layouts))),
                        polygons, packed_request_of_objects(), true, status_name(objects.status),
                        objects.message, report);
}

py::tuple unwrap_mesh(const SharedPolygons& given, const py::dict& keywords,
                      const py::object& callback) {
  Run run(keyword<double>(keywords, "time_limit"), keyword<int>(keywords, "max_iterations"),
          callback);
  if (!keywords["objects"].is_none()) return unwrap_objects(*given, keywords, run);
  AtlasJob job(run.record());
  open_job(job, run, *given, keywords);
  const bool is_unit = keyword<std::string>(keywords, "scale") == "unit";
  solve_job(job, run, is_unit ? LayoutSize::UnitSquare : LayoutSize::Model);
  const auto file = run([&] { return std::make_shared<MapFile>(atlas_file(job)); });
  return py::make_tuple(file, written_polygons(job, *file, keywords),
                        packed_request(proof_request(job, "map.vtu")), true,
                        status_name(job.atlas.status()), job.atlas.message(),
                        json_text(to_json(atlas_report(job))));
}

}  // namespace

void bind_unwrap(py::module_& module) {
  module.def("unwrap", &unwrap_mesh, py::arg("mesh"), py::arg("keywords"), py::arg("callback"));
}

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
