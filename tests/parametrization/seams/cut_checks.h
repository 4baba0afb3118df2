// Shared code of the tests of cuts.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "majorant/parametrization/seams/choose_cuts.h"
#include "majorant/parametrization/seams/internal/pieces.h"
#include "mesh/surfaces_of_any_genus.h"

namespace majorant {

inline CutOptions cuts_by(CutMethod method) {
  CutOptions options;
  options.method = method;
  return options;
}

inline std::vector<SurfaceMesh> pieces_of(const SurfaceMesh& mesh,
                                          const std::vector<char>& is_cut) {
  std::vector<SurfaceMesh> pieces;
  for (const SurfacePiece& piece : mesh.cut_along(is_cut, nullptr).split())
    pieces.push_back(*piece.mesh);
  return pieces;
}

inline void expect_planar_pieces(const SurfaceMesh& mesh, const SurfaceCuts& cuts) {
  ASSERT_EQ(cuts.is_cut.size(), to_size(mesh.half_edge_count()));
  double length = 0;
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    const Index o = mesh.opposite(h);
    EXPECT_EQ(cuts.is_cut[h], o < 0 ? 0 : cuts.is_cut[o]);
    if (cuts.is_cut[h]) length += 0.5 * mesh.edge_length(h);
  }
  EXPECT_NEAR(cuts.length, length, 1e-9 * length);
  Index pieces = 0;
  for (const ComponentCuts& component : cuts.components) pieces += component.pieces;
  const std::vector<SurfaceMesh> found = pieces_of(mesh, cuts.is_cut);
  EXPECT_EQ(pieces, static_cast<Index>(found.size()));
  for (const SurfaceMesh& piece : found) EXPECT_NO_THROW(piece.require_planar());
}

// Returns a sphere of 6 n^2 quads without `holes` of them, of which no two are adjacent.
inline PolygonMesh sphere_with_holes(int n, int holes) {
  PolygonMesh mesh = cube_sphere(n);
  const std::size_t step = mesh.polygons.size() / static_cast<std::size_t>(holes);
  IndexLists kept;
  for (std::size_t f = 0; f < mesh.polygons.size(); ++f)
    if (f % step != 0) kept.push_back(mesh.polygons[f]);
  mesh.polygons = std::move(kept);
  return mesh;
}

// Returns a closed quad mesh with limbs along the axes.
inline PolygonMesh limbs(int n) {
  return transformed(cube_sphere(n), [](const Vector3& p) -> Vector3 {
    const double along = p.cwiseAbs().maxCoeff();
    return p * (1 + 2.5 * std::pow(along, 12) + 0.2 * p.x());
  });
}

// Returns a closed surface with limbs that is symmetric in x = 0. Its triangles are not: the
// diagonals of quads have one direction.
inline SurfaceMesh mirrored_limbs() {
  PolygonMesh mesh = transformed(cube_sphere(12), [](const Vector3& p) -> Vector3 {
    const Vector3 up(0, 0.6, 0.8), down(0, 0.5, -0.85);
    const Vector3 left(-0.8, 0.2, -0.5), right(0.8, 0.2, -0.5);
    double far = 0;
    for (const Vector3& limb : {up, down, left, right})
      far += std::exp(-12 * (p.normalized() - limb.normalized()).squaredNorm());
    return p.normalized() * (1 + 1.8 * far);
  });
  std::vector<std::vector<Index>> triangles;
  for (const auto q : mesh.polygons) {
    triangles.push_back({q[0], q[1], q[2]});
    triangles.push_back({q[0], q[2], q[3]});
  }
  mesh.polygons = triangles;
  mesh.polygon_lines.clear();
  return SurfaceMesh::from_polygons(mesh);
}

// Returns the part of the cuts, by length, whose midpoints have mirror images near a cut.
inline double mirrored_part(const SurfaceMesh& mesh, const std::vector<char>& is_cut) {
  std::vector<std::array<Vector3, 2>> cuts;
  double mean = 0;
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    mean += mesh.edge_length(h) / mesh.half_edge_count();
    if (is_cut[h] && h < mesh.opposite(h))
      cuts.push_back(
          {mesh.positions().row(mesh.from_vertex(h)), mesh.positions().row(mesh.to_vertex(h))});
  }
  double near = 0, all = 0;
  for (const auto& [a, b] : cuts) {
    Vector3 image = (a + b) / 2;
    image.x() = -image.x();
    double least = mean * 1e9;
    for (const auto& [c, d] : cuts) {
      const Vector3 way = d - c;
      const double t = std::clamp(way.dot(image - c) / way.squaredNorm(), 0.0, 1.0);
      least = std::min(least, (image - c - t * way).norm());
    }
    all += (b - a).norm();
    if (least <= mean) near += (b - a).norm();
  }
  return near / all;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
