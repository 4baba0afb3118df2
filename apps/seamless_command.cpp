// majorant seamless IN -o OUT...: from a plain mesh to a seamless map with cones.
#include <CLI/App.hpp>
#include <memory>

#include "apps/arguments/number_check.h"
#include "apps/arguments/suggestion.h"
#include "apps/energy_option.h"
#include "apps/map_run.h"
#include "majorant/io/read_vertex_lists.h"
#include "majorant/parametrization/drive/parametrize.h"
#include "majorant/parametrization/starts/make_seamless.h"
#include "majorant/results/internal/input_points.h"

namespace majorant::app {
namespace {

struct SeamlessRequest : MapVerb {
  std::string cones, start = "automatic";
  double curvature_alignment = 0;
};

SeamlessMethod find_method(const std::string& wanted) {
  for (const SeamlessMethod m :
       {SeamlessMethod::Field, SeamlessMethod::ScaledField, SeamlessMethod::Conformal})
    if (method_name(m) == wanted) return m;
  return SeamlessMethod::Automatic;
}

// Cones of the file, by vertex of the mesh.
std::vector<Cone> read_cones_of(const std::string& path, const PolygonMesh& polygons,
                                const SurfaceMesh& mesh) {
  std::vector<Cone> cones = read_cones(path, static_cast<Index>(polygons.positions.size()));
  for (Cone& cone : cones) cone.vertex = used_vertex(path, mesh, cone.vertex);
  return cones;
}

int run_job(SeamlessRequest request) {
  MapRun run("seamless", request, {request.cones});
  const auto make_start = [&](const PolygonMesh& polygons, const SurfaceMesh& mesh) {
    SeamlessOptions options;
    options.method = find_method(request.start);
    options.field.curvature_weight = request.curvature_alignment;
    if (!request.cones.empty()) options.cones = read_cones_of(request.cones, polygons, mesh);
    const Start start = make_seamless(mesh, options, run.record());
    request.map.init = method_name(start.method);
    return start;
  };
  const MapInput& in = run.read(make_start);
  return run.finish(parametrize(in.start->map, in.options, run.record()),
                    {{"cones", request.cones},
                     {"start", request.start},
                     {"curvature_alignment", request.curvature_alignment}});
}

}  // namespace

void add_seamless(CLI::App& app, Action* run) {
  auto request = std::make_shared<SeamlessRequest>();
  CLI::App& verb = *app.add_subcommand(
      "seamless",
      "make a seamless map with cones of a plain mesh, closed or bounded, of any genus");
  SeamlessRequest& r = *request;
  r.map.seamless = true;
  r.add_to(verb);
  verb.add_option("--cones", r.cones, "the cones, JSON (default: those of a smooth cross field)")
      ->type_name("FILE");
  verb.add_option("--start", r.start, "what the map is made from (automatic)")
      ->check(one_of({"automatic", "field", "scaled-field", "conformal"}));
  verb.add_option("--curvature-alignment", r.curvature_alignment,
                  "pull of principal directions on the cross field, 5 to 50 are useful (0)")
      ->check(non_negative_number(kLargestFactor))
      ->excludes("--cones");
  verb.footer(energy_help() +
              "Example: majorant seamless bunny.obj -o bunny.vtu -o bunny.svg --degree 3");
  verb.callback([request, run] { *run = [request] { return run_job(*request); }; });
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
