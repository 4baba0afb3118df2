#include "majorant/mesh/internal/large_polygon.h"

#include <fmt/format.h>

#include <algorithm>

#include "majorant/framework/error.h"
#include "majorant/mesh/constrained_delaunay.h"

namespace majorant {
namespace {

// The values of FaceMark::region.
enum Region : int { Unknown, Inside, Outside };

[[noreturn]] void refuse(std::size_t corners) {
  throw Error(ErrorKind::Unsupported,
              fmt::format("a polygon of {} corners crosses or touches itself in its mean plane; "
                          "triangulate it first",
                          corners));
}

// Inserts the polygon's corners and edges.
void insert_polygon(ConstrainedDelaunay& delaunay, const std::vector<Vector2>& polygon,
                    const StopCheck& stop) {
  const auto following = [&](std::size_t k) {
    return static_cast<Index>(k + 1 == polygon.size() ? 0 : k + 1);
  };
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    stop.poll_at(k);
    delaunay.insert(polygon[k]);
  }
  if (to_size(delaunay.vertex_count()) != polygon.size() || delaunay.is_flat())
    refuse(polygon.size());
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    stop.poll_at(k);
    if (!delaunay.insert_constraint(static_cast<Index>(k), following(k))) refuse(polygon.size());
  }
  for (std::size_t k = 0; k < polygon.size(); ++k)  // not if it passes another corner
    if (!delaunay.find_edge(static_cast<Index>(k), following(k))) refuse(polygon.size());
}

// Marks as outside the faces that are reached from the outside across an even number of the
// polygon's edges.
void mark_regions(ConstrainedDelaunay& delaunay) {
  std::vector<ConstrainedDelaunay::Face> stack{delaunay.infinite_face()};
  delaunay.mark(stack.back()).region = Region::Outside;
  while (!stack.empty()) {
    const auto face = stack.back();
    stack.pop_back();
    for (int k = 0; k < 3; ++k) {
      const auto next = delaunay.neighbor(face, k);
      if (delaunay.mark(next).region != Region::Unknown) continue;
      const bool crosses = delaunay.is_constrained(face, k);
      const bool is_inside = (delaunay.mark(face).region == Region::Inside) != crosses;
      delaunay.mark(next).region = is_inside ? Region::Inside : Region::Outside;
      stack.push_back(next);
    }
  }
}

}  // namespace

std::vector<std::array<int, 3>> triangulate_large_polygon(const std::vector<Vector2>& polygon,
                                                          const StopCheck& stop) {
  const auto finite = [](const Vector2& p) { return p.allFinite(); };
  if (!std::all_of(polygon.begin(), polygon.end(), finite)) refuse(polygon.size());
  ConstrainedDelaunay delaunay;
  insert_polygon(delaunay, polygon, stop);
  mark_regions(delaunay);
  std::vector<std::array<int, 3>> triangles;
  for (const auto face : delaunay.finite_faces())
    if (delaunay.mark(face).region == Region::Inside)
      triangles.push_back(
          {delaunay.vertex(face, 0), delaunay.vertex(face, 1), delaunay.vertex(face, 2)});
  if (triangles.size() + 2 != polygon.size()) refuse(polygon.size());
  return triangles;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
