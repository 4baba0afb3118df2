#include "unwrap.h"

#include <pybind11/stl.h>

#include <array>
#include <optional>
#include <string>

#include "majorant/framework/error.h"
#include "majorant/results/internal/finished_atlas.h"
#include "majorant/results/internal/solver_ladder.h"
#include "map_file.h"
#include "options.h"
#include "run.h"

namespace majorant::python {
namespace {

RepairedSurface repaired(const PolygonMesh& polygons, const std::optional<double>& weld,
                         bool is_strict, const StopCheck& stop) {
  RepairOptions options;
  options.weld = weld;
  RepairedSurface surface = repair(polygons, options, stop);
  for (const Repair& r : surface.repairs)
    if (is_strict && r.kind != RepairKind::MovedToOrigin)
      throw Error(ErrorKind::Unsupported, describe(r) + "; strict=False repairs it so");
  return surface;
}

CutOptions cut_options(const py::dict& wishes) {
  CutOptions cuts;
  using Number = std::optional<double>;
  cuts.max_stretch = wish<Number>(wishes, "max_stretch").value_or(cuts.max_stretch);
  const auto method = wish<std::string>(wishes, "cut_method");
  if (method == "uv") cuts.method = CutMethod::Texture;
  if (method == "sharp") cuts.method = CutMethod::Sharp;
  if (method == "sharp")
    cuts.sharp_angle = wish<Number>(wishes, "sharp_angle").value_or(cuts.sharp_angle);
  if (method != "edges") return cuts;
  cuts.method = CutMethod::Given;
  cuts.edges_source = "seams";
  cuts.edges = wish<std::vector<std::array<Index, 2>>>(wishes, "cut_edges");
  return cuts;
}

std::string message_of(const Atlas& atlas) {
  for (const Chart& chart : atlas.charts)
    if (chart.status == atlas.status() && chart.status != Status::Converged) return chart.message;
  return {};
}

}  // namespace

py::tuple unwrap_mesh(const SharedPolygons& given, const py::dict& wishes,
                      const py::object& callback) {
  Run run(wish<double>(wishes, "time_limit"), wish<int>(wishes, "max_iterations"), callback);
  RunRecord& record = run.record();
  const auto weld = wish<std::optional<double>>(wishes, "weld");
  const bool is_strict = wish<bool>(wishes, "strict"), normalizes = wish<bool>(wishes, "normalize");
  const RepairedSurface surface =
      run([&] { return repaired(*given, weld, is_strict, record.start_stop()); });
  auto polygons = std::make_shared<PolygonMesh>(with_welded_vertices(*given, surface));
  const double read_seconds = record.seconds();
  UnwrapOptions options;
  options.cuts = cut_options(wishes);
  options.cuts.given = surface.given_cuts;
  options.packing.reset();
  if (wish<bool>(wishes, "pack"))
    options.packing = PackOptions{.padding_pixels = wish<double>(wishes, "padding"),
                                  .resolution = wish<double>(wishes, "resolution")};
  options.chart = read_options(wishes, *surface.mesh);

  std::optional<LayoutMotion> square;
  const Atlas atlas = run([&] {
    Atlas out = unwrap(surface.mesh, options, record);
    if (normalizes) square = into_unit_square(out);
    return out;
  });
  if (normalizes && !square)
    throw Error(ErrorKind::Invalid,
                "in the unit square its smallest triangles are too small for doubles; take "
                "normalize=False");
  if (atlas.status() == Status::Failed)
    throw Error(ErrorKind::Invalid, "no valid map: failed, " + message_of(atlas));
  FinishedAtlas finished{*polygons, surface, atlas, record};
  if (square) finished.square = &*square;
  finished.degree = options.chart.map.degree;
  finished.energy = wish<std::string>(wishes, "energy_text");
  finished.options = Json::parse(wish<std::string>(wishes, "as_json"));
  finished.read_seconds = read_seconds;
  finished.linear_solver = linear_solver_section("direct", OwnSolver::Used, {});
  finished.boundary = run([&] { return prove_boundary(atlas); });
  const auto file = std::make_shared<MapFile>(atlas_file(finished));
  return py::make_tuple(file, polygons, promise_from(promise(finished, "map.vtu")), true,
                        status_name(atlas.status()), message_of(atlas),
                        json_text(atlas_report(finished)));
}

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
