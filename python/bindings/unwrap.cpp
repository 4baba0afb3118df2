#include "unwrap.h"

#include <pybind11/stl.h>

#include <array>
#include <optional>
#include <string>

#include "majorant/framework/error.h"
#include "majorant/results/atlas_job.h"
#include "majorant/results/solver_ladder.h"
#include "map_file.h"
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

// Edges of `seams` are those of the arrays, islands of `uv`, too.
RepairOptions repair_options(const py::dict& keywords) {
  RepairOptions how;
  const auto method = keyword<std::string>(keywords, "cut_method");
  how.weld = keyword<std::optional<double>>(keywords, "weld_distance");
  how.welding = method == "uv" || method == "edges" ? Welding::Soups : Welding::EqualPlaces;
  if (keyword<bool>(keywords, "welds_nothing")) how.welding = Welding::Nothing;
  return how;
}

std::string message_of(const Atlas& atlas) {
  for (const Chart& chart : atlas.charts)
    if (chart.status == atlas.status() && chart.status != Status::Converged) return chart.message;
  return {};
}

}  // namespace

py::tuple unwrap_mesh(const SharedPolygons& given, const py::dict& keywords,
                      const py::object& callback) {
  Run run(keyword<double>(keywords, "time_limit"), keyword<int>(keywords, "max_iterations"),
          callback);
  AtlasJob job(run.record());
  const RepairOptions how = repair_options(keywords);
  if (keyword<bool>(keywords, "keep_seams")) job.old_seams = OldSeams::Cut;
  if (keyword<bool>(keywords, "one_chart")) job.options.limit = StretchLimit::Reported;
  job.options.least_charts = keyword<Index>(keywords, "least_charts");
  job.options.least_fill = keyword<double>(keywords, "least_fill");
  if (const auto to_eye = keyword<std::optional<std::array<double, 3>>>(keywords, "hide_from"))
    job.hide_from = Vector3((*to_eye)[0], (*to_eye)[1], (*to_eye)[2]);
  job.options.cutting_seconds = kCuttingShare * keyword<double>(keywords, "time_limit");
  const bool is_strict = keyword<bool>(keywords, "strict"),
             into_square = keyword<std::string>(keywords, "scale") == "unit";
  run([&] {
    job.open(*given, how);
    return true;
  });
  if (const Repair* const first = job.first_repair(); first && is_strict)
    throw Error(ErrorKind::Unsupported, describe(*first) + "; strict=False repairs it so");
  job.read_seconds = job.record.seconds();
  job.energy = keyword<std::string>(keywords, "energy_text");
  job.asked = Json::parse(keyword<std::string>(keywords, "as_json"));
  job.linear_solver = linear_solver_section("direct", OwnSolver::Used, {});
  job.options.cuts = cut_options(keywords);
  job.options.packing.reset();
  if (keyword<bool>(keywords, "pack"))
    job.options.packing = PackOptions{.padding_pixels = keyword<double>(keywords, "padding"),
                                      .resolution = keyword<double>(keywords, "resolution")};
  job.options.chart = read_options(keywords, *job.surface.mesh, job.surface.welded);

  const bool is_placed = run([&] {
    job.solve();
    return !into_square || job.place();
  });
  if (!is_placed)
    throw Error(ErrorKind::Invalid,
                "in the unit square its smallest triangles are too small for doubles; take "
                "scale='model'");
  if (job.atlas.status() == Status::Failed)
    throw Error(ErrorKind::Invalid, "no valid map: failed, " + message_of(job.atlas));
  const auto file = run([&] {
    job.prove();
    return std::make_shared<MapFile>(atlas_file(job));
  });
  return py::make_tuple(file, job.polygons, promise_from(promise(job, "map.vtu")), true,
                        status_name(job.atlas.status()), message_of(job.atlas),
                        json_text(atlas_report(job)));
}

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
