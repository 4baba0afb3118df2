#include "majorant/mesh/internal/large_polygon.h"

#include <fmt/format.h>

#include <algorithm>

#include "majorant/framework/error.h"
#include "majorant/mesh/constrained_delaunay.h"

namespace majorant {
namespace {

enum class Region { Unknown, Inside, Outside };
struct FaceMark {
  Region region = Region::Unknown;
};

using Delaunay = internal::ConstrainedDelaunay<int, FaceMark>;
using VertexHandle = Delaunay::Vertex_handle;
using FaceHandle = Delaunay::Face_handle;

[[noreturn]] void refuse(std::size_t corners) {
  throw Error(ErrorKind::Unsupported,
              fmt::format("a polygon of {} corners crosses or touches itself in its mean plane; "
                          "triangulate it first",
                          corners));
}

// The polygon's corners and edges.
Delaunay constrained(const std::vector<Vector2>& polygon, const StopCheck& stop) {
  Delaunay triangulation;
  std::vector<VertexHandle> vertices;
  FaceHandle near;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    stop.poll_at(k);
    vertices.push_back(triangulation.insert({polygon[k].x(), polygon[k].y()}, near));
    vertices.back()->info() = static_cast<int>(k);
    near = vertices.back()->face();
  }
  if (triangulation.number_of_vertices() != polygon.size()) refuse(polygon.size());
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    stop.poll_at(k);
    triangulation.insert_constraint(vertices[k], vertices[(k + 1) % polygon.size()]);
  }
  for (std::size_t k = 0; k < polygon.size(); ++k)  // not one that passes another corner
    if (!triangulation.is_edge(vertices[k], vertices[(k + 1) % polygon.size()]))
      refuse(polygon.size());
  return triangulation;
}

// Faces that are reached from the outside without crossing the polygon an odd number of times.
void mark_regions(Delaunay& triangulation) {
  triangulation.infinite_face()->info().region = Region::Outside;
  std::vector<FaceHandle> stack{triangulation.infinite_face()};
  while (!stack.empty()) {
    const FaceHandle face = stack.back();
    stack.pop_back();
    for (int k = 0; k < 3; ++k) {
      const FaceHandle next = face->neighbor(k);
      if (next->info().region != Region::Unknown) continue;
      const bool crosses = face->is_constrained(k);
      next->info().region =
          (face->info().region == Region::Inside) != crosses ? Region::Inside : Region::Outside;
      stack.push_back(next);
    }
  }
}

}  // namespace

std::vector<std::array<int, 3>> triangulate_large_polygon(const std::vector<Vector2>& polygon,
                                                          const StopCheck& stop) {
  const auto finite = [](const Vector2& p) { return p.allFinite(); };
  if (!std::all_of(polygon.begin(), polygon.end(), finite)) refuse(polygon.size());
  std::vector<std::array<int, 3>> triangles;
  try {
    Delaunay triangulation = constrained(polygon, stop);
    mark_regions(triangulation);
    for (const FaceHandle face : triangulation.finite_face_handles())
      if (face->info().region == Region::Inside)
        triangles.push_back(
            {face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
  } catch (const Delaunay::Intersection_of_constraints_exception&) {
    refuse(polygon.size());
  }
  if (triangles.size() + 2 != polygon.size()) refuse(polygon.size());
  return triangles;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
