// Seams as linear constraints solved by elimination: exact null space, known ranks, small integers,
// redundant, conflicting and composed constraints.
#include <gtest/gtest.h>

#include <set>

#include "constraints/integer_rows.h"
#include "expected_error.h"
#include "majorant/constraints/constraints.h"
#include "majorant/energies/energy_factory.h"
#include "majorant/framework/internal/symmetric_eigen.h"
#include "majorant/framework/problem.h"
#include "majorant/framework/problem_parts.h"
#include "majorant/maps/quadrature_hierarchy.h"
#include "maps/test_maps.h"
#include "parametrization/initialization/seamless_cases.h"
#include "support.h"

namespace majorant {
namespace {

using test::Random;

struct Held {
  std::shared_ptr<const Seams> seams;
  std::shared_ptr<const BezierTriangleSpace> space;
  Vec x;  // the elevated start

  Held(const SeamlessCase& c, int degree) : Held(c.start().map, degree) {}
  Held(const BezierMap& start, int degree) : seams(start.shared_seams()) {
    const BezierMap map = elevated_to(start, degree);
    space = map.shared_space();
    x = map.control_points();
  }
  ConstraintRows rows() const {
    ConstraintRows out;
    SeamlessConstraint(space, seams).append_rows(out);
    return out;
  }
  Elimination elimination(const ConstraintRows& r) const {
    return Elimination(2 * space->node_count(), r);
  }
  Elimination elimination() const { return elimination(rows()); }
};

// Expects A Z = 0 in integers, and as many free unknowns as the rank of A leaves.
void expect_exact(const std::vector<IntegerRow>& a, const Elimination& z) {
  for (const IntegerRow& row : a) {
    std::map<Index, long> product;
    for (const auto& [i, c] : row)
      for (const auto& e : z.row(i)) {
        const long entry = std::lround(e.coefficient);
        ASSERT_EQ(double(entry), e.coefficient);
        product[e.reduced] += c * entry;
      }
    for (const auto& [j, value] : product) ASSERT_EQ(value, 0) << "column " << j;
  }
  EXPECT_EQ(z.reduced_size(), z.full_size() - modular_rank(a));
}

std::set<double> entries(const Elimination& z) {
  std::set<double> out;
  for (Index i = 0; i < z.full_size(); ++i)
    for (const auto& e : z.row(i)) out.insert(std::abs(e.coefficient));
  return out;
}

void expect_small(const Elimination& z) {
  for (const double c : entries(z)) EXPECT_TRUE(c == 1 || c == 2) << c;
}

// For random y, seams hold up to a few units in the last place of the map's size.
void expect_seams_hold(const Held& h, const Elimination& z, Random& random) {
  Vec x;
  z.expand(random.vector(z.reduced_size(), -10, 10), x);
  EXPECT_LE(seam_residual(*h.space, *h.seams, x), 64 * 1.2e-16 * 4 * x.cwiseAbs().maxCoeff());
}

struct Known {
  const char* name;
  SeamlessCase surface;
  int lost;  // dependent rows of A
};

// Rows are linearly dependent where turns of pieces can undo every transition.
std::vector<Known> known_cases() {
  std::vector<Known> out;
  const auto add = [&](const char* name, const Squares& s, int m, Charts charts, int lost) {
    out.push_back({name, squares_case(s, m, charts), lost});
  };
  add("cube, six charts", unit_cube(), 3, Charts::OnePerSquare, 0);
  add("cube, cross net", unit_cube(), 3, Charts::One, 0);
  add("torus", square_torus(4, 3), 2, Charts::OneWithoutSlits, 2);
  add("torus with slits", square_torus(4, 3), 2, Charts::One, 2);
  add("torus, a chart a square", square_torus(3, 3), 2, Charts::OnePerSquare, 2);
  add("genus 1", holed_plate(1), 2, Charts::OneWithoutSlits, 0);
  add("genus 2", holed_plate(2), 2, Charts::OneWithoutSlits, 0);
  add("genus 2 with slits", holed_plate(2), 1, Charts::One, 0);
  add("L", polycube({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), 2, Charts::OneWithoutSlits, 0);
  add("corner", polycube({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}), 2, Charts::OnePerSquare, 0);
  return out;
}

TEST(SeamlessConstraint, NullSpaceAndRankAreExactOnClosedSurfaces) {
  Random random(3);
  for (const Known& known : known_cases())
    for (const int n : {1, 2, 3}) {
      SCOPED_TRACE(testing::Message() << known.name << ", degree " << n);
      const Held h(known.surface, n);
      const std::vector<IntegerRow> a = difference_rows(*h.space, *h.seams);
      const auto edges = static_cast<Index>(h.seams->edges().size());
      ASSERT_EQ(static_cast<Index>(a.size()), 2 * edges * n);
      EXPECT_EQ(modular_rank(a), 2 * edges * n - known.lost);
      const Elimination z = h.elimination();
      expect_exact(a, z);
      expect_small(z);
      expect_seams_hold(h, z, random);
    }
}

// 2 k edges, no rotations: 4 k n rows of rank 4 k n - 2 (method.md E11).
TEST(SeamlessConstraint, TheTorusLosesTwoRows) {
  for (const int m : {1, 2, 3}) {
    SeamlessCase c = squares_case(square_torus(4, 4), m, Charts::OneWithoutSlits);
    for (const int n : {1, 2, 3}) {
      const Held h(c, n);
      for (const SeamEdge& e : h.seams->edges()) EXPECT_EQ(e.turns, 0);
      const auto edges = static_cast<Index>(h.seams->edges().size());
      ASSERT_EQ(edges % 2, 0);
      const Index k = edges / 2;
      const Elimination z = h.elimination();
      EXPECT_EQ(z.full_size() - z.reduced_size(), 4 * k * n - 2);
    }
  }
}

// Fans of every index that occurs, and regular vertices, cut to the boundary.
TEST(SeamlessConstraint, ConesOfEveryIndex) {
  Random random(4);
  for (const int turns : {1, 2, 3, 4, 5, 6, 7, 8})
    for (const int rings : {1, 3})
      for (const int n : {1, 2, 3}) {
        SCOPED_TRACE(testing::Message() << turns << " turns, degree " << n);
        const Held h(fan_case(turns, rings), n);
        ASSERT_EQ(h.seams->edges().size(), std::size_t(rings));
        const auto& quarter_turns = h.seams->quarter_turns();
        EXPECT_EQ(std::count(quarter_turns.begin(), quarter_turns.end(), turns),
                  turns == 4 ? (rings - 1) * std::max(3 * turns, 4) + 1 : 1);
        const Elimination z = h.elimination();
        expect_exact(difference_rows(*h.space, *h.seams), z);
        EXPECT_EQ(z.full_size() - z.reduced_size(), 2 * rings * n);
        expect_small(z);
        expect_seams_hold(h, z, random);
      }
}

// Without an end in the interior the translation is free, for any turns.
TEST(SeamlessConstraint, AnnuliKeepTheirTranslation) {
  for (const int turns : {4, 5, 6, 7}) {
    const Held h(fan_case(turns, 3, 1), 2);
    ASSERT_EQ(h.seams->chain_count(), 1);
    const Elimination z = h.elimination();
    EXPECT_EQ(z.auxiliary_size(), 2);
    expect_exact(difference_rows(*h.space, *h.seams), z);
    EXPECT_EQ(z.full_size() - z.reduced_size(), 2 * 2 * 2);
    for (Index j : {z.reduced_size() - 2, z.reduced_size() - 1})
      EXPECT_GE(z.full_index(j), z.full_size());
  }
}

// Arbitrary cuts: dangling paths, single triangles, closed chains, nodes of every kind.
TEST(SeamlessConstraint, RandomCuts) {
  Random random(6);
  std::vector<SeamlessCase> bases{squares_case(unit_cube(), 2, Charts::OneWithoutSlits),
                                  squares_case(square_torus(3, 3), 1, Charts::OneWithoutSlits),
                                  squares_case(holed_plate(2), 1, Charts::One), fan_case(5, 3),
                                  fan_case(2, 3, 1)};
  std::set<double> seen;
  for (std::size_t b = 0; b < bases.size(); ++b)
    for (const double probability : {0.03, 0.1, 0.3, 0.6, 1.0})
      for (unsigned seed = 1; seed <= 4; ++seed) {
        const int n = 1 + int(seed) % 3;
        SCOPED_TRACE(testing::Message() << "base " << b << ", " << probability << ", " << seed);
        const Held h(with_random_cuts(bases[b], probability, seed), n);
        const Elimination z = h.elimination();
        expect_exact(difference_rows(*h.space, *h.seams), z);
        expect_seams_hold(h, z, random);
        double residual = -1;
        z.reduce(h.x, &residual);
        EXPECT_LE(residual, 1e-13 * h.x.cwiseAbs().maxCoeff());
        seen.merge(entries(z));
      }
  for (const double c : seen) EXPECT_TRUE(c == std::floor(c) && c <= 4) << c;
}

TEST(SeamlessConstraint, RedundantRowsChangeNothing) {
  const Held h(squares_case(unit_cube(), 2, Charts::OnePerSquare), 2);
  ConstraintRows rows = h.rows();
  const Elimination once = h.elimination(rows);
  std::size_t size = rows.size();
  for (std::size_t r = 0; r < size; ++r) {
    const std::vector<ConstraintRows::Entry> row(rows.begin(r), rows.end(r));
    rows.begin_row("again");
    for (const auto& e : row) rows.add(e.unknown, -3 * e.coefficient);
    rows.end_row(0);
  }
  const Elimination twice = h.elimination(rows);
  EXPECT_EQ(twice.rank(), once.rank());
  ASSERT_EQ(twice.reduced_size(), once.reduced_size());
  for (Index j = 0; j < once.reduced_size(); ++j)
    EXPECT_EQ(twice.full_index(j), once.full_index(j));
}

// The start satisfies the constraints at every degree, and is the image of its reduced vector.
TEST(SeamlessConstraint, InitialMapsAreReproduced) {
  for (const Known& known : known_cases())
    for (const int n : {1, 3}) {
      const Held h(known.surface, n);
      double residual = -1;
      h.elimination().reduce(h.x, &residual);
      EXPECT_LE(residual, 1e-14 * h.x.cwiseAbs().maxCoeff()) << known.name;
    }
}

// ---- Composed ----

std::vector<Index> copies(const Seams& seams, Index surface_vertex) {
  std::vector<Index> out;
  for (std::size_t v = 0; v < seams.surface_vertex().size(); ++v)
    if (seams.surface_vertex()[v] == surface_vertex) out.push_back(Index(v));
  return out;
}

TEST(SeamlessConstraint, ComposesWithPinsOnEveryCopy) {
  for (const Known& known : known_cases())
    for (const int n : {1, 2, 3}) {
      SCOPED_TRACE(known.name);
      const Held h(known.surface, n);
      // All copies of three vertices on the cut, including cones.
      std::set<Index> nodes;
      const auto& edges = h.seams->edges();
      for (const std::size_t e : {std::size_t(0), edges.size() / 2, edges.size() - 1})
        for (const Index v :
             copies(*h.seams, h.seams->surface_vertex()[edge_nodes(*h.space, edges[e].side)[0]]))
          nodes.insert(v);
      ConstraintRows rows = h.rows();
      FixedPoints::at({nodes.begin(), nodes.end()}, h.x).append_rows(rows);
      const Elimination z = h.elimination(rows);
      double residual = -1;
      Vec x, y = z.reduce(h.x, &residual);
      const double size = h.x.cwiseAbs().maxCoeff();
      EXPECT_LE(residual, 1e-14 * size);
      Random random(5);
      y += random.vector(y.size());
      z.expand(y, x);
      EXPECT_LE(seam_residual(*h.space, *h.seams, x), 1e-13 * x.cwiseAbs().maxCoeff());
      for (const Index v : nodes)
        EXPECT_LE((x.segment<2>(2 * v) - h.x.segment<2>(2 * v)).norm(), 1e-14 * size);
    }
}

TEST(SeamlessConstraint, ComposesWithAFixedBoundary) {
  for (const int turns : {1, 2, 3, 4, 5, 6, 7, 8})
    for (const int inner : {0, 1})
      for (const int n : {1, 2, 3}) {
        SCOPED_TRACE(testing::Message() << turns << " turns, inner " << inner);
        const Held h(fan_case(turns, 3, inner), n);
        const std::vector<Index> nodes = boundary_nodes(*h.space, *h.seams);
        const int sectors = std::max(3 * turns, 4);
        EXPECT_EQ(static_cast<int>(nodes.size()), (inner ? 2 : 1) * (n * sectors + 1));
        ConstraintRows rows = h.rows();
        FixedPoints::at(nodes, h.x).append_rows(rows);
        const Elimination z = h.elimination(rows);
        double residual = -1;
        z.reduce(h.x, &residual);
        EXPECT_LE(residual, 1e-13);
        // The boundary determines the translation of the seam.
        for (Index j = 0; j < z.reduced_size(); ++j) EXPECT_LT(z.full_index(j), z.full_size());
      }
}

TEST(SeamlessConstraint, ContradictionsNameTheRow) {
  const Held h(fan_case(5, 3), 2);
  const auto cut = copies(*h.seams, 1);  // on the cut, in the first ring
  ASSERT_EQ(cut.size(), 2u);
  const auto next = copies(*h.seams, 16);
  ASSERT_EQ(next.size(), 2u);
  std::vector<FixedPoint> points;
  for (const Index v : {cut[0], cut[1], next[0], next[1]})
    points.push_back({v, h.x.segment<2>(2 * v)});
  points.back().position.x() += 1e-3;
  ConstraintRows rows = h.rows();
  FixedPoints(points).append_rows(rows);
  expect_contains(error_message(ErrorKind::Unsupported, [&] { h.elimination(rows); }),
                  {"contradict", std::to_string(next[1])});
  // The seam in the reversed direction contradicts it.
  ConstraintRows reversed;
  FixedPoints(points).append_rows(reversed);
  SeamlessConstraint(h.space, h.seams).append_rows(reversed);
  expect_contains(error_message(ErrorKind::Unsupported, [&] { h.elimination(reversed); }),
                  {"seam at edge (", "contradict"});
}

// ---- Hessians ----

Eigen::MatrixXd dense(const SparsePattern& p, const Vec& values) {
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(p.size, p.size);
  for (Index c = 0; c < p.size; ++c)
    for (Index k = p.column_starts[c]; k < p.column_starts[c + 1]; ++k)
      m(p.rows[k], c) = m(c, p.rows[k]) = values[k];
  return m;
}

Eigen::MatrixXd dense(const Elimination& z) {
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(z.full_size(), z.reduced_size());
  for (Index i = 0; i < z.full_size(); ++i)
    for (const auto& e : z.row(i)) m(i, e.reduced) = e.coefficient;
  return m;
}

TEST(SeamlessConstraint, ReducedHessiansArePositiveSemidefinite) {
  std::vector<SeamlessCase> cases{squares_case(unit_cube(), 2, Charts::OneWithoutSlits),
                                  squares_case(unit_cube(), 1, Charts::OnePerSquare),
                                  squares_case(square_torus(3, 3), 1, Charts::OneWithoutSlits)};
  for (const int turns : {1, 3, 6}) cases.push_back(fan_case(turns, 2));
  for (const SeamlessCase& c : cases)
    for (const int n : {1, 2}) {
      const Held h(c, n);
      const RestShapes rest = flat_triangles(c.mesh->positions(), c.mesh->faces());
      const auto term = symmetric_dirichlet()(h.space, rest, optimizer_quadrature(n, 0).guarded);
      const Problem free = ProblemBuilder(2 * h.space->node_count()).add(term, 1.0).build();
      const Problem held = ProblemBuilder(2 * h.space->node_count())
                               .add(term, 1.0)
                               .add(SeamlessConstraint(h.space, h.seams))
                               .build();
      Vec g_free, h_free, g_held, h_held;
      Evaluator(free).linearize(h.x, Curvature::Projected, g_free, h_free);
      Evaluator(held).linearize(held.reduce(h.x), Curvature::Projected, g_held, h_held);
      const Eigen::MatrixXd z = dense(ProblemParts::elimination(held));
      const Eigen::MatrixXd expected = z.transpose() * dense(free.pattern(), h_free) * z;
      const Eigen::MatrixXd reduced = dense(held.pattern(), h_held);
      const double scale = expected.cwiseAbs().maxCoeff();
      EXPECT_LE((reduced - expected).cwiseAbs().maxCoeff(), 1e-12 * scale);
      EXPECT_LE((g_held - z.transpose() * g_free).norm(), 1e-12 * (1 + g_free.norm()));
      EXPECT_GE(symmetric_eigen(reduced).values[0], -1e-11 * scale);
    }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
