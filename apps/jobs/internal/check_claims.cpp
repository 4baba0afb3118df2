#include "majorant/apps/jobs/internal/check_claims.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "majorant/constraints/constraints.h"
#include "majorant/framework/error.h"
#include "majorant/framework/rounding.h"
#include "majorant/io/lagrange_cell.h"
#include "majorant/mesh/geometry.h"
#include "majorant/mesh/refusal.h"
#include "majorant/parametrization/initialization/start.h"

namespace majorant {
namespace {

// The conditions of `check` on claims of maps with seams: cones, marks and cuts must be those that
// were claimed or given. The fit of the seams is proven elsewhere (certify/map_proof.h).

// An edge from one vertex of the input to another.
using InputEdge = std::pair<Index, Index>;

InputEdge input_edge(const SurfaceMesh& mesh, Index h) {
  return {mesh.input_vertex(mesh.from_vertex(h)), mesh.input_vertex(mesh.to_vertex(h))};
}

std::string place(const InputEdge& edge) {
  return fmt::format("edge ({}, {})", edge.first, edge.second);
}

// Returns the quarter turns of both sides of every seam edge.
std::map<InputEdge, int> turns_by_edge(const BezierMap& map) {
  std::map<InputEdge, int> turns;
  for (const SeamEdge& edge : map.seams().edges()) {
    turns[input_edge(map.mesh(), edge.side)] = edge.turns;
    turns[input_edge(map.mesh(), edge.opposite)] = (4 - edge.turns) % 4;
  }
  return turns;
}

void check_cones(const BezierMap& map, const std::vector<Cone>& claims, Findings& findings) {
  std::map<Index, int> found, claimed;
  for (const Cone& cone : map.seams().cones())
    found[map.mesh().input_vertex(cone.vertex)] = cone.quarter_turns;
  for (const Cone& cone : claims) claimed[cone.vertex] = cone.quarter_turns;
  const auto turns = [](const std::map<Index, int>& cones, Index vertex) {
    const auto cone = cones.find(vertex);
    return cone == cones.end() ? 4 : cone->second;
  };
  for (const auto* list : {&claimed, &found})
    for (const auto& [vertex, ignored] : *list)
      if (turns(claimed, vertex) != turns(found, vertex))
        return findings.require(
            false, fmt::format("vertex {}: an angle of {} quarter turns is claimed, {} are found",
                               vertex, turns(claimed, vertex), turns(found, vertex)));
}

// Checks the arrays `seam_edges` and `cone` of the file.
void check_marks(const MapFile& file, const BezierMap& map, Findings& findings) {
  const MapFile found = to_map_file(map);
  for (Index h = 0; h < 3 * file.seam_edges.rows(); ++h) {
    const bool is_marked = file.seam_edges(face_of(h), corner_of(h)) != 0;
    const bool is_found =
        found.seam_edges.size() > 0 && found.seam_edges(face_of(h), corner_of(h)) != 0;
    if (is_marked == is_found) continue;
    findings.require(
        false,
        fmt::format("cell {}: {} is {}", face_of(h), place(input_edge(map.mesh(), h)),
                    is_marked ? "marked as a seam and not cut" : "cut and not marked as a seam"));
    break;
  }
  if (file.cone.size() == 0) return;
  for (Index h = 0; h < 3 * file.cells.rows(); ++h) {
    const Index point = file.cells(face_of(h), corner_of(h));
    const int turns = found.cone.size() > 0 ? found.cone[found.cells(face_of(h), corner_of(h))] : 0;
    if (file.cone[point] == turns) continue;
    return findings.require(false,
                            fmt::format("vertex {}: marked as a cone of {} quarter turns, {} "
                                        "are found",
                                        input_edge(map.mesh(), h).first, file.cone[point], turns));
  }
}

void check_cut(const BezierMap& map, const SurfaceMesh& surface, Findings& findings) {
  const std::map<InputEdge, int> expected = turns_by_edge(seamless_from_texture(surface).map);
  const std::map<InputEdge, int> found = turns_by_edge(map);
  for (const auto& [edge, turns] : expected) {
    const auto same = found.find(edge);
    if (same == found.end())
      return findings.require(
          false, fmt::format("the surface's texture is cut at {}, the map is not", place(edge)));
    if (same->second != turns)
      return findings.require(
          false, fmt::format("{}: the surface's texture has {} quarter turns there, the map {}",
                             place(edge), turns, same->second));
  }
  for (const auto& [edge, turns] : found)
    if (!expected.contains(edge))
      return findings.require(
          false, fmt::format("the map is cut at {}, the surface's texture is not", place(edge)));
}

// Returns whether the map should have the cuts of the surface's texture coordinates. This holds for
// results of `parametrize --seamless`, and for files of unknown origin. Results of `seamless` name
// the method of their start as `init`.
bool keeps_texture_cuts(const CheckedMap& checked) {
  if (checked.surface == nullptr || checked.surface->polygon_texcoords.empty()) return false;
  const Claims& claims = checked.claims;
  if (!claims.version && !claims.seams) return true;  // the origin is unknown
  return claims.options && claims.options->seamless.value_or(false) &&
         (starts_at_tutte_boundary(claims) || claims.init == ClaimedStart::Input);
}

// Checks cones; if there are seams, also marks, and the cut if the surface has texture coordinates.
void check_seams(const CheckedMap& checked, Findings& findings) {
  const BezierMap& map = checked.map;
  if (checked.cuts.others > 0) return;
  if (checked.claims.cones) check_cones(map, *checked.claims.cones, findings);
  check_marks(checked.file, map, findings);
  if (map.seams().trivial()) return;
  if (!keeps_texture_cuts(checked)) return;
  try {
    check_cut(map, SurfaceMesh::from_polygons(*checked.surface), findings);
  } catch (const Error& e) {  // the texture is no seamless map; an error only if it is claimed
    if (checked.claims.version) findings.add_violation(problem_of(e));
  }
}

// Checks that the boundary of the uncut surface is where its texture has it; nothing without a
// texture.
void check_fixed_texture_boundary(const CheckedMap& checked, Findings& findings) {
  if (!keeps_texture_cuts(checked)) return;  // nothing to check
  const BezierMap start = seamless_from_texture(SurfaceMesh::from_polygons(*checked.surface)).map;
  const SurfaceMesh& start_mesh = start.mesh();
  std::map<InputEdge, Index> start_edges;  // of the boundary of the cut surface
  for (Index h = 0; h < start_mesh.half_edge_count(); ++h)
    if (start_mesh.opposite(h) < 0) start_edges[input_edge(start_mesh, h)] = h;

  const BezierMap& map = checked.map;
  const std::map<InputEdge, int> seams = turns_by_edge(map);
  const Vec x = in_units_of_the_run(map.control_points(), checked.claims);
  double worst = 0;
  for (Index h = 0; h < map.mesh().half_edge_count(); ++h) {
    const InputEdge edge = input_edge(map.mesh(), h);
    if (map.mesh().opposite(h) >= 0 || seams.contains(edge)) continue;
    const auto source = start_edges.find(edge);
    if (source == start_edges.end())
      return findings.require(false, "the file maps edges the surface lacks");
    const auto at_start = [&](Index vertex) {
      return Vector2(start.control_points().segment<2>(2 * vertex));
    };
    const Vector2 from = at_start(start_mesh.from_vertex(source->second));
    const Vector2 to = at_start(start_mesh.to_vertex(source->second));
    const std::vector<Index> nodes = edge_nodes(map.space(), h);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const Vector2 uv = x.segment<2>(2 * nodes[i]);
      const double s = static_cast<double>(i) / static_cast<double>(nodes.size() - 1);
      worst = std::max(worst, (uv - (1 - s) * from - s * to).norm());
    }
  }
  findings.require(x.allFinite() && worst <= kClose * x.cwiseAbs().maxCoeff(),
                   fmt::format("the boundary is off the initial map's by {:g}", worst));
}

// The relative accuracy of reported energies. It is 100 times kEnergyAgreement of measure.cpp,
// since control points are measured again after rounding.
constexpr double kEnergyClose = 1e-4;
// The relative accuracy of distortions of faces, larger than what rounding does to tiny faces.
// Chosen, not tuned.
constexpr double kDistortionClose = 1e-2;
// Energies below this count as zero, their value at isometries. Equal to kTenDigits.
constexpr double kZeroEnergy = 1e-9;

// Returns the points of the map for a vertex of the input.
std::vector<Index> find_vertex(const MapFile& file, Index input_vertex) {
  std::vector<Index> points;
  for (Index p = 0; p < file.input_vertex.size(); ++p)
    if (file.input_vertex[p] == input_vertex) points.push_back(p);
  return points;
}

// Checks pins. A vertex on a seam has a point for each copy, and each is pinned by itself: every
// point must be at one of the vertex's targets, and every target must have a point.
void check_pins(const MapFile& file, const Claims& claims, Findings& findings) {
  std::map<Index, std::vector<Eigen::RowVector2d>> targets;
  for (const ClaimedPin& pin : claims.pins.value_or(std::vector<ClaimedPin>{}))
    targets[pin.vertex].emplace_back(pin.target);
  const double size = extent(file.uv);
  const auto close = [&](Index point, const Eigen::RowVector2d& target) {
    return (file.uv.row(point) - target).norm() <= kClose * size;
  };
  for (const auto& [vertex, positions] : targets) {
    const std::vector<Index> points = find_vertex(file, vertex);
    bool holds = true;
    for (const Eigen::RowVector2d& target : positions)
      holds = holds &&
              std::any_of(points.begin(), points.end(), [&](Index p) { return close(p, target); });
    for (const Index p : points)
      holds = holds && std::any_of(positions.begin(), positions.end(),
                                   [&](const auto& target) { return close(p, target); });
    findings.require(holds, fmt::format("the pin of vertex {} is not held", vertex));
  }
}

// Checks the boundary of a map without seams: Tutte's boundary, computed from the surface in the
// file, or the boundary of the input's texture coordinates, which needs the input.
void check_fixed_boundary(const CheckedMap& checked, Findings& findings) {
  const BezierMap& map = checked.map;
  Vec start;
  if (starts_at_tutte_boundary(checked.claims)) {
    start = tutte_map(map.mesh());
  } else if (checked.surface == nullptr) {
    return;  // nothing to check
  } else {
    const SurfaceMesh input = SurfaceMesh::from_polygons(*checked.surface);
    const Vec texture = texture_map(input);
    start.resize(2 * map.mesh().vertex_count());
    for (Index v = 0; v < map.mesh().vertex_count(); ++v) {
      const Index source = input.find_input_vertex(map.mesh().input_vertex(v));
      if (source < 0) return findings.add_violation("the file maps vertices the surface lacks");
      start.segment<2>(2 * v) = texture.segment<2>(2 * source);
    }
  }
  BezierMap initial = BezierMap::linear(map.shared_mesh(), start);
  while (initial.degree() < map.degree()) initial = initial.elevated();
  const Vec x = in_units_of_the_run(map.control_points(), checked.claims);
  double worst = 0;
  for (const Index node : map.space().boundary_nodes())
    worst = std::max(
        worst, (x.segment<2>(2 * node) - initial.control_points().segment<2>(2 * node)).norm());
  findings.require(x.allFinite() && worst <= kClose * x.cwiseAbs().maxCoeff(),
                   fmt::format("the boundary is off the initial map's by {:g}", worst));
}

// Returns a bound on the distance of a cell's control points from those that were measured, in
// units of the run. uv was rounded after turning and normalizing, and again as values of Lagrange
// cells, whose errors grow by `amplification`.
double rounding_of_uv(const CheckedMap& checked, Index cell, double amplification) {
  constexpr double kEpsilon = 2 * kUnitRoundoff<double>;
  const MapFile& file = checked.file;
  const double size = claimed_scale(checked.claims);
  double unit = 0;
  if (checked.claims.normalized) {
    const ClaimedNormalization& n = *checked.claims.normalized;
    unit = 4 * kEpsilon * (n.origin.cwiseAbs().maxCoeff() + n.size);
  }
  if (checked.claims.aligned) unit += 4 * kEpsilon * size * file.uv.cwiseAbs().maxCoeff();
  const double largest = file.uv(file.cells.row(cell), Eigen::all).cwiseAbs().maxCoeff();
  return unit + size * amplification * kEpsilon * largest;
}

// Returns a bound on the resulting change of det J. Differences of control points are off by at
// most `unit`; a derivative is the sum of 2 n of them.
double rounding_of_det(const CheckedMap& checked, Index cell, double amplification) {
  const double unit = rounding_of_uv(checked, cell, amplification);
  if (unit == 0) return 0;
  const MapFile& file = checked.file;
  const double reach =
      claimed_scale(checked.claims) * extent(file.uv(file.cells.row(cell), Eigen::all));
  const auto corner = [&](Index k) { return Vector3(file.points.row(file.cells(cell, k))); };
  const Vector3 first = corner(0) - corner(2), second = corner(1) - corner(2);
  const double one = first.stableNorm(),
               other = second.stableNorm();  // the squares may underflow
  const double sine = (first / one).cross(second / other).norm();
  return 4.0 * file.degree * file.degree * (unit / one) * ((reach + unit) / other) / sine;
}

double amplification_of(const MapFile& file) {
  return file.uv_rounding.rows() == 0 ? 0 : lagrange_amplification(file.degree);
}

// Returns the relative change of a cell's distortion that rounding may cause. Distortions are
// functions of singular values, which change by at most twice the relative change of det J.
// Infinite if the digits do not determine the distortion.
double rounding_of_distortion(const CheckedMap& checked, Index cell) {
  const double of_det = rounding_of_det(checked, cell, amplification_of(checked.file));
  return of_det == 0 ? 0 : 4 * of_det / std::max(checked.measures.min_det[cell], 0.0);
}

void check_arrays(const CheckedMap& checked, Findings& findings) {
  const MapFile& file = checked.file;
  const MapMeasures& measures = checked.measures;
  for (Index f = 0; f < file.distortion.size() && !measures.cut_short; ++f)
    if (!(std::abs(file.distortion[f] - measures.face_value[f]) <=
          (kEnergyClose + rounding_of_distortion(checked, f)) *
                  (measures.face_value[f] + measures.value) +
              kZeroEnergy)) {
      findings.require(false, fmt::format("cell {}: distortion {:.6g} is claimed, {:.6g} is found",
                                          f, file.distortion[f], measures.face_value[f]));
      break;
    }
  const double amplification = amplification_of(file);
  for (Index f = 0; f < file.min_det.size(); ++f)
    if (!(file.min_det[f] <=
          measures.min_det[f] * (1 + kClose) + rounding_of_det(checked, f, amplification))) {
      findings.require(false,
                       fmt::format("cell {}: det J >= {:.6g} is claimed, only {:.6g} is proven", f,
                                   file.min_det[f], measures.min_det[f]));
      break;
    }
}

void check_face_distortion(const CheckedMap& checked, Findings& findings) {
  const FaceDistortion &claimed = checked.file.face_distortion,
                       &found = checked.measures.distortion.faces;
  if (checked.measures.cut_short) return;
  for (Index f = 0; f < claimed.rows(); ++f)
    for (std::size_t k = 0; k < kFaceDistortionNames.size(); ++k) {
      const double c = claimed(f, static_cast<Index>(k)), m = found(f, static_cast<Index>(k));
      const double close = kDistortionClose + rounding_of_distortion(checked, f);
      if (std::abs(c - m) <= close * std::abs(m)) continue;
      return findings.add_violation(fmt::format("cell {}: {} {:.6g} is claimed, {:.6g} is found", f,
                                                kFaceDistortionNames[k], c, m));
    }
}

void check_boundary_claim(const CheckedMap& checked, Findings& findings) {
  try {
    if (checked.map.seams().trivial())
      check_fixed_boundary(checked, findings);
    else
      check_fixed_texture_boundary(checked, findings);
  } catch (const Error& e) {  // there is no such start
    findings.add_violation(fmt::format("a fixed boundary is claimed: {}", problem_of(e)));
  }
}

}  // namespace

