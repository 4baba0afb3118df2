// majorant check RESULT: measures a finished map and tests what it claims, from the file alone.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <memory>

#include "apps/check_claims.h"
#include "apps/check_seams.h"
#include "apps/command.h"
#include "apps/energy_option.h"
#include "apps/global_verdict.h"
#include "apps/outputs.h"
#include "apps/report.h"
#include "apps/streams.h"
#include "majorant/io/read_map.h"
#include "majorant/io/read_mesh.h"
#include "majorant/io/seamless_map.h"

namespace majorant::app {
namespace {

struct Request {
  CommonOptions common;
  std::string result, surface;
  bool certify = false, seamless = false;
};

// Surface control points must be those of flat triangles, or the file shows another surface.
void check_flat(const MapFile& file, Findings& findings) {
  const TriangleIndices& ix = TriangleIndices::of_degree(file.degree);
  double worst = 0;
  for (Index c = 0; c < file.cells.rows(); ++c)
    for (int l = 0; l < ix.count(); ++l) {
      Eigen::RowVector3d flat = Eigen::RowVector3d::Zero();
      for (int k = 0; k < 3; ++k)
        flat += ix.multi(l)[static_cast<std::size_t>(k)] / double(file.degree) *
                file.points.row(file.cells(c, k));
      worst = std::max(worst, (flat - file.points.row(file.cells(c, l))).norm());
    }
  findings.require(
      worst <= kClose * extent(file.points),
      fmt::format("surface control points are off their flat triangles by {:g}", worst));
}

// For maps whose triangulation was changed inside flat parts: the same vertices and the same area.
void check_same_vertices(const MapFile& file, const PolygonMesh& surface, Findings& findings) {
  const double size = extent(file.points);
  for (Index p = 0; p < file.points.rows(); ++p) {
    const Index v = file.input_vertex[p];
    if (v < 0) continue;
    if (static_cast<std::size_t>(v) >= surface.positions.size() ||
        (surface.positions[static_cast<std::size_t>(v)].transpose() - file.points.row(p)).norm() >
            kClose * size)
      return findings.require(false, fmt::format("vertex {} is not where the surface has it", v));
  }
  PolygonMesh mapped;
  for (Index p = 0; p < file.points.rows(); ++p) mapped.positions.push_back(file.points.row(p));
  for (Index c = 0; c < file.cells.rows(); ++c)
    mapped.polygons.push_back({file.cells(c, 0), file.cells(c, 1), file.cells(c, 2)});
  const double area = SurfaceMesh::from_polygons(mapped).area();
  const double wanted = SurfaceMesh::from_polygons(surface).area();
  findings.require(std::abs(area - wanted) <= kClose * wanted,
                   fmt::format("the mapped area {:g} is not the surface's {:g}", area, wanted));
}

void check_surface(const MapFile& file, const std::string& path, Findings& findings) {
  const PolygonMesh surface = read_mesh(path);
  if (file.input_vertex.size() == 0 || file.input_face.size() == 0)
    return findings.require(false, "the file does not say which input vertices it maps");
  const Json claims = Json::parse(file.claims, nullptr, false);
  if (claims.is_object() && claims.value("other_triangles", false))
    return check_same_vertices(file, surface, findings);
  const double size = extent(file.points);
  std::vector<std::size_t> cells_of(surface.polygons.size(), 0);
  for (Index c = 0; c < file.cells.rows(); ++c) {
    const Index face = file.input_face[c];
    if (face < 0 || static_cast<std::size_t>(face) >= surface.polygons.size())
      return findings.require(false,
                              fmt::format("cell {} names face {} the surface lacks", c, face));
    const auto& polygon = surface.polygons[static_cast<std::size_t>(face)];
    ++cells_of[static_cast<std::size_t>(face)];
    for (int k = 0; k < 3; ++k) {
      const Index point = file.cells(c, k), v = file.input_vertex[point];
      const bool same =
          std::find(polygon.begin(), polygon.end(), v) != polygon.end() &&
          (surface.positions[static_cast<std::size_t>(v)].transpose() - file.points.row(point))
                  .norm() <= kClose * size;
      if (!same)
        return findings.require(false,
                                fmt::format("cell {}: corner {} is not where the surface has "
                                            "it",
                                            c, k));
    }
  }
  for (std::size_t f = 0; f < cells_of.size(); ++f)
    if (cells_of[f] + 2 != surface.polygons[f].size())
      return findings.require(
          false, fmt::format("face {} of the surface is mapped by {} cells, not {}", f + 1,
                             cells_of[f], surface.polygons[f].size() - 2));
}

std::string claimed_energy(const Json& claims) {
  const Json energy = claims.is_object() ? claims.value("energy", Json()) : Json();
  return energy.is_string() ? energy.get<std::string>() : "symmetric-dirichlet";
}

BezierMap rebuild(const MapFile& file, const Request& request, const Json& claims,
                  Findings& findings) {
  const bool claims_seams = claims.is_object() && claims.value("seams", false);
  if (!claims_seams && !request.seamless) return to_bezier_map(file, request.result);
  BezierMap map = to_seamless_map(file, request.result);
  if (!map.seams().trivial()) return map;
  findings.require(false, "the map has no seams and no cones");
  return to_bezier_map(file, request.result);
}

MapMeasures check_map(MapFile& file, const Request& request, Findings& findings, Json& report) {
  const Json claims = read_claims(file, findings);
  const BezierMap map = rebuild(file, request, claims, findings);
  const std::string energy = claimed_energy(claims);
  const MapMeasures measures = measure(map, parse_energy(energy).sum);
  report["result"] = measures_section(map, measures, energy);
  for (Index f = 0; f < measures.min_det.size(); ++f)
    if (!(measures.min_det[f] > 0)) {
      findings.require(false, fmt::format("cell {}: det J is not proven positive", f));
      break;
    }
  findings.require(measures.locally_injective || !findings.list().empty(),
                   "the map covers the neighbourhood of a vertex more than once");
  const CheckedMap checked{file, map, measures, claims, request.surface};
  if (!map.seams().trivial()) check_seams(checked, findings);
  const GlobalVerdict verdict = judge_global_injectivity(map, measures, vertices_of(file));
  verdict.add_to(report["result"]);
  if (request.certify || (claims.is_object() && claims.value("bijective", false)))
    findings.require(verdict.finding.empty(), verdict.finding);
  check_claims(checked, findings);
  return measures;
}

int check(const Request& request) {
  require_writable(request.common, {}, {request.result, request.surface});
  request.common.apply();
  MapFile file = read_map(request.result);
  Findings findings;
  Json report{{"schema_version", 1}, {"version", MAJORANT_VERSION}, {"command", "check"}};
  check_flat(file, findings);
  if (!request.surface.empty()) check_surface(file, request.surface, findings);
  MapMeasures measures;
  try {
    measures = check_map(file, request, findings, report);
  } catch (const Error& e) {
    findings.require(false, e.what());
  } catch (const Json::exception& e) {
    findings.require(false, fmt::format("majorant_claims: {}", e.what()));
  }
  report["status"] = findings.list().empty() ? "valid" : "invalid";
  report["message"] = findings.list().empty() ? "" : findings.list().front();
  report["findings"] = findings.list();
  if (!request.common.report.empty()) write_json(request.common.report, report);
  if (findings.list().empty()) {
    if (!request.common.quiet)
      say("{}: valid, degree {}, {} cells, {} {:.9g}{}\n", request.result, file.degree,
          file.cells.rows(), report["result"]["energy"].get<std::string>(), measures.value,
          seam_summary(report["result"]));
    return kSuccess;
  }
  say("majorant: {}: invalid: {}\n", request.result, fmt::join(findings.list(), "; "));
  return kInvalid;
}

}  // namespace

void add_check(CLI::App& app, Action* run) {
  auto request = std::make_shared<Request>();
  CLI::App& verb = *app.add_subcommand("check", "measure a finished map and test its claims");
  verb.add_option("result", request->result, "result: .vtu, or .obj with vt")->required();
  verb.add_option("--surface", request->surface, "the mesh it should be a map of")
      ->type_name("FILE");
  verb.add_flag("--seamless", request->seamless,
                "the map is seamless (implied where the file claims it)");
  verb.add_flag("--certify", request->certify, "prove global injectivity as well");
  request->common.add_to(verb);
  verb.footer("Example: majorant check bunny.vtu --surface bunny.obj --report check.json");
  verb.callback([request, run] { *run = [request] { return check(*request); }; });
}

}  // namespace majorant::app
