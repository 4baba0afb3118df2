// majorant parametrize IN -o OUT...: the main job.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <memory>

#include "apps/energy_option.h"
#include "apps/map_run.h"
#include "apps/seam_request.h"
#include "apps/unless_stopped.h"
#include "majorant/framework/error.h"
#include "majorant/parametrization/drive/parametrize.h"

namespace majorant::app {
namespace {

struct ParametrizeRequest : MapVerb {
  SeamRequest seams;
};

// Tutte's map of the surface cut open to one piece.
Start cut_start(const ParametrizeRequest& request, const PolygonMesh& polygons,
                const SurfaceMesh& mesh, const StopCheck& stop, std::optional<SurfaceCuts>& cuts) {
  CutOptions asked = request.seams.options(polygons);
  const MapOptions map = read_options(request.map, polygons, mesh).map;
  for (const auto* points : {&map.pins, &map.handles})
    for (const Pin& p : *points) asked.whole.push_back(p.vertex);
  cuts = choose_cuts(mesh, asked, stop);
  const auto open = std::make_shared<const SurfaceMesh>(mesh.cut_along(cuts->is_cut, nullptr));
  if (const Index pieces = open->topology().components; pieces > 1)
    throw Error(
        ErrorKind::Unsupported,
        fmt::format("{}: --seams {} leaves {} pieces, parametrize maps one; `majorant "
                    "unwrap {} --seams {} -o OUT` maps them all",
                    mesh.file(), request.seams.seams, pieces, mesh.file(), request.seams.seams));
  MapOptions plain;
  plain.start = StartMethod::Tutte;
  return Start{BezierMap::linear(open, initial_map(*open, plain, stop))};
}

int run_job(ParametrizeRequest request) {
  if (request.map.seamless && request.map.init != "auto" && request.map.init != "input")
    throw Error(ErrorKind::Usage,
                fmt::format("--seamless starts from the texture coordinates; leave out --init {}",
                            request.map.init));
  request.map.strictness = request.seams.needed_of_file();
  MapRun run("parametrize", request, {request.seams.file()});
  std::optional<SurfaceCuts> cuts;
  const auto cut_open = [&](const PolygonMesh& polygons, const SurfaceMesh& mesh) {
    return cut_start(request, polygons, mesh, run.record().start_stop(), cuts);
  };
  MapInput& in = request.seams.seams.empty() ? run.read() : run.read(cut_open);
  in.cuts = std::move(cuts);
  const auto solve = [&] {
    if (!in.start) return parametrize(in.mesh, in.options, run.record());
    ParametrizationResult result = parametrize(in.start->map, in.options, run.record());
    if (in.cuts) result.start = StartMethod::Tutte;
    return result;
  };
  return run.finish(unless_stopped("making the start of " + request.map.input, solve),
                    in.cuts ? request.seams.to_json() : Json::object());
}

}  // namespace

void add_parametrize(CLI::App& app, Action* run) {
  auto request = std::make_shared<ParametrizeRequest>();
  CLI::App& verb = *app.add_subcommand(
      "parametrize", "map a surface mesh onto the plane, injectively and with low distortion");
  request->add_to(verb);
  request->map.add_start_to(verb);
  verb.add_flag("--seamless", request->map.seamless,
                "hold the seams of the input's texture coordinates, up to rotations by 90 degrees");
  request->seams.add_to(verb);
  verb.get_option("--seams")->excludes("--seamless")->excludes("--init");
  verb.get_option("--max-stretch")->needs("--seams");
  verb.footer(energy_help() +
              "Example: majorant parametrize bunny.obj -o bunny.vtu -o bunny.svg --degree 3 "
              "--report bunny.json");
  verb.callback([request, run] { *run = [request] { return run_job(*request); }; });
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
