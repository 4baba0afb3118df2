#include "distributed/internal/start_of_part.h"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "majorant/parametrization/maps/rest_shapes_of.h"
#include "majorant/parametrization/solve/pins.h"

namespace majorant {
namespace {

// The larger of the extents of the whole surface along the axes.
double extent_of(const MeshPart& part) {
  std::array<double, 6> least;
  least.fill(std::numeric_limits<double>::infinity());
  for (const auto& p : part.mesh->positions().rowwise())
    for (std::size_t k = 0; k < 3; ++k) {
      least[k] = std::min(least[k], p[static_cast<Index>(k)]);
      least[3 + k] = std::min(least[3 + k], -p[static_cast<Index>(k)]);
    }
  part.ranks().min(least);
  double size = 0;
  for (std::size_t k = 0; k < 3; ++k) size = std::max(size, -least[3 + k] - least[k]);
  return size;
}

double coordinate_size(const MeshPart& part, const Vec& uv) {
  return part.ranks().max(uv.size() > 0 ? uv.cwiseAbs().maxCoeff() : 0);
}

// Where a vertex of the whole surface is: each of its owners says so alone.
Vector2 gauge_position(const MeshPart& part, const Vec& uv) {
  std::array<double, 2> sum{};
  const Partition vertices = part.vertices();
  for (const Index v : part.gauge_vertex())
    if (vertices.owns(v)) sum = {uv[2 * v], uv[2 * v + 1]};
  part.ranks().sum(sum);
  return {sum[0], sum[1]};
}

}  // namespace

StartOfPart::StartOfPart(std::shared_ptr<const MeshPart> part, const Vec& uv,
                         const MapOptions& asked)
    : frame_{normalizing_scale(extent_of(*part), part->ranks().sum(part->mesh->area()))},
      specification_(asked) {
  const SurfaceMesh& mesh = *part->mesh;
  require_face_data(mesh, asked);
  MapSpecification& spec = specification_;
  spec.part = part;
  spec.rest = rest_shapes(mesh, frame_.scale);
  std::vector<char> on_boundary(to_size(mesh.vertex_count()), 0);  // of the whole surface
  for (const Index v : part->boundary_vertices) on_boundary[v] = 1;
  spec.pins = place_pins(
      mesh, asked.pins, uv, pin_tolerance(coordinate_size(*part, uv)),
      [&](Index v) { return asked.boundary == BoundaryCondition::Fixed && on_boundary[v]; });
  spec.handles = place_handles(mesh, asked.handles, spec.pins, uv, frame_.scale);
  const bool free = !part->ranks().any(!spec.pins.empty() || !spec.handles.empty()) &&
                    spec.boundary == BoundaryCondition::Free;
  const Vector2 gauge = gauge_position(*part, uv);
  if (free) frame_.move_origin(gauge, spec.boundary);
  for (auto* points : {&spec.pins, &spec.handles}) frame_.normalize(*points);
  x_ = frame_.normalized(uv);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
