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

// The demands of `check` on the claims of maps with seams: cones, marks and cuts are those that
// were claimed or given. That the seams fit is proven elsewhere (certify/map_proof.h).

// From and to, vertices of the input.
using InputEdge = std::pair<Index, Index>;

InputEdge input_edge(const SurfaceMesh& mesh, Index h) {
  return {mesh.input_vertex(mesh.from_vertex(h)), mesh.input_vertex(mesh.to_vertex(h))};
}

std::string place(const InputEdge& edge) {
  return fmt::format("edge ({}, {})", edge.first, edge.second);
}

// Turns of both sides of every seam edge.
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

// The arrays `seam_edges` and `cone` of the file.
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

// Returns whether the cut of the map should be that of the texture coordinates of the surface:
// results of `parametrize --seamless`, and files that do not say where they come from. Those of
// `seamless` name the method that made their start as `init`.
bool keeps_texture_cuts(const CheckedMap& checked) {
  if (checked.surface == nullptr || checked.surface->polygon_texcoords.empty()) return false;
  const Claims& claims = checked.claims;
  if (!claims.version && !claims.seams) return true;  // it does not say where it comes from
  return claims.options && claims.options->seamless.value_or(false) &&
         (starts_at_tutte_boundary(claims) || claims.init == ClaimedStart::Input);
}

// Cones; where there are seams, marks, and the cut, if the surface has texture coordinates.
void check_seams(const CheckedMap& checked, Findings& findings) {
  const BezierMap& map = checked.map;
  if (checked.cuts.others > 0) return;
  if (checked.claims.cones) check_cones(map, *checked.claims.cones, findings);
  check_marks(checked.file, map, findings);
  if (map.seams().trivial()) return;
  if (!keeps_texture_cuts(checked)) return;
  try {
    check_cut(map, SurfaceMesh::from_polygons(*checked.surface), findings);
  } catch (const Error& e) {  // that texture is no seamless map: not asked, unless it is claimed
    if (checked.claims.version) findings.add_violation(problem_of(e));
  }
}

// The boundary of the uncut surface is where the texture of the surface has it; nothing without
// one.
void check_fixed_texture_boundary(const CheckedMap& checked, Findings& findings) {
  if (!keeps_texture_cuts(checked)) return;  // not asked
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

// The relative accuracy of reported energies. A hundred times kEnergyAgreement of measure.cpp,
// since rounded control points are measured anew.
constexpr double kEnergyClose = 1e-4;
// The relative accuracy of distortions of faces. What rounding does to tiny ones is less; chosen,
// not tuned.
constexpr double kDistortionClose = 1e-2;
// Energies may vanish at isometries. As kTenDigits.
constexpr double kZeroEnergy = 1e-9;

// Points of the map by vertex of the input mesh.
std::vector<Index> find_vertex(const MapFile& file, Index input_vertex) {
  std::vector<Index> points;
  for (Index p = 0; p < file.input_vertex.size(); ++p)
    if (file.input_vertex[p] == input_vertex) points.push_back(p);
  return points;
}

// A vertex on a seam has a point for each of its copies, pinned each by itself: every point must be
// at one of the vertex's targets, and no target without a point.
void check_pins(const MapFile& file, const Claims& claims, Findings& findings) {
  std::map<Index, std::vector<Eigen::RowVector2d>> targets;
  for (const ClaimedPin& pin : claims.pins.value_or(std::vector<ClaimedPin>{}))
    targets[pin.vertex].emplace_back(pin.target);
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

// Checks the boundary of a map without seams: Tutte's boundary, recomputed from the surface in the
// file, or that of the texture coordinates of the input, for which the input is needed.
void check_fixed_boundary(const CheckedMap& checked, Findings& findings) {
  const BezierMap& map = checked.map;
  Vec start;
  if (starts_at_tutte_boundary(checked.claims)) {
    start = tutte_map(map.mesh());
  } else if (checked.surface == nullptr) {
    return;  // not asked
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

// A bound on the distance of a cell's control points from those that were measured, in the units of
// the run: uv was rounded after turning and normalizing, and again as values of Lagrange cells,
// whose errors grow by `amplification`.
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

// A bound on the change of det J by that: steps between control points are off by at most `unit`,
// twice n of them make a derivative.
double rounding_of_det(const CheckedMap& checked, Index cell, double amplification) {
  const double unit = rounding_of_uv(checked, cell, amplification);
  if (unit == 0) return 0;
  const MapFile& file = checked.file;
  const double reach =
      claimed_scale(checked.claims) * extent(file.uv(file.cells.row(cell), Eigen::all));
  const auto corner = [&](Index k) { return Vector3(file.points.row(file.cells(cell, k))); };
  const Vector3 first = corner(0) - corner(2), second = corner(1) - corner(2);
  const double one = first.stableNorm(),
               other = second.stableNorm();  // their squares may underflow
  const double sine = (first / one).cross(second / other).norm();
  return 4.0 * file.degree * file.degree * (unit / one) * ((reach + unit) / other) / sine;
}

double amplification_of(const MapFile& file) {
  return file.uv_rounding.rows() == 0 ? 0 : lagrange_amplification(file.degree);
}

// The part of a cell's distortion that rounding may have changed. Distortions are functions of
// singular values, which change by twice the part of det J at most. Infinite where the digits do
// not tell the distortion at all.
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
