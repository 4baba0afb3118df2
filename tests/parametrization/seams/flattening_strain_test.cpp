// The strain of sheets whose answer is known.
#include "majorant/parametrization/seams/internal/flattening_strain.h"

#include <cmath>

#include "parametrization/seams/cut_checks.h"

namespace majorant {
namespace {

// The part of a sphere of radius 1 within `angle` of its pole.
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

TEST(FlatteningStrain, OfASphericalCap) {
  // chi = (R^2 - r^2)^2 / 64 solves the equation on a disk with K = 1: mean |e|^2 = R^4 / 192.
  for (const double angle : {0.1, 0.3}) {
    const double expected = std::pow(angle, 4) / 192;
    EXPECT_NEAR(FlatteningStrain(cap(angle, 16, 48)).strain(), expected, 0.05 * expected) << angle;
  }
}

TEST(FlatteningStrain, IsZeroForWhatIsFlat) {
  for (const PolygonMesh& input : {grid(6), grid_without(8, {3 * 8 + 1})})
    EXPECT_NEAR(FlatteningStrain(SurfaceMesh::from_polygons(input)).strain(), 0, 1e-20);
}

TEST(FlatteningStrain, SeesThatARingDoesNotClose) {
  // A tube open at both ends has no curvature, and yet is no ring in the plane.
  std::vector<Vector3> positions;
  std::vector<std::vector<Index>> faces;
  for (int i = 0; i < 9; ++i)
    for (int k = 0; k < 24; ++k) {
      positions.emplace_back(std::cos(2 * kPi * k / 24), std::sin(2 * kPi * k / 24), 0.3 * i);
      if (i > 0)
        faces.push_back(
            {24 * (i - 1) + k, 24 * (i - 1) + (k + 1) % 24, 24 * i + (k + 1) % 24, 24 * i + k});
    }
  const SurfaceMesh open = SurfaceMesh::from_polygons(polygon_mesh(positions, faces));
  EXPECT_GT(FlatteningStrain(open).strain(), 0.05);
  const SurfaceCuts cuts = choose_cuts(open, {});
  EXPECT_NEAR(cuts.length, 2.4, 1e-9);
  EXPECT_NEAR(cuts.components.at(0).estimated_stretch, 1, 1e-9);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
