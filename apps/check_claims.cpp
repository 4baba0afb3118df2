#include "apps/check_claims.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_set>

#include "apps/check_seams.h"
#include "majorant/io/read_mesh.h"
#include "majorant/parametrization/initial_map.h"

namespace majorant::app {
namespace {

constexpr double kEnergyClose = 1e-4;  // what reported energies are good to
constexpr double kZeroEnergy = 1e-9;   // energies may vanish at isometries

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

// Points of the map by vertex of the input mesh.
std::vector<Index> find_vertex(const MapFile& file, Index input_vertex) {
  std::vector<Index> points;
  for (Index p = 0; p < file.input_vertex.size(); ++p)
    if (file.input_vertex[p] == input_vertex) points.push_back(p);
  return points;
}

// A vertex on a seam has a point for each of its copies, pinned each by itself: every point must be
// at one of the vertex's targets, and no target without a point.
void check_pins(const MapFile& file, const Json& claims, Findings& findings) {
  std::map<Index, std::vector<Eigen::RowVector2d>> targets;
  for (const Json& pin : claims.value("pins", Json::array()))
    targets[pin.at("vertex").get<Index>()].emplace_back(pin.at("target").at(0).get<double>(),
                                                        pin.at("target").at(1).get<double>());
  const double size = extent(file.uv);
  const auto close = [&](Index point, const Eigen::RowVector2d& target) {
    return (file.uv.row(point) - target).norm() <= kClose * size;
  };
  for (const auto& [vertex, wanted] : targets) {
    const std::vector<Index> points = find_vertex(file, vertex);
    bool holds = true;
    for (const Eigen::RowVector2d& target : wanted)
      holds = holds &&
              std::any_of(points.begin(), points.end(), [&](Index p) { return close(p, target); });
    for (const Index p : points)
      holds = holds && std::any_of(wanted.begin(), wanted.end(),
                                   [&](const auto& target) { return close(p, target); });
    findings.require(holds, fmt::format("the pin of vertex {} is not held", vertex));
  }
}

// Of a map without seams: Tutte's boundary, recomputed from the surface in the file, or that of the
// texture coordinates of the input, for which the input is needed.
void check_fixed_boundary(const CheckedMap& checked, Findings& findings) {
  const BezierMap& map = checked.map;
  Vec start;
  if (checked.claims.value("init", "tutte") == "tutte") {
    start = tutte_map(map.mesh());
  } else if (checked.surface.empty()) {
    return findings.require(false,
                            "the boundary is that of texture coordinates: give the input with "
                            "--surface to check it");
  } else {
    const SurfaceMesh input = SurfaceMesh::from_polygons(read_mesh(checked.surface));
    const Vec texture = texture_map(input);
    start.resize(2 * map.mesh().vertex_count());
    for (Index v = 0; v < map.mesh().vertex_count(); ++v) {
      const Index source =
          input.find_input_vertex(checked.file.input_vertex[map.mesh().input_vertex(v)]);
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

}  // namespace

void check_claims(const CheckedMap& checked, Findings& findings) {
  const auto& [file, map, measures, claims, surface] = checked;
  if (claims.is_null()) return;
  const double value = claims.value("value", measures.value);
  findings.require(
      std::abs(value - measures.value) <= kEnergyClose * std::abs(measures.value) + kZeroEnergy,
      fmt::format("energy {:.9g} is claimed, {:.9g} is found", value, measures.value));
  findings.require(claims.value("degree", file.degree) == file.degree,
                   fmt::format("degree {} is not the one claimed", file.degree));
  const bool has_seams = !map.seams().trivial();
  if (!has_seams) check_cuts(file, findings);
  check_pins(file, claims, findings);
  if (claims.value("boundary", "") == "fixed") {
    if (has_seams)
      check_fixed_texture_boundary(checked, findings);
    else
      check_fixed_boundary(checked, findings);
  }
  check_arrays(file, measures, findings);
}

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

}  // namespace majorant::app
