// Quads as a surface: the sides of its edges, border loops, quads of every vertex.
//
//   const PolygonMesh quads = read_mesh("spot_quads.obj");
//   std::vector<std::string> defects;
//   if (const std::optional<QuadSurface> surface = quad_surface(quads, defects))
//     std::cout << surface->loops.size() << " border loops\n";
//   for (const std::string& defect : defects) std::cerr << defect << "\n";
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "majorant/mesh/connectivity.h"
#include "majorant/mesh/polygon_mesh.h"

namespace majorant {

// An oriented manifold of quads. Half-edges are those of HalfEdgesOf<4>.
struct QuadSurface {
  const PolygonMesh& mesh;  // outlives this
  std::vector<Index> opposite;
  std::vector<Index> valence;             // by vertex: its quads
  std::vector<char> is_border;            // by vertex
  std::vector<std::vector<Index>> loops;  // of the border as half-edges, the quads on their left

  Index count() const { return static_cast<Index>(mesh.polygons.size()); }
  Index half_edge_count() const { return 4 * count(); }
  Index from(Index h) const { return mesh.polygons[HalfEdgesOf<4>::face(h)][h % 4]; }
  Index to(Index h) const { return from(HalfEdgesOf<4>::next(h)); }
  const Vector3& point(Index vertex) const { return mesh.positions[vertex]; }
  std::array<Vector3, 4> corners_of(Index quad) const;
};

// Nothing where the polygons are no such surface: what is wrong is added to `defects` then, a
// sentence each.
std::optional<QuadSurface> quad_surface(const PolygonMesh& quads,
                                        std::vector<std::string>& defects);

// Places that a sentence names.
inline constexpr std::size_t kNamedInDefects = 8;
// "3 quads are folded (1, 7, 9)"; of many the first.
std::string listed(std::string_view one, std::string_view several,
                   const std::vector<Index>& from_0);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
