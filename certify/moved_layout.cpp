#include "majorant/certify/moved_layout.h"

#include <algorithm>
#include <utility>

#include "majorant/certify/global_injectivity.h"
#include "majorant/certify/proven_distance.h"
#include "majorant/constraints/local_injectivity.h"
#include "majorant/elements/exact_determinant.h"
#include "majorant/framework/rounding.h"
#include "majorant/maps/rest_shapes_of.h"
#include "majorant/maps/smallest_rectangle.h"

namespace majorant {
namespace {

// The part of a distance that surely remains after division by the size, given rounding.
constexpr double kRounded = 1 - 1e-12;

// Returns u, v of every control point as a row.
Points2 rows_of(const BezierMap& map) {
  return map.control_points().reshaped(2, map.space().node_count()).transpose();
}

Vec lower_bounds(const BezierMap& map) {
  return LocalInjectivity(map.shared_space(), 2 * rest_shapes(map.mesh()).measure,
                          ProofDepth::kFinal)
      .lower_bounds(map.control_points());
}

bool is_within(const BezierMap& map, const Eigen::AlignedBox2d& box) {
  const auto nodes = map.control_points().reshaped(2, map.space().node_count());
  return box.contains(Eigen::AlignedBox2d(nodes.rowwise().minCoeff(), nodes.rowwise().maxCoeff()));
}

// Places the map under the first motion that can be proven. Measures only know bounds of det J,
// which are at most 0 if exact arithmetic was needed. stop only shortens the measuring: a stopped
// run still has its map proven.
std::optional<PlacedMap> placed(const BezierMap& map, const std::vector<LayoutMotion>& attempts,
                                const EnergySum& energy, const StopCheck& stop) {
  std::optional<MovedLayout> moved = moved_layout({map}, attempts);
  if (!moved) return {};
  BezierMap& there = moved->maps.front();
  MapMeasures measures = measure_normalized(there, moved->motion.size, energy, stop);
  measures.locally_injective =
      AngleSums(there.shared_space(), AngleSums::Vertices::Interior, there.shared_seams())
          .check(there.control_points())
          .feasible;
  if (!measures.locally_injective) return {};
  return PlacedMap{std::move(there), moved->motion, std::move(measures)};
}

}  // namespace

Points2 LayoutMotion::operator()(const Points2& uv) const {
  using Real = long double;
  const Real c = direction.x(), s = direction.y();
  const bool each_step = rounding == Rounding::EachStep;
  const Vector2 shift = each_step ? Vector2::Zero() : origin;
  const Real divisor = each_step ? 1 : size;
  Points2 moved(uv.rows(), 2);
  for (Index p = 0; p < uv.rows(); ++p) {
    const Real u = uv(p, 0), v = uv(p, 1);
    moved.row(p) << static_cast<double>((c * u + s * v - Real(shift.x())) / divisor),
        static_cast<double>((c * v - s * u - Real(shift.y())) / divisor);
  }
  if (each_step) return (moved.rowwise() - origin.transpose()) / size;
  return moved;
}

BezierMap LayoutMotion::operator()(const BezierMap& map) const {
  return map.with(map.shared_space(), (*this)(rows_of(map)).transpose().reshaped());
}

BezierMesh LayoutMotion::operator()(BezierMesh mesh) const {
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const Points2 uv = mesh.points.row(f).reshaped(2, mesh.points.cols() / 2).transpose();
    mesh.points.row(f) = (*this)(uv).transpose().reshaped().transpose();
  }
  return mesh;
}

bool has_positive_determinants(const BezierMap& map, const StopCheck& stop) {
  const Vec bounds = lower_bounds(map);
  const Points2 nodes = rows_of(map);
  for (Index f = 0; f < bounds.size(); ++f)
    if (!(bounds[f] > 0) &&
        exact_determinant_of_triangle(nodes(map.space().cells().row(f), Eigen::all), stop)
                .positive != ProofStatus::Proven)
      return false;
  return true;
}

std::optional<MovedLayout> moved_layout(const std::vector<BezierMap>& maps,
                                        const std::vector<LayoutMotion>& attempts,
                                        const LayoutRequirements& requirements,
                                        const StopCheck& stop) {
  const auto is_kept = [&](const BezierMap& map) {
    stop.poll();
    return has_positive_determinants(map, stop) &&
           (!requirements.simple_boundaries || check_boundary(map).result == ProofStatus::Proven);
  };
  for (const LayoutMotion& motion : attempts) {
    MovedLayout moved{{}, motion};
    for (const BezierMap& map : maps) {
      moved.maps.push_back(motion(map));
      const std::size_t k = moved.maps.size() - 1;
      if (!requirements.boxes.empty() && !is_within(moved.maps[k], requirements.boxes[k])) break;
      if (!is_kept(moved.maps[k])) break;
      if (moved.maps.size() < maps.size()) continue;
      const double distance = kRounded * requirements.distance / motion.size;
      const bool is_far =
          proven_distance(moved.maps, distance, requirements.fixed, stop) >= distance;
      if (is_far && (requirements.fixed.empty() || distance == 0 ||
                     proven_distance(moved.maps, distance, {}, stop) > 0))
        return moved;
    }
  }
  return {};
}

std::vector<LayoutMotion> unit_square_motions(const Vector2& direction, const Vector2& low,
                                              double side) {
  constexpr auto kEach = LayoutMotion::Rounding::EachStep;
  std::vector<LayoutMotion> attempts{
      {direction, low, side, kEach},
      {direction, low, power_of_two(side, PowerOfTwo::Above), kEach}};
  if (low.minCoeff() >= 0)
    attempts.push_back(
        {direction, {0, 0}, power_of_two(low.maxCoeff() + side, PowerOfTwo::Above), kEach});
  return attempts;
}

double layout_unit(const std::vector<BezierMap>& maps) {
  double largest = 0;
  for (const BezierMap& map : maps)
    largest = std::max(largest, map.control_points().cwiseAbs().maxCoeff());
  return largest > 0 ? power_of_two(largest) : 1;
}

Vector2 layout_direction(const BezierMap& map) {
  return layout_direction(rows_of(map), map.space().cells());
}

std::optional<PlacedMap> turned_along(const BezierMap& map, const Vector2& direction,
                                      const EnergySum& energy, const StopCheck& stop) {
  return placed(map, {{direction}}, energy, stop);
}

std::optional<PlacedMap> into_unit_square(const BezierMap& map, const Vector2& direction,
                                          const EnergySum& energy, const StopCheck& stop) {
  const Points2 uv = LayoutMotion{direction}(rows_of(map));
  const Vector2 low = uv.colwise().minCoeff(), high = uv.colwise().maxCoeff();
  const double side = (high - low).maxCoeff();
  return placed(map, unit_square_motions(direction, low, side), energy, stop);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
