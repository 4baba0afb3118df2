#include "majorant/parametrization/solve/normalized_start.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "majorant/constraints/constraints.h"
#include "majorant/framework/elimination.h"
#include "majorant/framework/error.h"
#include "majorant/framework/rounding.h"
#include "majorant/maps/map_part.h"
#include "majorant/maps/rest_shapes_of.h"
#include "majorant/mesh/mesh_messages.h"
#include "majorant/mesh/refusal.h"
#include "majorant/parametrization/initialization/start.h"
#include "majorant/parametrization/solve/free_scale.h"
#include "majorant/parametrization/solve/pins.h"

namespace majorant {
namespace {

// Returns the power of two that scales the surface to a size of about 1, without rounding. The size
// is the largest extent along an axis. If that is 0, the triangles that stand for faces without
// area have one.
double scale_of(const SurfaceMesh& mesh, const Ranks& ranks) {
  std::array<double, 6> least;
  least.fill(std::numeric_limits<double>::infinity());
  for (const auto& p : mesh.positions().rowwise())
    for (std::size_t k = 0; k < 3; ++k) {
      least[k] = std::min(least[k], p[static_cast<Index>(k)]);
      least[3 + k] = std::min(least[3 + k], -p[static_cast<Index>(k)]);
    }
  ranks.min(least);
  double extent = 0;
  for (std::size_t k = 0; k < 3; ++k) extent = std::max(extent, -least[3 + k] - least[k]);
  const double size = extent > 0 ? extent : std::sqrt(ranks.sum(mesh.area()));
  return 1 / power_of_two(size, PowerOfTwo::Nearest);
}

void require_face_weights(const SurfaceMesh& mesh, const Vec& weights) {
  if (weights.size() == 0) return;
  if (weights.size() != mesh.face_count())
    throw InvalidArgument(fmt::format("{}{} face weights for {} faces: one each is needed",
                                      message_prefix(mesh), weights.size(), mesh.face_count()));
  const auto wrong = std::find_if_not(weights.begin(), weights.end(), is_usable_weight);
  if (wrong != weights.end())
    throw InvalidArgument(fmt::format("{}face weight [{}] is {:g}, {:g} to {:g} is needed",
                                      message_prefix(mesh), wrong - weights.begin(), *wrong,
                                      1 / kLargestFactor, kLargestFactor));
}

// Requires that the normalized map is injective as it is solved, at any size of the mesh. options:
// determine the remedy that the message names.
void require_injective(const BezierMap& map, const RestShapes& rest, const MapOptions& options) {
  const auto refuse = [&](const std::string& what) {
    throw Refusal(
        ErrorKind::Infeasible, map.mesh().file(),
        fmt::format("{}the initial map is not injective: {}; ", message_prefix(map.mesh()), what),
        options.initial ? Hint::OtherStartOrUnwrap : Hint::Unwrap);
  };
  const Verdict faces =
      LocalInjectivity(map.shared_space(), 2 * rest.measure).check(map.control_points());
  if (!faces.feasible)
    refuse(fmt::format("face {} ({} in all) is not positively oriented",
                       user_face(map.mesh(), faces.blocking.front()), faces.blocking.size()));
  const Verdict vertices =
      AngleSums(map.shared_space(), AngleSums::Vertices::Interior, map.shared_seams())
          .check(map.control_points());
  if (!vertices.feasible)
    refuse(fmt::format("it covers the neighbourhood of vertex {} more than once",
                       user_vertex(map.mesh(), vertices.blocking.front())));
}

// Returns for each edge the coordinate that is nearly constant along it.
std::vector<AlignedEdge> nearest_axes(const BezierMap& start, const std::vector<Index>& edges) {
  const SurfaceMesh& mesh = start.mesh();
  const auto edge = [&](Index h) -> Vector2 {
    return start.control_points().segment<2>(2 * mesh.to_vertex(h)) -
           start.control_points().segment<2>(2 * mesh.from_vertex(h));
  };
  double mean = 0;
  for (Index h = 0; h < mesh.half_edge_count(); ++h) mean += edge(h).norm();
  mean /= mesh.half_edge_count();
  std::vector<AlignedEdge> aligned;
  for (const Index h : edges) {
    if (h < 0 || h >= mesh.half_edge_count())
      throw InvalidArgument(
          fmt::format("{}aligned half-edge {} does not exist", message_prefix(mesh), h));
    const Vector2 off = edge(h).cwiseAbs();
    aligned.push_back({h, off.x() <= off.y() ? 0 : 1});
    if (!(off.minCoeff() <= kSeamTolerance * mean))
      throw Error(
          ErrorKind::Infeasible,
          fmt::format("{}edge ({}, {}) cannot stay parallel to an axis: the initial map "
                      "has it {:.3g} edge lengths off (tolerance {:g}); give another start "
                      "or do not align it",
                      message_prefix(mesh), user_vertex(mesh, mesh.from_vertex(h)),
                      user_vertex(mesh, mesh.to_vertex(h)), off.minCoeff() / mean, kSeamTolerance));
  }
  return aligned;
}

// Returns the closest map that has these edges along their axes and keeps its seams.
BezierMap aligned_map(const BezierMap& start, const std::vector<AlignedEdge>& aligned) {
  ConstraintRows rows;
  if (!start.seams().empty())
    SeamlessConstraint(start.shared_space(), start.shared_seams()).append_rows(rows);
  AxisAlignment(start.shared_space(), aligned).append_rows(rows);
  const Elimination elimination(2 * start.space().node_count(), rows);
  Vec x;
  elimination.expand(elimination.project(start.control_points()), x);
  return start.with(start.shared_space(), std::move(x));
}

double largest_distance(const Vec& a, const Vec& b) {
  double largest = 0;
  for (Index k = 0; k < a.size(); k += 2)
    largest = std::max(largest, (a.segment<2>(k) - b.segment<2>(k)).norm());
  return largest;
}

// Returns the position of the vertex that holds a free map. With several ranks only its owner
// provides it.
Vector2 gauge_position(const MapSpecification& spec, const BezierTriangleSpace& space,
                       const std::vector<Index>& gauge, const Vec& uv) {
  if (!spec.part) return uv.segment<2>(2 * gauge.front());
  std::array<double, 2> sum{};
  const auto unknowns = spec.part->unknowns(space);
  for (const Index v : gauge)
    if (unknowns->owns(2 * v)) sum = {uv[2 * v], uv[2 * v + 1]};
  spec.part->ranks().sum(sum);
  return {sum[0], sum[1]};
}

Vec translated(Vec x, const Vector2& by) {
  for (Index k = 0; k < x.size(); k += 2) x.segment<2>(k) += by;
  return x;
}

}  // namespace

void NormalFrame::move_origin(const Vector2& to, BoundaryCondition boundary) {
  origin = to;
  if (to.norm() * scale <= kMaxOriginOffset || boundary == BoundaryCondition::Fixed)
    destination = to;
}

void NormalFrame::normalize(std::vector<FixedPoint>& points) const {
  for (FixedPoint& p : points) p.position = (p.position - origin) * scale;
}

Vec NormalFrame::normalized(const Vec& uv) const { return translated(uv, -origin) * scale; }

Vec NormalFrame::in_model_units(const Vec& x) const { return translated(x / scale, destination); }

void require_face_data(const SurfaceMesh& mesh, const MapOptions& options) {
  require_face_weights(mesh, options.face_weight);
  for (const WeightedEnergy& e : options.energy) {
    require_face_weights(mesh, e.face_weight);
    const DensityTraits& traits = e.make.traits();
    if (traits.elements.value_or(mesh.face_count()) != mesh.face_count())
      throw InvalidArgument(fmt::format("{}the energy '{}' has data for {} faces, the mesh has {}",
                                        message_prefix(mesh), traits.name, *traits.elements,
                                        mesh.face_count()));
  }
}

double normal_scale(const SurfaceMesh& mesh) { return scale_of(mesh, *one_process()); }

NormalizedStart::NormalizedStart(const BezierMap& given, const MapOptions& options, Origin origin,
                                 std::shared_ptr<const MapPart> part,
                                 std::shared_ptr<const RestShapes> rest)
    : map_(given), specification_(options) {
  MapSpecification& spec = specification_;
  spec.part = std::move(part);
  const Ranks& ranks = ranks_of(spec);
  frame_.scale = scale_of(given.mesh(), ranks);
  require_face_data(given.mesh(), options);
  spec.aligned = nearest_axes(given, options.aligned);
  const BezierMap start = spec.aligned.empty() ? given : aligned_map(given, spec.aligned);
  moved_ = largest_distance(given.control_points(), start.control_points());
  const SurfaceMesh& mesh = start.mesh();
  const Vec& uv = start.control_points();
  spec.rest =
      rest ? std::move(rest) : std::make_shared<const RestShapes>(rest_shapes(mesh, frame_.scale));
  spec.seams = start.shared_seams();
  const bool tied = !start.seams().empty() || !options.aligned.empty();
  std::vector<Index> fixed;  // sorted
  if (options.boundary == BoundaryCondition::Fixed) fixed = boundary_of(spec, start.space());
  const double largest = ranks.max(uv.size() > 0 ? uv.cwiseAbs().maxCoeff() : 0);
  spec.pins = place_pins(mesh, options.pins, uv, pin_tolerance(largest), [&](Index v) {
    return tied || std::binary_search(fixed.begin(), fixed.end(), v);
  });
  spec.handles = place_handles(mesh, options.handles, spec.pins, uv, frame_.scale);
  if (!spec.part) require_scale(options, start);
  // If nothing holds the map, its first gauge vertex moves to the origin.
  const auto gauge = gauge_vertices(spec, start.space());
  const bool held = ranks.any(!spec.pins.empty() || !spec.handles.empty());
  if (ranks.any(!gauge.empty()) && !held && origin == Origin::Free)
    frame_.move_origin(gauge_position(spec, start.space(), gauge, uv), spec.boundary);
  for (auto* points : {&spec.pins, &spec.handles}) frame_.normalize(*points);
  map_ = start.with(start.shared_space(), frame_.normalized(uv));
  if (!spec.part) require_injective(map_, *spec.rest, options);
}

BezierMap NormalizedStart::in_model_units(const BezierMap& normalized) const {
  return normalized.with(normalized.shared_space(),
                         frame_.in_model_units(normalized.control_points()));
}

BezierMesh NormalizedStart::in_model_units(BezierMesh normalized) const {
  for (Index k = 0; k < normalized.points.cols(); ++k)
    normalized.points.col(k) =
        (normalized.points.col(k) / frame_.scale).array() + frame_.destination[k % 2];
  return normalized;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
