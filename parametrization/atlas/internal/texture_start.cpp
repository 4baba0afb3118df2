#include "majorant/parametrization/atlas/internal/texture_start.h"

#include <cmath>
#include <utility>

#include "majorant/mesh/exact_predicates.h"
#include "majorant/mesh/texture_borders.h"
#include "majorant/parametrization/initialization/internal/untangle.h"
#include "majorant/parametrization/maps/rest_shapes_of.h"

namespace majorant {
namespace {

// u, v per vertex: the coordinates of any of its corners, which agree in a chart.
Vec vertex_coordinates(const SurfaceMesh& mesh) {
  Vec uv(2 * mesh.vertex_count());
  for (Index f = 0; f < mesh.face_count(); ++f)
    for (Index k = 0; k < 3; ++k)
      uv.segment<2>(2 * mesh.faces()(f, k)) = mesh.corner_texcoords().row(f).segment<2>(2 * k);
  return uv;
}

double signed_area(const SurfaceMesh& mesh, const Vec& uv) {
  const auto corner = [&](Index f, Index k) {
    return Vector2(uv.segment<2>(2 * mesh.faces()(f, k)));
  };
  double sum = 0;
  for (Index f = 0; f < mesh.face_count(); ++f)
    sum += 0.5 * cross(Vector2(corner(f, 1) - corner(f, 0)), Vector2(corner(f, 2) - corner(f, 0)));
  return sum;
}

bool is_positive(const SurfaceMesh& mesh, const Vec& uv) {
  const auto corner = [&](Index f, Index k) {
    return Vector2(uv.segment<2>(2 * mesh.faces()(f, k)));
  };
  for (Index f = 0; f < mesh.face_count(); ++f)
    if (orientation(corner(f, 0), corner(f, 1), corner(f, 2)) <= 0) return false;
  return true;
}

}  // namespace

std::optional<PreparedTexture> texture_start(const std::shared_ptr<const SurfaceMesh>& mesh,
                                             const RunRecord& record) {
  if (untextured_polygons(*mesh) > 0) return std::nullopt;
  Vec uv = vertex_coordinates(*mesh);
  const double area = signed_area(*mesh, uv);
  if (area < 0)
    for (Index v = 0; v < mesh->vertex_count(); ++v) uv[2 * v] = -uv[2 * v];
  const double scale = std::sqrt(mesh->area() / std::abs(area));
  if (!std::isfinite(scale) || !(scale > 0)) return std::nullopt;
  uv *= scale;
  if (!uv.allFinite()) return std::nullopt;
  if (is_positive(*mesh, uv)) return PreparedTexture{std::move(uv), ChartStart::Texture};
  const BezierMap map = BezierMap::linear(mesh, uv);
  MapSpecification spec;
  spec.rest = rest_shapes(*mesh);
  UntangleResult untangled = untangle(spec, map.shared_space(), uv, record);
  if (!untangled.inverted.empty() || !is_positive(*mesh, untangled.x)) return std::nullopt;
  return PreparedTexture{std::move(untangled.x), ChartStart::Untangled};
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
