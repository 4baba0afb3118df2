#include "majorant/parametrization/drive/internal/normalized_start.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "majorant/constraints/axis_alignment.h"
#include "majorant/constraints/seamless_constraint.h"
#include "majorant/framework/error.h"
#include "majorant/framework/internal/elimination.h"
#include "majorant/mesh/internal/mesh_words.h"
#include "majorant/parametrization/drive/internal/free_scale.h"
#include "majorant/parametrization/drive/internal/reach_pins.h"
#include "majorant/parametrization/maps/rest_shapes_of.h"
#include "majorant/parametrization/starts/texture_seams.h"

namespace majorant {
namespace {

// The optimizer works on a surface of size about 1: a power of two, so that scaling is exact.
double normalizing_scale(const SurfaceMesh& mesh) {
  const Eigen::RowVector3d extent =
      mesh.positions().colwise().maxCoeff() - mesh.positions().colwise().minCoeff();
  // All vertices at one place: the triangles that stand for such faces have a size.
  const double size = extent.maxCoeff() > 0 ? extent.maxCoeff() : std::sqrt(mesh.area());
  return std::exp2(-std::round(std::log2(size)));
}

void require_face_weights(const SurfaceMesh& mesh, const Vec& weights) {
  if (weights.size() == 0) return;
  if (weights.size() != mesh.face_count() ||
      !std::all_of(weights.begin(), weights.end(), is_usable_weight))
    throw InvalidArgument(
        fmt::format("{}face weights must be one number in {:g}..{:g} for each face", opening(mesh),
                    1 / kLargestFactor, kLargestFactor));
}

void require_vertex(const SurfaceMesh& mesh, const Pin& pin) {
  if (pin.vertex < 0 || pin.vertex >= mesh.vertex_count())
    throw InvalidArgument(
        fmt::format("{}pinned vertex {} does not exist", opening(mesh), pin.vertex));
}

bool contains(const std::vector<FixedPoint>& points, Index node) {
  return std::any_of(points.begin(), points.end(),
                     [&](const FixedPoint& p) { return p.node == node; });
}

bool on_boundary(const SurfaceMesh& mesh, Index vertex) {
  return std::any_of(
      mesh.boundary_loops().begin(), mesh.boundary_loops().end(),
      [&](const auto& loop) { return std::find(loop.begin(), loop.end(), vertex) != loop.end(); });
}

// Soft handles may be anywhere that numbers reach. scale: to model sizes.
std::vector<FixedPoint> place_handles(const SurfaceMesh& mesh, const std::vector<Pin>& handles,
                                      const std::vector<FixedPoint>& pins, const Vec& start,
                                      double scale) {
  std::vector<FixedPoint> points;
  for (const Pin& handle : handles) {
    require_vertex(mesh, handle);
    if (contains(points, handle.vertex) || contains(pins, handle.vertex))
      throw Error(ErrorKind::Unsupported,
                  fmt::format("{}vertex {} has two handles, or a pin and a handle; keep one",
                              opening(mesh), mesh.input_vertex(handle.vertex)));
    const Vector2 here = start.segment<2>(2 * handle.vertex);
    points.push_back({handle.vertex, handle.target.value_or(here)});
    const double distance = ((points.back().position - here) * scale).stableNorm();
    if (!(distance <= kLargestFactor))
      throw Error(ErrorKind::Unsupported,
                  fmt::format("{}the target of vertex {} is {:.3g} sizes of the model away from "
                              "it, too far to compute with; give a nearer one",
                              opening(mesh), mesh.input_vertex(handle.vertex), distance));
  }
  return points;
}

// Pins as fixed points: a target must be where the start has the vertex, up to rounding, because
// the solver moves along maps that satisfy the constraints.
std::vector<FixedPoint> place_pins(const SurfaceMesh& mesh, const Seams& seams,
                                   const MapOptions& asked, const Vec& start) {
  const double tolerance = pin_tolerance(start);
  std::vector<FixedPoint> points;
  for (const Pin& pin : asked.pins) {
    require_vertex(mesh, pin);
    const Vector2 here = start.segment<2>(2 * pin.vertex);
    const Vector2 target = pin.target.value_or(here);
    const double distance = (target - here).stableNorm();
    if (distance > tolerance)
      throw Error(
          ErrorKind::Infeasible,
          fmt::format("{}the pin of vertex {} is {:.6g} away from the initial map ({}, {}); "
                      "{}, or use soft handles",
                      opening(mesh), mesh.input_vertex(pin.vertex), distance, here.x(), here.y(),
                      either(mesh,
                             "hold it there with \"target\": \"initial\", start from a map that "
                             "meets the pins with --init input",
                             "leave out its target, start from a map that meets the pins")));
    // A fixed boundary, a seam or an aligned edge may already say the same, up to rounding.
    const bool held = !seams.empty() || !asked.aligned.empty() ||
                      (asked.boundary == BoundaryCondition::Fixed && on_boundary(mesh, pin.vertex));
    points.push_back({pin.vertex, held ? here : target});
  }
  require_pinned_once(mesh, asked.pins);
  return points;
}

// Of the normalized map: as it is solved, whatever the size of the mesh. asked: what the map would
// have started from says what helps.
void require_injective(const BezierMap& map, const RestShapes& rest, const MapOptions& asked) {
  const std::string_view remedy =
      asked.initial ? either(map.mesh(), "leave out --init input, or use `majorant unwrap`",
                             "leave out MapOptions::initial, or use unwrap()")
                    : either(map.mesh(), "use `majorant unwrap`", "use unwrap()");
  const Verdict faces =
      LocalInjectivity(map.shared_space(), 2 * rest.measure).check(map.control_points());
  if (!faces.feasible)
    throw Error(
        ErrorKind::Infeasible,
        fmt::format("{}the initial map is not injective: face {} ({} in all) is not positively "
                    "oriented; {}",
                    opening(map.mesh()), told_face(map.mesh(), faces.blocking.front()),
                    faces.blocking.size(), remedy));
  const Verdict vertices =
      AngleSums(map.shared_space(), AngleSums::Vertices::Interior, map.shared_seams())
          .check(map.control_points());
  if (!vertices.feasible)
    throw Error(ErrorKind::Infeasible,
                fmt::format("{}the initial map is not injective: it covers the neighbourhood of "
                            "vertex {} more than once; {}",
                            opening(map.mesh()), told_vertex(map.mesh(), vertices.blocking.front()),
                            remedy));
}

// The axis that each edge is nearer to: u is constant along it, or v.
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
      throw InvalidArgument(fmt::format("{}aligned half-edge {} does not exist", opening(mesh), h));
    const Vector2 off = edge(h).cwiseAbs();
    aligned.push_back({h, off.x() <= off.y() ? 0 : 1});
    if (!(off.minCoeff() <= kSeamTolerance * mean))
      throw Error(
          ErrorKind::Infeasible,
          fmt::format("{}edge ({}, {}) cannot stay parallel to an axis: the initial map "
                      "has it {:.3g} edge lengths off (tolerance {:g}); give another start "
                      "or do not align it",
                      opening(mesh), told_vertex(mesh, mesh.from_vertex(h)),
                      told_vertex(mesh, mesh.to_vertex(h)), off.minCoeff() / mean, kSeamTolerance));
  }
  return aligned;
}

