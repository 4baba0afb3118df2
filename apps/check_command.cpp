// majorant check RESULT: measures a finished map and tests what it claims, from the file alone.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <unordered_set>

#include "apps/command.h"
#include "apps/energy_option.h"
#include "apps/outputs.h"
#include "apps/report.h"
#include "majorant/io/read_map.h"
#include "majorant/io/read_mesh.h"
#include "majorant/parametrization/initial_map.h"

namespace majorant::app {
namespace {

constexpr double kClose = 1e-9;        // relative to the size of the map or surface
constexpr double kEnergyClose = 1e-4;  // what reported energies are good to
constexpr double kZeroEnergy = 1e-9;   // energies may vanish at isometries

struct Request {
  CommonOptions common;
  std::string result, surface;
  bool certify = false;
};

// Findings in words; empty means the check passed.
class Findings {
 public:
  void require(bool holds, std::string what) {
    if (!holds) list_.push_back(std::move(what));
  }
  const std::vector<std::string>& list() const { return list_; }

 private:
  std::vector<std::string> list_;
};

double extent(const Eigen::Ref<const Eigen::MatrixXd>& points) {
  return (points.colwise().maxCoeff() - points.colwise().minCoeff()).maxCoeff();
}

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

void check_surface(const MapFile& file, const std::string& path, Findings& findings) {
  const PolygonMesh surface = read_mesh(path);
  if (file.input_vertex.size() == 0 || file.input_face.size() == 0)
    return findings.require(false, "the file does not say which input vertices it maps");
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

// A map that claims no seams has one point for every vertex of the input.
void check_cuts(const MapFile& file, Findings& findings) {
  std::unordered_set<Index> seen;
  for (const Index v : file.input_vertex)
    if (v >= 0 && !seen.insert(v).second)
      return findings.require(false,
                              fmt::format("the map is not continuous: vertex {} of the input "
                                          "has several points",
                                          v));
}

// Nodes of the map by vertex of the input mesh.
Index find_vertex(const MapFile& file, Index input_vertex) {
  for (Index p = 0; p < file.input_vertex.size(); ++p)
    if (file.input_vertex[p] == input_vertex) return p;
  return -1;
}

void check_pins(const MapFile& file, const Json& claims, Findings& findings) {
  const double size = extent(file.uv);
  for (const Json& pin : claims.value("pins", Json::array())) {
    const Index vertex = pin.at("vertex").get<Index>(), point = find_vertex(file, vertex);
    const Eigen::RowVector2d target(pin.at("target").at(0).get<double>(),
                                    pin.at("target").at(1).get<double>());
    findings.require(point >= 0 && (file.uv.row(point) - target).norm() <= kClose * size,
                     fmt::format("the pin of vertex {} is not held", vertex));
  }
}

// A fixed boundary is that of the initial map: Tutte's, recomputed from the surface in the file, or
// the texture coordinates of the input, for which the input is needed.
void check_fixed_boundary(const MapFile& file, const BezierMap& map, const Json& claims,
                          const Request& request, Findings& findings) {
  if (claims.value("boundary", "") != "fixed") return;
  Vec start;
  if (claims.value("init", "tutte") == "tutte") {
    start = tutte_map(map.mesh());
  } else if (request.surface.empty()) {
    return findings.require(false,
                            "the boundary is that of texture coordinates: give the input with "
                            "--surface to check it");
  } else {
    const SurfaceMesh input = SurfaceMesh::from_polygons(read_mesh(request.surface));
    const Vec texture = texture_map(input);
    start.resize(2 * map.mesh().vertex_count());
    for (Index v = 0; v < map.mesh().vertex_count(); ++v) {
      const Index source = input.find_input_vertex(file.input_vertex[map.mesh().input_vertex(v)]);
      if (source < 0) return findings.require(false, "the file maps vertices the surface lacks");
      start.segment<2>(2 * v) = texture.segment<2>(2 * source);
    }
  }
  BezierMap initial = BezierMap::linear(map.shared_mesh(), start);
  while (initial.degree() < map.degree()) initial = initial.elevated();
  double worst = 0;
  for (const Index node : map.space().boundary_nodes())
    worst = std::max(worst, (map.control_points().segment<2>(2 * node) -
                             initial.control_points().segment<2>(2 * node))
                                .norm());
  findings.require(worst <= kClose * map.control_points().cwiseAbs().maxCoeff(),
                   fmt::format("the boundary is off the initial map's by {:g}", worst));
}

void check_arrays(const MapFile& file, const MapMeasures& measures, Findings& findings) {
  for (Index f = 0; f < file.distortion.size(); ++f)
    if (!(std::abs(file.distortion[f] - measures.face_value[f]) <=
          kEnergyClose * (measures.face_value[f] + measures.value))) {
      findings.require(false, fmt::format("cell {}: distortion {:.6g} is claimed, {:.6g} is found",
                                          f, file.distortion[f], measures.face_value[f]));
      break;
    }
  for (Index f = 0; f < file.min_det.size(); ++f)
    if (!(file.min_det[f] <= measures.min_det[f] * (1 + kClose))) {
      findings.require(false,
                       fmt::format("cell {}: det J >= {:.6g} is claimed, only {:.6g} is proven", f,
                                   file.min_det[f], measures.min_det[f]));
      break;
    }
}

void check_claims(const MapFile& file, const BezierMap& map, const MapMeasures& measures,
                  const Json& claims, const Request& request, Findings& findings) {
  if (claims.is_null()) return;
  try {
    const double value = claims.value("value", measures.value);
    findings.require(
        std::abs(value - measures.value) <= kEnergyClose * std::abs(measures.value) + kZeroEnergy,
        fmt::format("energy {:.9g} is claimed, {:.9g} is found", value, measures.value));
    findings.require(claims.value("degree", file.degree) == file.degree,
                     fmt::format("degree {} is not the one claimed", file.degree));
    if (!claims.value("seams", false)) check_cuts(file, findings);
    check_pins(file, claims, findings);
    check_fixed_boundary(file, map, claims, request, findings);
    check_arrays(file, measures, findings);
    for (const char* claim : {"bijective", "seams"})
      findings.require(!claims.value(claim, false),
                       fmt::format("the claim '{}' cannot be decided by this version", claim));
  } catch (const Json::exception& e) {
    findings.require(false, fmt::format("majorant_claims: {}", e.what()));
  }
}

// The claims, null when there are none; undoes the normalization they tell of.
Json read_claims(MapFile& file, Findings& findings) {
  if (file.claims.empty()) return nullptr;
  Json claims = Json::parse(file.claims, nullptr, false);
  if (claims.is_discarded() || !claims.is_object()) {
    findings.require(false, "majorant_claims is not a JSON object");
    return nullptr;
  }
  if (const Json n = claims.value("normalized", Json()); n.is_object()) {
    const Eigen::RowVector2d origin(n.at("origin").at(0).get<double>(),
                                    n.at("origin").at(1).get<double>());
    file.uv = ((file.uv * n.at("size").get<double>()).rowwise() + origin).eval();
  }
  return claims;
}

std::string claimed_energy(const Json& claims) {
  const Json energy = claims.is_object() ? claims.value("energy", Json()) : Json();
  return energy.is_string() ? energy.get<std::string>() : "symmetric-dirichlet";
}

MapMeasures check_map(MapFile& file, const Request& request, Findings& findings, Json& report) {
  const Json claims = read_claims(file, findings);
  const BezierMap map = to_bezier_map(file, request.result);
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
  check_claims(file, map, measures, claims, request, findings);
  return measures;
}

int check(const Request& request) {
  if (!request.common.report.empty()) require_writable({request.common.report}, {".json"});
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
  if (request.certify)
    findings.require(false, "global injectivity cannot be decided by this version");
  report["status"] = findings.list().empty() ? "valid" : "invalid";
  report["message"] = findings.list().empty() ? "" : findings.list().front();
  report["findings"] = findings.list();
  if (!request.common.report.empty()) write_json(request.common.report, report);
  if (findings.list().empty()) {
    if (!request.common.quiet)
      fmt::print(stderr, "{}: valid, degree {}, {} cells, {} {:.9g}\n", request.result, file.degree,
                 file.cells.rows(), report["result"]["energy"].get<std::string>(), measures.value);
    return kSuccess;
  }
  fmt::print(stderr, "majorant: {}: invalid: {}\n", request.result,
             fmt::join(findings.list(), "; "));
  return kInvalid;
}

}  // namespace

void add_check(CLI::App& app, Action* run) {
  auto request = std::make_shared<Request>();
  CLI::App& verb = *app.add_subcommand("check", "measure a finished map and test its claims");
  verb.add_option("result", request->result, "result: .vtu, or .obj with vt")->required();
  verb.add_option("--surface", request->surface, "the mesh it should be a map of")
      ->type_name("FILE");
  verb.add_flag("--certify", request->certify, "prove global injectivity as well");
  request->common.add_to(verb);
  verb.footer("Example: majorant check bunny.vtu --surface bunny.obj --report check.json");
  verb.callback([request, run] { *run = [request] { return check(*request); }; });
}

}  // namespace majorant::app
