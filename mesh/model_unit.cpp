#include "majorant/mesh/model_unit.h"

#include <cmath>
#include <limits>
#include <utility>

#include "majorant/framework/rounding.h"
#include "majorant/mesh/geometry.h"

namespace majorant {
namespace {

// Extents between 2^-100 and 2^100 are ordinary: products of eight lengths (squares of squared
// areas) stay in the range of doubles, 2^-1022 to 2^1024.
constexpr int kOrdinary = 100;

}  // namespace

double model_unit(const SurfaceMesh& mesh) {
  const double size = extent(mesh.positions());
  if (!std::isfinite(size)) return std::ldexp(1.0, std::numeric_limits<double>::max_exponent - 1);
  if (!(size > 0)) return 1;
  const int exponent = std::ilogb(size);
  return std::abs(exponent) <= kOrdinary ? 1 : power_of_two(size);
}

std::shared_ptr<const SurfaceMesh> in_units(const SurfaceMesh& mesh, double unit) {
  SurfaceParts parts = mesh.parts();
  parts.origin /= unit;
  parts.positions /= unit;
  for (RestTriangle& rest : parts.rest_triangles)
    for (Vector2& corner : rest.corners) corner /= unit;
  return std::make_shared<const SurfaceMesh>(SurfaceMesh::from_parts(std::move(parts)));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
