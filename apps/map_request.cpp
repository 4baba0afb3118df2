#include "apps/map_request.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "apps/arguments/number_check.h"
#include "apps/arguments/option_table.h"
#include "apps/arguments/suggestion.h"
#include "apps/energy_option.h"
#include "apps/or_interrupted.h"
#include "apps/outputs.h"
#include "apps/streams.h"
#include "apps/within_memory.h"
#include "majorant/apps/jobs/input_points.h"
#include "majorant/framework/energy_term.h"
#include "majorant/framework/error.h"
#include "majorant/io/read_mesh.h"
#include "majorant/io/read_vertex_lists.h"
#include "majorant/parametrization/initialization/start.h"
#include "majorant/parametrization/solve/free_scale.h"

namespace majorant::app {
namespace {

CurvatureChoice find_curvature(const std::string& name) {
  if (const auto choice = curvature_choice(name)) return *choice;
  throw Error(ErrorKind::Usage, "no curvature model is called '" + name + "'");
}

std::vector<Pin> read_points(const std::string& path, const PolygonMesh& polygons,
                             const SurfaceMesh& mesh, const StopCheck& stop,
                             const std::vector<Index>& names) {
  const auto handles = or_interrupted("reading " + path, [&] {
    return read_handles(path, static_cast<Index>(polygons.positions.size()), stop);
  });
  return pins_at(mesh, handles, path, names);
}

Vec read_weights(const std::string& path, const PolygonMesh& polygons, const SurfaceMesh& mesh,
                 const StopCheck& stop) {
  const Vec of_polygon = or_interrupted("reading " + path, [&] {
    return read_face_weights(path, static_cast<Index>(polygons.polygons.size()), stop);
  });
  Vec weights(mesh.face_count());
  for (Index f = 0; f < weights.size(); ++f) weights[f] = of_polygon[mesh.input_face(f)];
  return weights;
}

// Refuses what parametrize() would refuse, before a start is made and in terms of options.
void require_scale(const MapRequest& request, const MapJob& job) {
  if (job.start ? !collapses(job.options.map, job.start->map.space(), job.start->map.seams())
                : !collapses(job.options.map, {job.mesh->faces(), job.mesh->vertex_count(), 1}, {}))
    return;
  throw Error(ErrorKind::Usage,
              fmt::format("--energy '{}' is smallest for a map shrunk to a point; hold its scale "
                          "with --boundary fixed, two pins, or another energy in the sum",
                          request.energy));
}

}  // namespace

void MapRequest::add_to(CLI::App& verb, const char* default_degree) {
  add_options(verb, OptionGroup::Map,
              {{"input", &input, surface_help(), {.required = true}},
               {"--degree",
                &degree,
                fmt::format("polynomial degree ({})", default_degree),
                {.check = whole_number(1, BezierTriangleSpace::kMaxDegree)}},
               {"--energy",
                &energy,
                "distortion energy: a name listed below, or a weighted sum (symmetric-dirichlet)",
                {.type = "SUM"}}});
  add_options(verb, OptionGroup::Constraints,
              {{"--pins", &pins, "JSON file of hard point constraints", {.type = "FILE"}},
               {"--handles", &handles, "JSON file of soft point constraints", {.type = "FILE"}},
               {"--soft",
                &soft,
                fmt::format("weight of --handles ({})", soft),
                {.check = positive_number(kLargestFactor), .needs = {"--handles"}}},
               {"--weights",
                &weights,
                "text file with a positive energy factor for each face",
                {.type = "FILE"}},
               {"--boundary-angles", &boundary_angles,
                "hold the angle sum of each boundary vertex at or below 360 degrees"}});
  add_options(verb, OptionGroup::Solver,
              {{"--quadrature",
                &quadrature,
                "quadrature points per triangle, on a lattice (default: the built-in rule)",
                {.check = whole_number(1, 10000)}}});
}

void MapRequest::add_start_to(CLI::App& verb) {
  add_options(verb, OptionGroup::Map,
              {{"--boundary",
                &boundary,
                "free boundary, or fixed where the initial map has it (free)",
                {.check = one_of({"free", "fixed"})}},
               {"--init",
                &init,
                "method of the initial map; input: the texture coordinates of the file (auto; "
                "compare: tutte)",
                {.check = one_of({"auto", "tutte", "multiresolution", "input"})}}});
}

void MapRequest::choose_degree(const std::vector<std::string>& outputs) {
  if (degree != 0) return;
  const auto data = std::count_if(outputs.begin(), outputs.end(), is_map_data);
  const auto straight = std::count_if(outputs.begin(), outputs.end(), is_straight_map_data);
  degree = straight > 0 && straight == data ? 1 : 3;
}

Json MapRequest::to_json() const {
  return {{"degree", degree},   {"energy", energy},         {"boundary", boundary},
          {"init", init},       {"curvature", curvature},   {"boundary_angles", boundary_angles},
          {"pins", pins},       {"handles", handles},       {"soft", soft},
          {"weights", weights}, {"quadrature", quadrature}, {"seamless", seamless}};
}

std::vector<std::string> MapRequest::inputs() const { return {input, pins, handles, weights}; }

ParametrizationOptions read_options(const MapRequest& request, const PolygonMesh& polygons,
                                    const SurfaceMesh& mesh, const StopCheck& stop,
                                    const std::vector<Index>& names) {
  ParametrizationOptions options;
  options.map.energy = parse_energy(request.energy);
  options.map.degree = request.degree;
  options.solve.curvature = find_curvature(request.curvature);
  if (request.boundary == "fixed") options.map.boundary = BoundaryCondition::Fixed;
  if (request.boundary_angles) options.map.boundary_angles = BoundaryAngles::AtMostFullTurn;
  options.solve.quadrature_points = request.quadrature;
  options.map.handle_weight = request.soft;
  if (!request.pins.empty())
    options.map.pins = read_points(request.pins, polygons, mesh, stop, names);
  if (!request.handles.empty())
    options.map.handles = read_points(request.handles, polygons, mesh, stop, names);
  if (!request.weights.empty())
    options.map.face_weight = read_weights(request.weights, polygons, mesh, stop);
  return options;
}

void read_input(const MapRequest& request, MapJob& job, const StartMaker& make_start) {
  job.energy = request.energy;
  job.init = request.init;
  parse_energy(request.energy);  // fails before any work
  const bool starts_from_texture = request.init == "input" || (request.seamless && !make_start);
  const Strictness strictness =
      std::max(request.strictness, starts_from_texture ? Strictness::Texcoords : Strictness::Shape);
  or_interrupted("reading " + request.input, [&] {
    PolygonMesh polygons = within_memory(request.input, [&] {
      return read_mesh(request.input, job.record.start_stop(), strictness);
    });
    job.open(std::make_shared<const PolygonMesh>(std::move(polygons)));
    say_warnings(job.polygons->warnings);
  });
  if (make_start)
    or_interrupted("making the start of " + request.input, [&] { make_start(job); });
  else if (request.seamless)
    job.start_from_texture();
  job.options = read_options(request, *job.polygons, job.mapped_mesh(), job.record.start_stop());
  for (const StartMethod method : {StartMethod::Tutte, StartMethod::Multiresolution})
    if (request.init == start_name(method)) job.options.map.start = method;
  if (request.init == "input" && !request.seamless)
    job.options.map.initial = texture_map(*job.mesh);
  require_scale(request, job);
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
