#include "majorant/mesh/internal/joined_places.h"

#include <algorithm>
#include <array>
#include <utility>

#include "majorant/mesh/connectivity.h"
#include "majorant/mesh/internal/equal_lists.h"

namespace majorant {
namespace {

// Classes of faces at the same positions, corner on corner: triangles with equal numbers, and
// triangles of polygons with equal numbers.
struct FacesByPlace {
  std::vector<Index> triangle, polygon;  // by triangle
};

FacesByPlace faces_by_place(const GivenTriangles& triangles) {
  IndexLists corners, polygons = triangles.polygons;
  for (Index f = 0; f < triangles.face_count(); ++f)
    corners.push_back({triangles.place(triangles.faces(f, 0)),
                       triangles.place(triangles.faces(f, 1)),
                       triangles.place(triangles.faces(f, 2))});
  for (Index& v : polygons.indices()) v = triangles.place(v);
  FacesByPlace numbers{classes_of_lists(std::move(corners)), {}};
  const std::vector<Index> of_polygon = classes_of_lists(std::move(polygons));
  for (const Index p : triangles.polygon) numbers.polygon.push_back(of_polygon[p]);
  return numbers;
}

}  // namespace

void join_places(const GivenTriangles& triangles, const std::vector<Index>& layer,
                 const IndexLists& crowded, GluedSides& glued, const StopCheck& stop) {
  if (triangles.first_at_place.empty()) return;
  const FacesByPlace numbers = faces_by_place(triangles);
  std::vector<char> is_crowded(glued.opposite.size(), 0);
  for (const Index h : crowded.indices()) is_crowded[h] = 1;
  const auto ends = [&](Index h) {
    const Index a = triangles.place(triangles.from(h)), b = triangles.place(triangles.to(h));
    const bool is_open = layer[face_of(h)] >= 0 && glued.opposite[h] < 0 && !is_crowded[h];
    return std::pair(is_open && a != b ? a : Index{-1}, b);
  };
  const auto may_meet = [&](Index h, Index o) {
    const Index f = face_of(h), g = face_of(o);
    return f != g && layer[f] == layer[g] &&
           triangles.place(triangles.from(h)) == triangles.place(triangles.to(o)) &&
           numbers.triangle[f] != numbers.triangle[g] &&
           (numbers.polygon[f] != numbers.polygon[g] ||
            triangles.polygon[f] == triangles.polygon[g]);
  };
  const PairOrder order = order_of_edges(static_cast<Index>(triangles.positions.size()),
                                         triangles.half_edge_count(), ends);
  std::size_t polls = 0;
  order.for_each_run([&](std::span<const PairOrder::Entry> sides) {
    const auto only_other = [&](Index h) {
      Index found = -1;
      for (const auto& [ignored, o] : sides) {
        if (!may_meet(h, o)) continue;
        if (found >= 0) return Index{-1};
        found = o;
      }
      return found;
    };
    for (std::size_t s = 0; s < sides.size() && sides.size() > 1; ++s) {
      stop.poll_at(polls++);
      const Index h = sides[s].number;
      if (glued.opposite[h] >= 0) continue;
      if (const Index o = only_other(h); o >= 0 && only_other(o) == h) glued.join(h, o);
    }
  });
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