// The closest map that has these edges along their axes and keeps its seams.
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

Vec translated(Vec x, const Vector2& by) {
  for (Index k = 0; k < x.size(); k += 2) x.segment<2>(k) += by;
  return x;
}

}  // namespace

void require_face_data(const SurfaceMesh& mesh, const MapObjective& asked) {
  require_face_weights(mesh, asked.face_weight);
  for (const WeightedEnergy& e : asked.energy) {
    require_face_weights(mesh, e.face_weight);
    const DensityTraits& traits = e.make.traits();
    if (traits.elements.value_or(mesh.face_count()) != mesh.face_count())
      throw InvalidArgument(fmt::format("{}the energy '{}' has data for {} faces, the mesh has {}",
                                        opening(mesh), traits.name, *traits.elements,
                                        mesh.face_count()));
  }
}

NormalizedStart::NormalizedStart(const BezierMap& given, const MapOptions& asked, Origin origin)
    : scale_(normalizing_scale(given.mesh())), map_(given) {
  require_face_data(given.mesh(), asked);
  MapSpecification& spec = specification_;
  static_cast<MapObjective&>(spec) = asked;
  spec.aligned = nearest_axes(given, asked.aligned);
  const BezierMap start = spec.aligned.empty() ? given : aligned_map(given, spec.aligned);
  moved_ = largest_distance(given.control_points(), start.control_points());
  spec.rest = rest_shapes(start.mesh(), scale_);
  spec.seams = start.shared_seams();
  spec.pins = place_pins(start.mesh(), start.seams(), asked, start.control_points());
  spec.handles =
      place_handles(start.mesh(), asked.handles, spec.pins, start.control_points(), scale_);
  require_scale(asked, start);
  // Where nothing holds the map, its first held vertex moves to the origin.
  if (const auto gauge = gauge_vertices(spec, start.space());
      origin == Origin::Free && !gauge.empty() && spec.pins.empty() && spec.handles.empty())
    origin_ = start.control_points().segment<2>(2 * gauge.front());
  if (origin_.norm() * scale_ <= kLargestOffset || spec.boundary == BoundaryCondition::Fixed)
    destination_ = origin_;
  for (auto* points : {&spec.pins, &spec.handles})
    for (FixedPoint& p : *points) p.position = (p.position - origin_) * scale_;
  map_ = start.with(start.shared_space(), translated(start.control_points(), -origin_) * scale_);
  require_injective(map_, spec.rest, asked);
}

BezierMap NormalizedStart::in_model_units(const BezierMap& normalized) const {
  return normalized.with(normalized.shared_space(),
                         translated(normalized.control_points() / scale_, destination_));
}

BezierMesh NormalizedStart::in_model_units(BezierMesh normalized) const {
  for (Index k = 0; k < normalized.points.cols(); ++k)
    normalized.points.col(k) = (normalized.points.col(k) / scale_).array() + destination_[k % 2];
  return normalized;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
