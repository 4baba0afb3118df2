#include "majorant/results/internal/check_claims.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "majorant/framework/error.h"
#include "majorant/framework/internal/rounding.h"
#include "majorant/io/lagrange_cell.h"
#include "majorant/mesh/internal/geometry.h"
#include "majorant/mesh/refusal.h"
#include "majorant/parametrization/initialization/texture_seams.h"
#include "majorant/parametrization/initialization/tutte.h"
#include "majorant/results/internal/check_seams.h"

namespace majorant {
namespace {

// What reported energies are good to. Origin: a hundred times kEnergyAgreement of measure.cpp,
// since rounded control points are measured anew.
constexpr double kEnergyClose = 1e-4;
// Of faces. Origin: what rounding does to tiny ones is less; chosen, not tuned.
constexpr double kDistortionClose = 1e-2;
// Energies may vanish at isometries. Origin: as kTenDigits.
constexpr double kZeroEnergy = 1e-9;

// The scale that a normalized result was made in.
double claimed_scale(const Claims& claims) {
  return claims.normalized ? claims.normalized->size : 1.0;
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

// Of a map without seams: Tutte's boundary, recomputed from the surface in the file, or that of the
// texture coordinates of the input, for which the input is needed.
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

// How far control points of a cell may be from those that were measured, in the units of the run:
// uv was rounded after turning and normalizing, and again as values of Lagrange cells, whose errors
// grow by `amplification`.
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

// What that may have changed of det J: steps between control points are off by at most `unit`,
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

void check_arrays(const CheckedMap& checked, Findings& findings) {
  const MapFile& file = checked.file;
  const MapMeasures& measures = checked.measures;
  for (Index f = 0; f < file.distortion.size() && !measures.cut_short; ++f)
    if (!(std::abs(file.distortion[f] - measures.face_value[f]) <=
          kEnergyClose * (measures.face_value[f] + measures.value) + kZeroEnergy)) {
      findings.require(false, fmt::format("cell {}: distortion {:.6g} is claimed, {:.6g} is found",
                                          f, file.distortion[f], measures.face_value[f]));
      break;
    }
  const double amplification =
      file.uv_rounding.rows() == 0 ? 0 : lagrange_amplification(file.degree);
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
      if (std::abs(c - m) <= kDistortionClose * std::abs(m)) continue;
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
  check_pins(file, claims, findings);
  check_seams(checked, findings);
  if (claims.boundary == BoundaryCondition::Fixed) check_boundary_claim(checked, findings);
  check_arrays(checked, findings);
  check_face_distortion(checked, findings);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
