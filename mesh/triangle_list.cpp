#include "majorant/mesh/triangle_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "majorant/framework/argument_check.h"
#include "majorant/framework/error.h"
#include "majorant/mesh/exact_predicates.h"
#include "majorant/mesh/mesh_messages.h"
#include "majorant/mesh/triangulate_polygon.h"

namespace majorant {
namespace {

using Triangles = std::vector<std::array<int, 3>>;

// Returns whether all triangles of a polygon have the same orientation in the plane, right or
// wrong.
bool agree(const Triangles& triangles, const std::vector<Vector2>& corners) {
  int sum = 0;
  for (const auto& t : triangles) sum += orientation(corners[t[0]], corners[t[1]], corners[t[2]]);
  return to_size(std::abs(sum)) == triangles.size();
}

Triangles fan(std::size_t corners) {
  Triangles triangles;
  for (int k = 1; k + 1 < static_cast<int>(corners); ++k) triangles.push_back({0, k, k + 1});
  return triangles;
}

bool is_textured(const PolygonMesh& input, Index p) {
  return to_size(p) < input.polygon_texcoords.size() &&
         input.polygon_texcoords[p].size() == input.polygons[p].size();
}

}  // namespace

Triangles triangles_of(const PolygonMesh& input, Index p, Crossing crossing,
                       const StopCheck& stop) {
  const auto& polygon = input.polygons[p];
  if (polygon.size() == 3) return {{0, 1, 2}};
  std::vector<Vector3> in_space, in_plane;
  for (const Index v : polygon) in_space.push_back(input.positions[v]);
  Triangles of_shape;
  try {
    of_shape = triangulate_polygon(in_space, stop);
  } catch (const Error& e) {
    if (crossing == Crossing::Refused) throw Error(e.kind(), face_place(input, p) + e.what());
    of_shape = fan(polygon.size());
  }
  if (!is_textured(input, p)) return of_shape;
  std::vector<Vector2> uv;
  for (const Index t : input.polygon_texcoords[p]) {
    uv.push_back(input.texcoords[t]);
    in_plane.emplace_back(uv.back().x(), uv.back().y(), 0);
  }
  if (agree(of_shape, uv)) return of_shape;
  try {
    const Triangles of_image = triangulate_polygon(in_plane, stop);
    return agree(of_image, uv) ? of_image : of_shape;
  } catch (const Error&) {
    return of_shape;
  }
}

TriangleList triangulate(const PolygonMesh& input, Crossing crossing, const StopCheck& stop) {
  counted("vertices", input.positions.size(), 3);
  TriangleList list;
  list.triangles.reserve(input.polygons.size());
  list.polygon.reserve(input.polygons.size());
  list.corners.reserve(input.polygons.size());
  const auto add = [&](Index p, const std::array<int, 3>& corners) {
    const auto& polygon = input.polygons[p];
    list.triangles.push_back({polygon[corners[0]], polygon[corners[1]], polygon[corners[2]]});
    list.polygon.push_back(p);
    list.corners.push_back(corners);
  };
  for (Index p = 0; p < static_cast<Index>(input.polygons.size()); ++p) {
    stop.poll_at(to_size(p));
    if (input.polygons[p].size() == 3)
      add(p, {0, 1, 2});
    else
      for (const auto& t : triangles_of(input, p, crossing, stop)) add(p, t);
  }
  counted("triangles", list.triangles.size(), 3);
  return list;
}

void place_texcoords(const PolygonMesh& input, const TriangleList& list, SurfaceParts& parts) {
  if (input.polygon_texcoords.indices().empty()) return;
  const auto count = static_cast<Index>(list.triangles.size());
  parts.corner_texcoords.setConstant(count, 6, std::numeric_limits<double>::quiet_NaN());
  parts.texcoord_ids.setConstant(count, 3, -1);
  for (Index f = 0; f < count; ++f) {
    if (!is_textured(input, list.polygon[f])) continue;
    for (Index k = 0; k < 3; ++k) {
      const auto& corners = input.polygon_texcoords[list.polygon[f]];
      const Index vt = corners[list.corners[f][k]];
      parts.texcoord_ids(f, k) = vt;
      parts.corner_texcoords.row(f).segment<2>(2 * k) = input.texcoords[vt];
    }
  }
}

std::string face_place(const PolygonMesh& input, Index polygon) {
  const auto p = to_size(polygon);
  if (p < input.polygon_lines.size() && !input.file.empty())
    return fmt::format("{}:{}: face {}: ", input.file, input.polygon_lines[p], polygon + 1);
  return fmt::format("{}face {}: ", message_prefix(input.file), shown_number(input.file, polygon));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
