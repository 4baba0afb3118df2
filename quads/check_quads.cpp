#include "majorant/quads/check_quads.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "majorant/framework/argument_check.h"
#include "majorant/framework/error.h"
#include "majorant/mesh/connectivity.h"
#include "majorant/mesh/geometry.h"
#include "majorant/quads/exact_normals.h"
#include "majorant/quads/internal/curve_match.h"
#include "majorant/quads/internal/quad_distances.h"
#include "majorant/quads/internal/quad_surface.h"

namespace majorant {
namespace {

double degrees(double radians) { return radians * 180 / std::numbers::pi; }

void require_sound_vertices(const PolygonMesh& quads) {
  const auto vertices = static_cast<Index>(quads.positions.size());
  for (const Vector3& p : quads.positions)
    if (!p.allFinite()) throw InvalidArgument("check_quads: a position is not finite");
  for (const Index v : quads.polygons.indices()) require_index("check_quads: vertex", v, vertices);
}

std::vector<Topology> topologies_of(const QuadSurface& quads) {
  return component_topologies<4>(static_cast<Index>(quads.valence.size()), quads.opposite,
                                 [&](Index h) { return quads.from(h); });
}

void count(const QuadSurface& quads, QuadCheck& check) {
  Topology& t = check.topology;
  for (const Topology& component : topologies_of(quads)) {
    t.vertices += component.vertices;
    t.edges += component.edges;
    t.faces += component.faces;
    t.components += component.components;
    t.boundary_loops += component.boundary_loops;
  }
  for (std::size_t v = 0; v < quads.valence.size(); ++v)
    check.irregular += quads.valence[v] > 0 && !quads.is_border[v] && quads.valence[v] != 4;
}

void measure_corners(const QuadSurface& quads, const StopCheck& stop, QuadCheck& check) {
  double deviation = 0, least = std::numeric_limits<double>::infinity(), sum = 0;
  for (Index q = 0; q < quads.count(); ++q) {
    stop.poll_at(to_size(q));
    const std::array<Vector3, 4> p = quads.corners_of(q);
    bool is_folded = false;
    double least_sine = std::numeric_limits<double>::infinity();
    const Vector3 n = (p[2] - p[0]).cross(p[3] - p[1]).stableNormalized();
    for (std::size_t k = 0; k < 4; ++k) {
      const Vector3 &a = p[k], &b = p[(k + 1) % 4], &d = p[(k + 3) % 4];
      is_folded |= sign_of_normals({a, b}, {a, d}, {p[0], p[2]}, {p[1], p[3]}) <= 0;
      const Vector3 along = (b - a).stableNormalized(), back = (d - a).stableNormalized();
      least_sine = std::min(least_sine, along.cross(back).dot(n));
      deviation += std::abs(degrees(std::atan2(along.cross(back).norm(), along.dot(back))) - 90);
    }
    if (is_folded) check.folded.push_back(q);
    least = std::min(least, least_sine);
    sum += least_sine;
  }
  check.min_scaled_jacobian = least;
  check.mean_scaled_jacobian = sum / quads.count();
  check.angle_deviation = deviation / (4.0 * quads.count());
  if (!check.folded.empty())
    check.defects.push_back(listed("quad is folded", "quads are folded", check.folded));
}

// Returns the Euler characteristic and the number of border loops of every component, sorted.
std::vector<std::pair<Index, Index>> shapes_of(const std::vector<Topology>& components) {
  std::vector<std::pair<Index, Index>> shapes;
  for (const Topology& t : components)
    shapes.emplace_back(t.euler_characteristic(), t.boundary_loops);
  std::sort(shapes.begin(), shapes.end());
  return shapes;
}

void compare_topologies(const QuadSurface& quads, const SurfaceMesh& surface, QuadCheck& check) {
  const Topology &t = check.topology, &s = surface.topology();
  const std::size_t before = check.defects.size();
  const auto compare_counts = [&](std::string_view what, Index ours, Index theirs) {
    if (ours != theirs)
      check.defects.push_back(
          fmt::format("{} of the quads: {}, of the surface: {}", what, ours, theirs));
  };
  compare_counts("Euler characteristic", t.euler_characteristic(), s.euler_characteristic());
  compare_counts("components", t.components, s.components);
  compare_counts("border loops", t.boundary_loops, s.boundary_loops);
  if (check.defects.size() > before) return;
  const std::vector<Topology> of_surface = component_topologies<3>(
      surface.vertex_count(), surface.opposites(), [&](Index h) { return surface.from_vertex(h); });
  if (shapes_of(topologies_of(quads)) != shapes_of(of_surface))
    check.defects.push_back(
        "Euler characteristics and border loops are those of the surface in sum, not component "
        "by component");
}

void compare(const QuadSurface& quads, const SurfaceMesh& surface,
             const std::vector<char>& features, const StopCheck& stop, double border_turn,
             QuadCheck& check) {
  compare_topologies(quads, surface, check);
  QuadDistances distances = quad_distances(quads, surface, stop);
  check.hausdorff = distances.hausdorff;
  check.turned = std::move(distances.turned);
  if (!check.turned.empty())
    check.defects.push_back(listed("quad is turned over", "quads are turned over", check.turned));
  const Index loops = check.topology.boundary_loops;
  if (loops == surface.topology().boundary_loops && loops > 0)
    match_borders(quads, surface, border_turn, stop, check.defects);
  if (features.empty()) return;
  FeatureMatch match = match_features(quads, surface, features, stop, check.defects);
  check.feature_lines = match.lines;
  check.uncovered = std::move(match.uncovered);
}

}  // namespace

QuadCheck check_quads(const PolygonMesh& quads, const SurfaceMesh* surface,
                      const std::vector<char>& features, const StopCheck& stop,
                      double border_turn) {
  if (surface && !features.empty() && features.size() != to_size(surface->half_edge_count()))
    throw InvalidArgument("check_quads: features must have 3 #F entries");
  require_sound_vertices(quads);
  QuadCheck check;
  check.count = static_cast<Index>(quads.polygons.size());
  const std::optional<QuadSurface> manifold = quad_surface(quads, check.defects);
  if (!manifold) return check;
  check.is_surface = true;
  count(*manifold, check);
  measure_corners(*manifold, stop, check);
  if (surface) compare(*manifold, *surface, features, stop, border_turn, check);
  return check;
}

void require_near(QuadCheck& check, const SurfaceMesh& surface, double max_distance) {
  if (!check.is_surface) return;
  const double size = diagonal(surface.positions());
  const auto judge = [&](double distance, std::string_view what) {
    if (!(distance <= max_distance * size))
      check.defects.push_back(
          fmt::format("{}: up to {:.3g}, {:.3g} % of the surface's diagonal, more than {:g} %",
                      what, distance, 100 * distance / size, 100 * max_distance));
  };
  judge(check.hausdorff.to_surface, "quads are away from the surface");
  judge(check.hausdorff.from_surface, "the surface is away from the quads");
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