Vec in_units_of_the_run(VecIn uv, const Claims& claims) {
  Vec x = uv * claimed_scale(claims);
  if (claims.normalized) x += claims.normalized->origin.replicate(x.size() / 2, 1);
  if (!claims.aligned) return x;
  const double c = claims.aligned->x(), s = claims.aligned->y();
  for (Index k = 0; k < x.size(); k += 2)
    x.segment<2>(k) = Vector2(c * x[k] - s * x[k + 1], s * x[k] + c * x[k + 1]);
  return x;
}

void check_claims(const CheckedMap& checked, Findings& findings) {
  const auto& [file, map, measures, claims, surface, cuts] = checked;
  findings.require(!claims.value || measures.cut_short ||
                       (std::isfinite(measures.value) &&
                        std::abs(*claims.value - measures.value) <=
                            kEnergyClose * std::abs(measures.value) + kZeroEnergy),
                   fmt::format("energy {:.9g} is claimed, {:.9g} is found",
                               claims.value.value_or(0), measures.value));
  if (measures.cut_short && (claims.value || file.distortion.size() > 0))
    findings.add_open("the claimed energy: could not be decided: stopped before it was measured");
  findings.require(claims.degree.value_or(file.degree) == file.degree,
                   fmt::format("degree {} is not the one claimed", file.degree));
  if (claims.normalized && claims.layout_scale)
    findings.require(
        std::abs(*claims.layout_scale * claims.normalized->size - 1) <= kClose,
        fmt::format("the claimed layout_scale {:g} is not that of the claimed size {:g}",
                    *claims.layout_scale, claims.normalized->size));
  check_pins(file, claims, findings);
  check_seams(checked, findings);
  if (claims.boundary == BoundaryCondition::Fixed) check_boundary_claim(checked, findings);
  check_arrays(checked, findings);
  check_face_distortion(checked, findings);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
