#include "majorant/quads/internal/smoothing.h"

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <string>

#include "majorant/quads/check_quads.h"
#include "mesh/test_meshes.h"

namespace majorant {
namespace {

constexpr Index kSquares = 4;  // quads along each side of a square

PolygonMesh quads_of_square() {
  PolygonMesh quads;
  quads.positions = grid(kSquares).positions;
  for (Index j = 0; j < kSquares; ++j)
    for (Index i = 0; i < kSquares; ++i) {
      const Index a = j * (kSquares + 1) + i, d = a + kSquares + 1;
      quads.polygons.push_back({a, a + 1, d + 1, d});
    }
  return quads;
}

// All vertices of the border are corners.
HeldVertices holding_border(const SurfaceMesh& surface) {
  HeldVertices held;
  held.points.resize(to_size(surface.vertex_count()));
  held.border_turn = 1e-9;
  for (Index h = 0; h < surface.half_edge_count(); ++h)
    if (surface.opposite(h) < 0) held.points[surface.from_vertex(h)].half_edge = h;
  return held;
}

// The vertices inside of a square, turned or mirrored against its border: no step of one vertex
// makes the corners around it better, those of all together do.
TEST(Smoothing, UntanglesByMovingSeveralVertices) {
  const std::map<std::string, std::function<Vector3(const Vector3&)>> moves = {
      {"turned by 180 degrees", [](const Vector3& p) { return Vector3(1 - p.x(), 1 - p.y(), 0); }},
      {"turned by 90 degrees", [](const Vector3& p) { return Vector3(p.y(), 1 - p.x(), 0); }},
      {"mirrored", [](const Vector3& p) { return Vector3(1 - p.x(), p.y(), 0); }}};
  const SurfaceMesh surface = SurfaceMesh::from_polygons(grid(kSquares));
  const std::vector<char> is_border = surface.boundary_flags();
  for (const auto& [name, move] : moves) {
    SCOPED_TRACE(name);
    PolygonMesh quads = quads_of_square();
    for (std::size_t v = 0; v < quads.positions.size(); ++v)
      if (!is_border[v]) quads.positions[v] = move(quads.positions[v]);
    EXPECT_FALSE(check_quads(quads, &surface).folded.empty());
    smooth_quads(quads, surface, holding_border(surface));
    EXPECT_TRUE(check_quads(quads, &surface).is_valid());
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
