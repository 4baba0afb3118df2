#include "majorant/mesh/internal/crowded_edges.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "majorant/mesh/connectivity.h"

namespace majorant {
namespace {

// In radians around an edge: faces at a smaller angle lie on each other.
constexpr double kSameDirection = 1e-9;

// A side of an edge, with the direction of its face around the edge.
struct SideAround {
  double angle;
  Index half_edge;
  bool runs_along;
};

// Returns the sides of one edge, counterclockwise as seen along it from its smaller vertex.
std::vector<SideAround> sides_around(const GivenTriangles& triangles,
                                     const std::vector<Index>& sides) {
  const std::vector<Vector3>& positions = triangles.positions;
  const Index low = std::min(triangles.from(sides[0]), triangles.to(sides[0]));
  const Index high = std::max(triangles.from(sides[0]), triangles.to(sides[0]));
  const Vector3 axis = (positions[high] - positions[low]).stableNormalized();
  const Vector3 x = axis.unitOrthogonal(), y = axis.cross(x);
  std::vector<SideAround> around;
  for (const Index h : sides) {
    const Vector3 into = positions[triangles.from(previous(h))] - positions[low];
    around.push_back({std::atan2(into.dot(y), into.dot(x)), h, triangles.from(h) == low});
  }
  std::sort(around.begin(), around.end(), [](const SideAround& a, const SideAround& b) {
    return std::tie(a.angle, a.half_edge) < std::tie(b.angle, b.half_edge);
  });
  return around;
}

// Returns whether as many sides run along the edge as against it, and no two faces lie on each
// other.
bool bound_wedges(const std::vector<SideAround>& around) {
  std::ptrdiff_t surplus = 0;
  for (std::size_t k = 0; k < around.size(); ++k) {
    surplus += around[k].runs_along ? 1 : -1;
    const double step = std::remainder(around[(k + 1) % around.size()].angle - around[k].angle,
                                       2 * std::numbers::pi);
    if (!(std::abs(step) > kSameDirection)) return false;
  }
  return surplus == 0;
}

// Joins the sides of one edge that bound the same wedges of the inside, which lies behind the
// faces. Seen along the edge, counterclockwise, the inside begins at a side of opposite direction
// and ends at a side of the same direction.
void pair_wedges(const GivenTriangles& triangles, const std::vector<Index>& sides,
                 GluedSides& glued) {
  if (sides.empty()) return;
  const std::vector<SideAround> around = sides_around(triangles, sides);
  if (!bound_wedges(around)) return;
  // Goes around twice, as with brackets: a wedge that begins before the first turn's start ends
  // after it.
  std::vector<Index> begun;
  for (std::size_t k = 0; k < 2 * around.size(); ++k) {
    const auto& [angle, h, runs_along] = around[k % around.size()];
    if (glued.opposite[h] >= 0) continue;
    if (!runs_along) {
      if (k < around.size()) begun.push_back(h);
    } else if (!begun.empty()) {
      glued.join(begun.back(), h);
      begun.pop_back();
    }
  }
}

}  // namespace

void pair_crowded_sides(const GivenTriangles& triangles, const IndexLists& crowded,
                        GluedSides& glued, const StopCheck& stop) {
  const std::vector<Index> piece = face_components(glued.opposite);
  const auto piece_of = [&](Index h) { return piece[face_of(h)]; };
  std::vector<char> is_crowded(glued.opposite.size(), 0), has_border(piece.size(), 0);
  for (const Index h : crowded.indices()) is_crowded[h] = 1;
  for (Index h = 0; h < triangles.half_edge_count(); ++h)
    if (glued.opposite[h] < 0 && !is_crowded[h]) has_border[piece_of(h)] = 1;
  for (std::size_t k = 0; k < crowded.size(); ++k) {
    stop.poll_at(k);
    std::vector<Index> sides(crowded[k].begin(), crowded[k].end());
    if (std::any_of(sides.begin(), sides.end(),
                    [&](Index h) { return has_border[piece_of(h)] != 0; }))
      continue;
    std::stable_sort(sides.begin(), sides.end(),
                     [&](Index a, Index b) { return piece_of(a) < piece_of(b); });
    std::vector<Index> others;
    for (std::size_t first = 0, last = 0; first < sides.size(); first = last) {
      const Index own = piece_of(sides[first]);
      while (last < sides.size() && piece_of(sides[last]) == own) ++last;
      if (last - first == 2 && triangles.from(sides[first]) == triangles.to(sides[first + 1]))
        glued.join(sides[first], sides[first + 1]);
      else
        for (std::size_t s = first; s < last; ++s) others.push_back(sides[s]);
    }
    pair_wedges(triangles, others, glued);
  }
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
