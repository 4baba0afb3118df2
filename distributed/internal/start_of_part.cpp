#include "distributed/internal/start_of_part.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "majorant/framework/error.h"
#include "majorant/parametrization/drive/internal/normalized_start.h"
#include "majorant/parametrization/maps/rest_shapes_of.h"

namespace majorant {
namespace {

// Of the start's coordinates, that a pin's target may be away. Origin: pin_tolerance() of one
// process.
constexpr double kPinTolerance = 1e-9;

// The larger of the extents of the whole surface along the axes.
double size_of(const MeshPart& part) {
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

Vec translated(Vec x, const Vector2& by) {
  for (Index k = 0; k < x.size(); k += 2) x.segment<2>(k) += by;
  return x;
}

}  // namespace

StartOfPart::StartOfPart(std::shared_ptr<const MeshPart> part, const Vec& uv,
                         const MapOptions& asked)
    : scale_(std::exp2(-std::round(std::log2(size_of(*part))))) {
  MapSpecification& spec = specification_;
  static_cast<MapObjective&>(spec) = asked;
  spec.part = part;
  spec.rest = rest_shapes(*part->mesh, scale_);
  const double tolerance = kPinTolerance * coordinate_size(*part, uv);
  for (const Pin& pin : asked.pins) {
    const Vector2 here = uv.segment<2>(2 * pin.vertex);
    const Vector2 target = pin.target.value_or(here);
    if (!((target - here).norm() <= tolerance))
      throw Error(ErrorKind::Infeasible,
                  fmt::format("the pin of vertex {} is {:.6g} away from the initial map; hold it "
                              "there with \"target\": \"initial\", start from a map that meets the "
                              "pins with --init input, or use soft handles",
                              part->mesh->input_vertex(pin.vertex), (target - here).norm()));
    spec.pins.push_back({pin.vertex, asked.boundary == BoundaryCondition::Fixed ? here : target});
  }
  for (const Pin& handle : asked.handles)
    spec.handles.push_back(
        {handle.vertex, handle.target.value_or(uv.segment<2>(2 * handle.vertex))});
  const bool free = !part->ranks().any(!spec.pins.empty() || !spec.handles.empty()) &&
                    spec.boundary == BoundaryCondition::Free;
  const Vector2 gauge = gauge_position(*part, uv);
  if (free) origin_ = gauge;
  if (origin_.norm() * scale_ <= kLargestOffset) destination_ = origin_;
  for (auto* points : {&spec.pins, &spec.handles})
    for (FixedPoint& p : *points) p.position = (p.position - origin_) * scale_;
  x_ = translated(uv, -origin_) * scale_;
}

Vec StartOfPart::in_model_units(Vec x) const { return translated(x / scale_, destination_); }

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
