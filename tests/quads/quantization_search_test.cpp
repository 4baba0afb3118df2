#include "majorant/quads/internal/quantization_search.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "majorant/framework/run_record.h"
#include "majorant/quads/internal/aligned_map.h"
#include "majorant/quads/quad_mesh.h"

namespace majorant {
namespace {

// A triangle with a right angle between legs of these lengths, cut into n by n.
SurfaceMesh right_triangle(double leg, double other, int n) {
  PolygonMesh mesh;
  std::map<std::pair<int, int>, Index> number;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n - i; ++j) {
      number[{i, j}] = static_cast<Index>(mesh.positions.size());
      mesh.positions.emplace_back(leg * i / n, other * j / n, 0);
    }
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n - i; ++j) {
      mesh.polygons.push_back({number[{i, j}], number[{i + 1, j}], number[{i, j + 1}]});
      if (i + j + 1 < n)
        mesh.polygons.push_back({number[{i + 1, j}], number[{i + 1, j + 1}], number[{i, j + 1}]});
    }
  return SurfaceMesh::from_polygons(mesh);
}

// n by n tiles, every other one a square around a round hole.
SurfaceMesh plate_with_round_holes(int n) {
  constexpr int kAlong = 6, kRings = 3;
  PolygonMesh mesh;
  std::map<std::pair<long, long>, Index> number;
  const auto vertex = [&](double x, double y) {
    const auto [found, is_new] = number.try_emplace({std::lround(1e9 * x), std::lround(1e9 * y)},
                                                    static_cast<Index>(mesh.positions.size()));
    if (is_new) mesh.positions.emplace_back(x, y, 0);
    return found->second;
  };
  const auto add = [&](const auto& at, int i, int j) {
    const Index a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
    mesh.polygons.push_back({a, b, c});
    mesh.polygons.push_back({a, c, d});
  };
  for (int x = 0; x < n; ++x)
    for (int y = 0; y < n; ++y) {
      const bool is_whole = (x + y) % 2 == 0;
      const auto place = [&](int i, int j) {
        if (is_whole) return vertex(x + i / double{kAlong}, y + j / double{kAlong});
        // Along the square's sides, and in from there.
        const int side = i / kAlong % 4;
        const double s = i % kAlong / double{kAlong}, t = j / double{kRings};
        const double across[] = {s, 1, 1 - s, 0}, up[] = {0, s, 1, 1 - s};
        const double angle = std::numbers::pi * (-0.75 + 0.5 * (side + s));
        return vertex(x + (1 - t) * across[side] + t * (0.5 + 0.3 * std::cos(angle)),
                      y + (1 - t) * up[side] + t * (0.5 + 0.3 * std::sin(angle)));
      };
      for (int i = 0; i < (is_whole ? kAlong : 4 * kAlong); ++i)
        for (int j = 0; j < (is_whole ? kAlong : kRings); ++j) add(place, i, j);
    }
  return SurfaceMesh::from_polygons(mesh);
}

void expect_counts(const SurfaceMesh& mesh, const std::vector<double>& counts,
                   const std::vector<char>& is_feature = {}) {
  const ResolvedSurface resolved = resolve_feature_edges(mesh, is_feature);
  RunRecord record;
  SeamlessLattice lattice(resolved.mesh, aligned_map(resolved, {}, record).map,
                          resolved.is_feature);
  const TMesh t_mesh = trace_t_mesh(lattice);
  for (const double requested : counts) {
    const std::vector<Index> edges =
        QuantizationSearch(lattice, t_mesh, ArcLengths::NonNegative, {}).for_count(requested);
    EXPECT_NEAR(static_cast<double>(quad_count(t_mesh, edges)) / requested, 1, kCountClose)
        << requested;
  }
}

// A bit more of length changes the count twice as much as it would that of squares.
TEST(QuantizationSearch, FindsTheRequestedCountWhereCountsFallFast) {
  expect_counts(plate_with_round_holes(10), {950, 1000, 1050, 1100, 1500, 2000});
}

// One row less of quads is 14 % fewer.
TEST(QuantizationSearch, FindsTheRequestedCountBetweenTwoLengths) {
  expect_counts(right_triangle(3, 0.3, 24), {500, 700, 1000, 1400, 2000});
  expect_counts(right_triangle(2, 0.6, 20), {500, 700, 1000, 1400, 2000});
}

// All edges are as long, so that they gain and lose their numbers at one length: 150, 216 and 294
// quads, unless these may differ.
TEST(QuantizationSearch, DifferOnSidesOfEqualLengths) {
  PolygonMesh cube;
  for (const double x : {0, 1})
    for (const double y : {0, 1})
      for (const double z : {0, 1}) cube.positions.emplace_back(x, y, z);
  constexpr std::array<std::array<Index, 4>, 6> kSides = {
      {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}}};
  for (const auto& [a, b, c, d] : kSides) {
    cube.polygons.push_back({a, b, c});
    cube.polygons.push_back({a, c, d});
  }
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(cube);
  expect_counts(mesh, {170, 200, 240, 255}, sharp_edges(mesh, kCornerTurn));
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
