#include "majorant/parametrization/solve/pins.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/mesh/mesh_messages.h"
#include "majorant/mesh/refusal.h"

namespace majorant {
namespace {

// The distance at which a pin is met, relative to the largest coordinate: targets in files have ten
// digits.
constexpr double kPinned = 1e-9;

void require_vertex(const SurfaceMesh& mesh, const Pin& pin) {
  if (pin.vertex < 0 || pin.vertex >= mesh.vertex_count())
    throw InvalidArgument(
        fmt::format("{}pinned vertex {} does not exist", message_prefix(mesh), pin.vertex));
}

bool contains(const std::vector<FixedPoint>& points, Index node) {
  return std::any_of(points.begin(), points.end(),
                     [&](const FixedPoint& p) { return p.node == node; });
}

}  // namespace

MapOptions with_targets(const BezierMap& start, MapOptions options) {
  for (auto* points : {&options.pins, &options.handles})
    for (Pin& p : *points) {
      require_vertex(start.mesh(), p);
      if (!p.target) p.target = start.control_points().segment<2>(2 * p.vertex);
    }
  return options;
}

double pin_tolerance(VecIn start) { return pin_tolerance(start.cwiseAbs().maxCoeff()); }
double pin_tolerance(double largest_coordinate) { return kPinned * largest_coordinate; }

bool meets_pins(const BezierMap& start, const std::vector<Pin>& pins) {
  const double tolerance = pin_tolerance(start.control_points());
  return std::all_of(pins.begin(), pins.end(), [&](const Pin& p) {
    return (*p.target - start.control_points().segment<2>(2 * p.vertex)).stableNorm() <= tolerance;
  });
}

void require_pinned_once(const SurfaceMesh& mesh, const std::vector<Pin>& pins) {
  std::vector<char> is_pinned(to_size(mesh.vertex_count()), 0);
  for (const Pin& p : pins)
    if (std::exchange(is_pinned[p.vertex], 1))
      throw Error(ErrorKind::Unsupported,
                  fmt::format("{}vertex {} is pinned twice; pin it once", message_prefix(mesh),
                              mesh.input_vertex(p.vertex)));
}

std::vector<FixedPoint> place_pins(const SurfaceMesh& mesh, const std::vector<Pin>& pins,
                                   const Vec& start, double tolerance,
                                   const std::function<bool(Index vertex)>& is_held) {
  std::vector<FixedPoint> points;
  for (const Pin& pin : pins) {
    require_vertex(mesh, pin);
    const Vector2 here = start.segment<2>(2 * pin.vertex);
    const Vector2 target = pin.target.value_or(here);
    const double distance = (target - here).stableNorm();
    if (distance > tolerance)
      throw Refusal(
          ErrorKind::Infeasible, mesh.file(),
          fmt::format(
              "{}the pin of vertex {} is {:.6g} away from ({}, {}), its place in the initial map; ",
              message_prefix(mesh), mesh.input_vertex(pin.vertex), distance, here.x(), here.y()),
          Hint::LeavePin, ", or use soft handles");
    points.push_back({pin.vertex, is_held(pin.vertex) ? here : target});
  }
  require_pinned_once(mesh, pins);
  return points;
}

std::vector<FixedPoint> place_handles(const SurfaceMesh& mesh, const std::vector<Pin>& handles,
                                      const std::vector<FixedPoint>& pins, const Vec& start,
                                      double scale) {
  std::vector<FixedPoint> points;
  for (const Pin& handle : handles) {
    require_vertex(mesh, handle);
    if (contains(points, handle.vertex) || contains(pins, handle.vertex))
      throw Error(ErrorKind::Unsupported,
                  fmt::format("{}vertex {} has two handles, or a pin and a handle; keep one",
                              message_prefix(mesh), mesh.input_vertex(handle.vertex)));
    const Vector2 here = start.segment<2>(2 * handle.vertex);
    points.push_back({handle.vertex, handle.target.value_or(here)});
    const double distance = ((points.back().position - here) * scale).stableNorm();
    if (!(distance <= kLargestFactor))
      throw Error(ErrorKind::Unsupported,
                  fmt::format("{}the target of vertex {} is {:.3g} sizes of the model away from "
                              "it, too far to compute with; give a nearer one",
                              message_prefix(mesh), mesh.input_vertex(handle.vertex), distance));
  }
  return points;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
