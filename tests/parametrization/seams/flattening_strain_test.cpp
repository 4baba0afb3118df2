// The strain of surfaces with known solutions.
#include "majorant/parametrization/seams/internal/flattening_strain.h"

#include <cmath>

#include "majorant/mesh/cut_graph.h"
#include "parametrization/seams/cut_checks.h"

namespace majorant {
namespace {

// Returns the part of a unit sphere within `angle` of its pole.
SurfaceMesh cap(double angle, int rings, int sectors) {
  std::vector<Vector3> positions{{0, 0, 1}};
  std::vector<std::vector<Index>> faces;
  for (int i = 1; i <= rings; ++i)
    for (int k = 0; k < sectors; ++k) {
      const double a = angle * i / rings, b = 2 * kPi * k / sectors;
      positions.emplace_back(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a));
      const Index here = 1 + (i - 1) * sectors + k,
                  beside = 1 + (i - 1) * sectors + (k + 1) % sectors;
      if (i == 1)
        faces.push_back({0, here, beside});
      else
        faces.push_back({here - sectors, here, beside, beside - sectors});
    }
  return SurfaceMesh::from_polygons(polygon_mesh(std::move(positions), std::move(faces)));
}

// Returns a tube of 9 rings, open at both ends, whose radius increases by `growth` from ring to
// ring.
SurfaceMesh tube(double growth) {
  std::vector<Vector3> positions;
  std::vector<std::vector<Index>> faces;
  for (int i = 0; i < 9; ++i)
    for (int k = 0; k < 24; ++k) {
      const double radius = 1 + growth * i;
      positions.emplace_back(radius * std::cos(2 * kPi * k / 24),
                             radius * std::sin(2 * kPi * k / 24), 0.3 * i);
      if (i > 0)
        faces.push_back(
            {24 * (i - 1) + k, 24 * (i - 1) + (k + 1) % 24, 24 * i + (k + 1) % 24, 24 * i + k});
    }
  return SurfaceMesh::from_polygons(polygon_mesh(positions, faces));
}

TEST(FlatteningStrain, OfASphericalCap) {
  // chi = (R^2 - r^2)^2 / 64 solves the equation on a disk with K = 1: mean |e|^2 = R^4 / 192.
  for (const double angle : {0.1, 0.3}) {
    const double expected = std::pow(angle, 4) / 192;
    EXPECT_NEAR(FlatteningStrain(cap(angle, 16, 48)).strain(), expected, 0.05 * expected) << angle;
  }
}

TEST(FlatteningStrain, IsZeroForFlatSurfaces) {
  for (const PolygonMesh& input : {grid(6), grid_without(8, {3 * 8 + 1})})
    EXPECT_NEAR(FlatteningStrain(SurfaceMesh::from_polygons(input)).strain(), 0, 1e-20);
}

TEST(FlatteningStrain, SeesThatARingDoesNotClose) {
  // A tube open at both ends has no curvature, but is not isometric to a planar ring.
  const SurfaceMesh open = tube(0);
  EXPECT_GT(FlatteningStrain(open).strain(), 0.05);
  const SurfaceCuts cuts = choose_cuts(open, {});
  EXPECT_NEAR(cuts.length, 2.4, 1e-9);
  EXPECT_NEAR(cuts.components.at(0).estimated_stretch, 1, 1e-9);
}

void expect_strain_of_cut_piece(const SurfaceMesh& mesh, const std::vector<char>& is_cut,
                                bool has_its_unknowns) {
  FlatteningSystem system(mesh);
  EXPECT_EQ(system.boundary(is_cut, -1).has_value(), has_its_unknowns);
  const double expected = FlatteningStrain(mesh.cut_along(is_cut, nullptr)).strain();
  EXPECT_GT(expected, 1e-3);
  for (int k = 0; k < 2; ++k) {
    EXPECT_NEAR(FlatteningStrain(system, is_cut).strain(), expected, 1e-9 * expected);
    std::vector<char> other = cut_graph(mesh, {mesh.vertex_count() / 2});
    EXPECT_TRUE(std::isfinite(FlatteningStrain(system, other).strain()));
  }
}

TEST(FlatteningStrain, WithCutsEqualsThatOfTheCutPiece) {
  const SurfaceMesh sphere = SurfaceMesh::from_polygons(cube_sphere(8)),
                    torus = SurfaceMesh::from_polygons(bar_with_holes(1, 2)),
                    holes = SurfaceMesh::from_polygons(sphere_with_holes(8, 3));
  expect_strain_of_cut_piece(sphere, cut_graph(sphere, {0, 100, 200}), true);
  expect_strain_of_cut_piece(torus, cut_graph(torus, {5}), true);
  expect_strain_of_cut_piece(holes, cut_graph(holes, {0, 100}), true);
}

// The cut begins at the shorter of two loops, which the cut surface no longer has.
TEST(FlatteningStrain, OfACutThatMeetsAnInnerLoop) {
  const SurfaceMesh wide = tube(0.1);
  std::vector<char> is_cut(to_size(wide.half_edge_count()), 0);
  for (Index h = 0; h < wide.half_edge_count(); ++h)
    if (const Index o = wide.opposite(h); o >= 0 && wide.from_vertex(h) % 24 == 0 &&
                                          wide.from_vertex(h) < 72 &&
                                          wide.to_vertex(h) == wide.from_vertex(h) + 24)
      is_cut[h] = is_cut[o] = 1;
  expect_strain_of_cut_piece(wide, is_cut, false);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
