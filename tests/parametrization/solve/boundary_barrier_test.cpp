// The barrier between parts of the boundary: pairs, derivatives, and the first contact along a
// step.
#include "majorant/parametrization/solve/internal/boundary_barrier.h"

#include <algorithm>
#include <random>
#include <set>

#include "majorant/framework/element_values.h"
#include "majorant/framework/internal/colored_batches.h"
#include "majorant/parametrization/solve/internal/barrier_domain.h"
#include "maps/test_maps.h"
#include "mesh/test_meshes.h"

namespace majorant {
namespace {

constexpr int kSteps = 40;

// Returns a strip of 2 by kSteps squares, rolled up to a spiral with a narrow gap.
BezierMap spiral() {
  std::vector<Vector3> positions;
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; j <= 2; ++j) positions.emplace_back(0.2 * i, 0.2 * j, 0);
  std::vector<std::vector<Index>> faces;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < 2; ++j) {
      const Index a = 3 * i + j;
      faces.push_back({a, a + 3, a + 4});
      faces.push_back({a, a + 4, a + 1});
    }
  const auto mesh = surface(polygon_mesh(positions, faces));
  return BezierMap::linear(mesh, uv_of(*mesh, [](const Vector3& p) {
                             const double t = p.x() / 1.2, r = 1 + 0.45 / (2 * kPi) * t - p.y();
                             return Vector2(r * std::cos(t), r * std::sin(t));
                           }));
}

Vector2 at(VecIn x, Index v) { return x.segment<2>(2 * v); }

double distance(const Vector2& p, const Vector2& a, const Vector2& b) {
  double least = std::min((p - a).norm(), (p - b).norm());
  const double along = (p - a).dot(b - a) / (b - a).squaredNorm();
  if (along > 0 && along < 1) least = (p - a - along * (b - a)).norm();
  return least;
}

using Pair = std::array<Index, 3>;

std::set<Pair> as_set(const Cells& pairs) {
  std::set<Pair> all;
  for (const auto& p : pairs.rowwise()) all.insert({p[0], p[1], p[2]});
  EXPECT_EQ(static_cast<Index>(all.size()), pairs.rows());
  return all;
}

TEST(BoundaryBarrier, PairsAreThoseWithinReach) {
  const BezierMap map = spiral();
  const BoundaryEdges edges(map, 1);
  const SurfaceMesh& mesh = map.mesh();
  for (const BarrierReach reach : {BarrierReach{0.5}, BarrierReach{0.5, 0.02}})
    for (const double factor : {0.5, 1.0, 3.0}) {
      std::set<Pair> expected;
      for (Index h = 0; h < mesh.half_edge_count(); ++h) {
        if (mesh.opposite(h) >= 0) continue;
        const Index a = mesh.from_vertex(h), b = mesh.to_vertex(h);
        for (Index v = 0; v < mesh.vertex_count(); ++v) {
          if (v % 3 == 1 && v > 1 && v < 3 * kSteps) continue;  // inside
          if (v == a || v == b) continue;
          // All boundary edges are 0.2 long, and the area is 3.2.
          const double most = std::min(reach.of_edges * 0.2, reach.of_size * std::sqrt(3.2));
          if (distance(at(map.control_points(), v), at(map.control_points(), a),
                       at(map.control_points(), b)) <= factor * most)
            expected.insert({v, a, b});
        }
      }
      const std::set<Pair> found = as_set(edges.near_pairs(map.control_points(), reach, factor));
      std::vector<Pair> differing;
      std::set_symmetric_difference(found.begin(), found.end(), expected.begin(), expected.end(),
                                    std::back_inserter(differing));
      EXPECT_TRUE(differing.empty())
          << factor << ": " << differing.size() << " pairs differ, vertex " << differing[0][0]
          << " and the edge from " << differing[0][1] << " among them";
      if (factor == 1 && reach.of_size > 1) EXPECT_GE(expected.size(), 10u);
    }
}

TEST(BoundaryBarrier, ValuesAndDerivativesAreThoseOfTheFormula) {
  const BezierMap map = spiral();
  const BoundaryEdges edges(map, 1);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-0.01, 0.01);
  Vec x = map.control_points();
  for (Index k = 0; k < x.size(); ++k) x[k] += uniform(random);
  const Cells pairs = edges.near_pairs(x, {0.5}, 2);
  const auto term = edges.barrier(pairs, {0.5});
  double expected = 0;  // edges are 0.2 long on the surface, so the reach is 0.1
  for (const auto& p : pairs.rowwise()) {
    const double s = std::pow(distance(at(x, p[0]), at(x, p[1]), at(x, p[2])) / 0.1, 2);
    if (s < 1) expected -= 0.1 * 0.2 * (s - 1) * (s - 1) * std::log(s);
  }
  EXPECT_GT(expected, 0);
  EXPECT_NEAR(element_values(*term, {}, ColoredBatches(term->element_dofs(), {}), x).sum(),
              expected, 1e-12 * expected);
  const DerivativeReport report = check_derivatives(*term, x);
  EXPECT_TRUE(report.ok()) << report.message();
  EXPECT_GT(report.checked, 50);
}

// A step is free of overlaps up to its bound, and has one right behind it.
TEST(BoundaryBarrier, StepsEndAtTheFirstContact) {
  const BezierMap map = spiral();
  const auto edges = std::make_shared<const BoundaryEdges>(map, 1);
  const SimpleBoundary simple(edges, map);
  const Vec& x = map.control_points();
  ASSERT_TRUE(simple.check(x).feasible);
  std::mt19937 random(6);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int contacts = 0;
  for (int trial = 0; trial < 60; ++trial) {
    Vec d(x.size());
    for (Index k = 0; k < d.size(); ++k) d[k] = uniform(random);
    const double s = trial % 3 == 0 ? 0.02 : 3.0;  // 3: vertices move over most of the spiral
    const StepBound bound = simple.max_step(x, d, s);
    ASSERT_GT(bound.step, 0);
    ASSERT_LE(bound.step, s);
    for (int part = 1; part < 20; ++part)
      EXPECT_TRUE(simple.check(x + (0.9999 * part / 19 * bound.step) * d).feasible) << trial;
    if (bound.step == s) continue;
    ++contacts;
    EXPECT_FALSE(simple.check(x + 1.0001 * bound.step * d).feasible) << trial;
    ASSERT_EQ(bound.blocking.size(), 1u);
    EXPECT_GE(bound.blocking.front(), map.space().element_count());
  }
  EXPECT_GE(contacts, 40);
}

// Thin sheets between which there is no room: each edge has many others within its reach.
TEST(BoundaryBarrier, ABoundaryWithManyPairsIsCrowded) {
  const BezierMap map = spiral();
  const SolverRules rules;
  EXPECT_FALSE(BarrierDomain(map, 1, rules).is_crowded(map.control_points()));
  // On a surface that is 20 times as large as the map the reach covers half of the spiral.
  EXPECT_TRUE(BarrierDomain(map, 20, rules).is_crowded(map.control_points()));
}

TEST(BoundaryBarrier, AStandstillHasNoContact) {
  const BezierMap map = spiral();
  const SimpleBoundary simple(std::make_shared<const BoundaryEdges>(map, 1), map);
  const Vec d = Vec::Zero(map.control_points().size());
  EXPECT_EQ(simple.max_step(map.control_points(), d, 1).step, 1);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
