#include "majorant/parametrization/drive/internal/placement.h"

#include <cmath>

#include "majorant/parametrization/maps/internal/smallest_rectangle.h"

namespace majorant {
namespace {

// u, v of every control point as a row.
Points2 rows_of(const BezierMap& map) {
  return map.control_points().reshaped(2, map.space().node_count()).transpose();
}

std::optional<PlacedMap> placed(const BezierMap& map, const LayoutPlacement& placement,
                                const EnergySum& energy, const StopCheck& stop) {
  const Points2 uv = placement(rows_of(map));
  BezierMap moved = map.with(map.shared_space(), uv.transpose().reshaped());
  MapMeasures measures = measure_normalized(moved, placement.size, energy, stop);
  if (!measures.locally_injective) return {};
  return PlacedMap{std::move(moved), placement, std::move(measures)};
}

}  // namespace

Points2 LayoutPlacement::operator()(const Points2& uv) const {
  const Points2 turned = turned_along(uv, direction);
  return (turned.rowwise() - origin.transpose()) / size;
}

BezierMesh LayoutPlacement::operator()(BezierMesh mesh) const {
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const Points2 uv = mesh.points.row(f).reshaped(2, mesh.points.cols() / 2).transpose();
    mesh.points.row(f) = (*this)(uv).transpose().reshaped().transpose();
  }
  return mesh;
}

Vector2 layout_direction(const BezierMap& map) {
  return layout_direction(rows_of(map), map.space().cells());
}

std::optional<PlacedMap> turned_along(const BezierMap& map, const Vector2& direction,
                                      const EnergySum& energy, const StopCheck& stop) {
  return placed(map, {direction}, energy, stop);
}

std::optional<PlacedMap> into_unit_square(const BezierMap& map, const Vector2& direction,
                                          const EnergySum& energy, const StopCheck& stop) {
  const Points2 uv = turned_along(rows_of(map), direction);
  const Vector2 low = uv.colwise().minCoeff(), high = uv.colwise().maxCoeff();
  const double side = (high - low).maxCoeff();
  for (const double size : {side, std::exp2(std::ceil(std::log2(side)))})
    if (auto found = placed(map, {direction, low, size}, energy, stop)) return found;
  return {};
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
