// Quads as a surface: sides of edges, border loops, quads around vertices.
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

// An oriented manifold of quads with the half-edges of HalfEdgesOf<4>.
struct QuadSurface {
  const PolygonMesh& mesh;  // must outlive this
  std::vector<Index> opposite;
  std::vector<Index> valence;             // by vertex: its number of quads
  std::vector<char> is_border;            // by vertex
  std::vector<std::vector<Index>> loops;  // border half-edges, with the quads on their left

  Index count() const { return static_cast<Index>(mesh.polygons.size()); }
  Index half_edge_count() const { return 4 * count(); }
  Index from(Index h) const { return mesh.polygons[HalfEdgesOf<4>::face(h)][h % 4]; }
  Index to(Index h) const { return from(HalfEdgesOf<4>::next(h)); }
  const Vector3& point(Index vertex) const { return mesh.positions[vertex]; }
  std::array<Vector3, 4> corners_of(Index quad) const;
};

// Returns nothing if the polygons form no such surface, and adds a sentence about each defect to
// `defects`.
std::optional<QuadSurface> quad_surface(const PolygonMesh& quads,
                                        std::vector<std::string>& defects);

// The largest number of places that a sentence lists.
inline constexpr std::size_t kNamedInDefects = 8;
// Returns "3 quads are folded (1, 7, 9)"; lists only the first ones of many.
std::string listed(std::string_view one, std::string_view several,
                   const std::vector<Index>& from_0);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
