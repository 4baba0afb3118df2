// Faces of area 0 are cut off; a component of such faces is cut into single faces.
#include "majorant/parametrization/seams/internal/slivers.h"

#include <algorithm>

#include "majorant/mesh/repair.h"
#include "parametrization/seams/cut_checks.h"

namespace majorant {
namespace {

// Returns the cuts of a connected surface.
template <class Cut>
std::vector<char> cuts_of(const SurfaceMesh& mesh, const Cut& cut) {
  std::vector<char> is_cut(to_size(mesh.half_edge_count()), 0);
  const std::vector<SurfacePiece> pieces = mesh.split();
  EXPECT_EQ(pieces.size(), 1u);
  cut(pieces.front(), is_cut);
  return is_cut;
}

TEST(Slivers, AreCutOffFromTheirNeighbours) {
  PolygonMesh mesh = grid(4, bumpy);
  mesh.positions[12] = mesh.positions[13];
  const auto surface = repair(mesh).mesh;
  const std::vector<char> flags = cuts_of(*surface, cut_off_slivers);
  Index expected = 0;
  std::vector<char> is_sliver(to_size(surface->face_count()), 0);
  for (const RestTriangle& t : surface->rest_triangles()) is_sliver[t.face] = 1;
  EXPECT_EQ(std::count(is_sliver.begin(), is_sliver.end(), 1), 2);
  for (Index h = 0; h < surface->half_edge_count(); ++h) {
    const Index o = surface->opposite(h);
    const bool is_side = o >= 0 && (is_sliver[face_of(h)] || is_sliver[face_of(o)]);
    EXPECT_EQ(flags[h] != 0, is_side) << h;
    expected += is_side;
  }
  EXPECT_GT(expected, 4);
}

TEST(Slivers, NothingIsCutWhereAllFacesHaveAnArea) {
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(grid(4, bumpy));
  const auto apart = [](const SurfacePiece& part, std::vector<char>& is_cut) {
    cut_off_slivers(part, is_cut);
    cut_apart_flat_piece(part, 1.015, is_cut, {});
  };
  const std::vector<char> flags = cuts_of(mesh, apart);
  EXPECT_EQ(std::count(flags.begin(), flags.end(), 1), 0);
}

// All vertices are at one of two positions.
TEST(Slivers, APieceOfThemIsCutApart) {
  PolygonMesh mesh = grid(3);
  for (Vector3& p : mesh.positions) p = Vector3(p.x() > 0.5 ? 1 : 0, 0, 0);
  const auto surface = repair(mesh).mesh;
  const auto apart = [](const SurfacePiece& part, std::vector<char>& is_cut) {
    cut_apart_flat_piece(part, 1.015, is_cut, {});
  };
  const std::vector<char> flags = cuts_of(*surface, apart);
  for (Index h = 0; h < surface->half_edge_count(); ++h)
    EXPECT_EQ(flags[h] != 0, surface->opposite(h) >= 0) << h;
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
