#include "majorant/quads/internal/quad_distances.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <atomic>
#include <span>

#include "majorant/framework/parallel.h"
#include "majorant/mesh/nearest_point.h"
#include "majorant/quads/internal/surface_below.h"

namespace majorant {
namespace {

// The progress reported once corners are measured, and once distances to and from the surface are.
constexpr double kCornersShare = 0.1, kToSurfaceShare = 0.5, kFromSurfaceShare = 0.9;
constexpr double kThird = 1.0 / 3;  // of a share: centroids, vertices and edges of quads

Points3 middles_of_quads(const QuadSurface& quads) {
  Points3 middles(quads.count(), 3);
  for (Index q = 0; q < quads.count(); ++q) {
    const std::array<Vector3, 4> p = quads.corners_of(q);
    middles.row(q) = (p[0] + p[1] + p[2] + p[3]) / 4;
  }
  return middles;
}

Points3 middles_of_edges(const QuadSurface& quads) {
  Points3 middles(quads.half_edge_count(), 3);
  Index rows = 0;
  for (Index h = 0; h < quads.half_edge_count(); ++h)
    if (quads.opposite[h] < h)
      middles.row(rows++) = (quads.point(quads.from(h)) + quads.point(quads.to(h))) / 2;
  middles.conservativeResize(rows, 3);
  return middles;
}

// Returns the nearest faces of each vertex; vertices without quads have none.
std::vector<NearestFaces> faces_near_vertices(const QuadSurface& quads, const SurfaceBelow& below,
                                              const StopCheck& share) {
  constexpr Index kVerticesOfTask = 256;
  const auto count = static_cast<Index>(quads.valence.size());
  std::vector<NearestFaces> near(quads.valence.size());
  std::atomic<std::size_t> done = 0;
  parallel_tasks((count + kVerticesOfTask - 1) / kVerticesOfTask, [&](Index task, int) {
    share.poll();
    Index likely = -1;
    const Index last = std::min(count, (task + 1) * kVerticesOfTask);
    for (Index v = task * kVerticesOfTask; v < last; ++v) {
      if (quads.valence[to_size(v)] == 0) continue;
      near[to_size(v)] = below.faces_near(quads.point(v), likely);
      likely = near[to_size(v)].faces.front();
    }
    share.advance(done += to_size(kVerticesOfTask), to_size(count));
  });
  return near;
}

// Returns the largest distance from samples of the surface to the quads.
double distance_from_surface(const QuadSurface& quads, const SurfaceMesh& surface,
                             const Points3& positions, const StopCheck& share) {
  Cells halves(2 * quads.count(), 3);
  for (Index q = 0; q < quads.count(); ++q) {
    const std::span<const Index> v = quads.mesh.polygons[q];
    halves.row(2 * q) << v[0], v[1], v[2];
    halves.row(2 * q + 1) << v[0], v[2], v[3];
  }
  Points3 points(static_cast<Index>(quads.mesh.positions.size()), 3);
  for (Index v = 0; v < static_cast<Index>(points.rows()); ++v) points.row(v) = quads.point(v);
  const SurfaceTree tree(points, halves);
  const Index faces = surface.face_count(), vertices = surface.vertex_count();
  Points3 samples(faces + vertices, 3);
  samples.topRows(vertices) = positions;
  for (Index f = 0; f < faces; ++f) {
    Vector3 sum = Vector3::Zero();
    for (int k = 0; k < 3; ++k) sum += positions.row(surface.faces()(f, k));
    samples.row(vertices + f) = sum / 3;
  }
  return tree.largest_distance(samples, 0, share);
}

}  // namespace

QuadDistances quad_distances(const QuadSurface& quads, const SurfaceMesh& surface,
                             const StopCheck& stop) {
  QuadDistances result;
  double& to_surface = result.hausdorff.to_surface;
  const SurfaceBelow below(surface);
  const StopCheck share = stop.between(kCornersShare, kToSurfaceShare);
  const std::vector<NearestPoint> nearest =
      below.tree().locate(middles_of_quads(quads), share.between(0, kThird));
  const std::vector<NearestFaces> near =
      faces_near_vertices(quads, below, share.between(kThird, 2 * kThird));
  for (const NearestPoint& p : nearest) to_surface = std::max(to_surface, p.distance);
  for (const NearestFaces& faces : near) to_surface = std::max(to_surface, faces.distance);
  to_surface = below.tree().largest_distance(middles_of_edges(quads), to_surface,
                                             share.between(2 * kThird, 1));
  for (Index q = 0; q < quads.count(); ++q) {
    stop.poll_at(to_size(q));
    const std::span<const Index> v = quads.mesh.polygons[q];
    if (below.is_turned(quads.corners_of(q), nearest[to_size(q)],
                        {&near[to_size(v[0])], &near[to_size(v[1])], &near[to_size(v[2])],
                         &near[to_size(v[3])]}))
      result.turned.push_back(q);
  }
  result.hausdorff.from_surface = distance_from_surface(
      quads, surface, below.positions(), stop.between(kToSurfaceShare, kFromSurfaceShare));
  return result;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
