#include "majorant/io/lagrange_cell.h"

#include <cmath>

#include "io_test_helpers.h"
#include "majorant/certify/map_proof.h"
#include "majorant/io/io.h"
#include "rational.h"

namespace majorant {
namespace {

using test::Rational;

// Returns the exact value of a cell at lattice point `row`.
Rational exact_value(const MapFile& map, Index cell, std::size_t row, int axis) {
  const auto indices = bezier_multi_indices(map.degree);
  Rational sum = 0;
  for (std::size_t k = 0; k < indices.size(); ++k) {
    Rational weight = 1;
    for (int i = 2; i <= map.degree; ++i) weight *= i;
    for (std::size_t c = 0; c < 3; ++c)
      for (int i = 1; i <= indices[k][c]; ++i) weight *= Rational(indices[row][c], i) / map.degree;
    sum += weight * Rational(map.uv(map.cells(cell, static_cast<Index>(k)), axis));
  }
  return sum;
}

TEST(LagrangeCell, ValuesAreRoundedCorrectly) {
  for (int degree = 1; degree <= 10; ++degree) {
    const MapFile map = random_strip(degree, 2, static_cast<unsigned>(degree));
    const Points2 nodes = lagrange_nodes(map);
    for (std::size_t row = 0; row < to_size(bezier_cell_size(degree)); ++row)
      for (int axis = 0; axis < 2; ++axis)
        ASSERT_EQ(nodes(map.cells(1, static_cast<Index>(row)), axis),
                  static_cast<double>(exact_value(map, 1, row, axis)))
            << degree;
  }
}

// Multiples of n^n have integer values at the lattice points and are restored exactly, bit by bit
// where they are not 0.
TEST(LagrangeCell, WholeNumbersComeBackExactly) {
  for (int degree = 2; degree <= 10; ++degree) {
    MapFile map = random_strip(degree, 3, 9);
    map.uv = (1000 * map.uv).array().round().matrix() * std::pow(degree, degree);
    MapFile read = map;
    read.uv = lagrange_nodes(map);
    take_as_lagrange_nodes(read, "a.vtu");
    const double size = map.uv.cwiseAbs().maxCoeff();
    EXPECT_LE((read.uv - map.uv).cwiseAbs().maxCoeff(), 1e-30 * size) << degree;
    EXPECT_LE(read.uv_rounding.maxCoeff(), 1e-25 * size) << degree;
  }
}

// The map by control points has the values at the lattice points up to uv_rounding, which is some
// units in the last place, neither more nor zero.
TEST(LagrangeCell, RoundingIsCounted) {
  for (int degree = 2; degree <= 8; ++degree) {
    const MapFile nodes = random_strip(degree, 2, 3u + static_cast<unsigned>(degree));
    MapFile map = nodes;
    take_as_lagrange_nodes(map, "a.vtu");
    const double most = map.uv_rounding.maxCoeff();
    EXPECT_LE(most, 1e-15 * map.uv.cwiseAbs().maxCoeff());
    double worst = 0;
    for (std::size_t row = 0; row < to_size(bezier_cell_size(degree)); ++row)
      for (int axis = 0; axis < 2; ++axis)
        worst = std::max(worst,
                         std::abs(static_cast<double>(
                             exact_value(map, 0, row, axis) -
                             Rational(nodes.uv(nodes.cells(0, static_cast<Index>(row)), axis)))));
    EXPECT_LE(worst, most) << degree;
    EXPECT_GT(worst, 0) << degree;
  }
}

TEST(LagrangeCell, RoundingOfValuesGrows) {
  MapFile map = random_strip(4, 1, 2);
  map.uv_rounding = Points2::Constant(map.uv.rows(), 2, 1e-10);
  take_as_lagrange_nodes(map, "a.vtu");
  EXPECT_EQ(map.uv_rounding(0, 0), 1e-10);  // a corner
  EXPECT_GT(map.uv_rounding.maxCoeff(), 2e-10);
  EXPECT_LE(map.uv_rounding.maxCoeff(), 1.001e-10 * lagrange_amplification(4));
}

// Expects equal control points of all cells for the map and for a map whose cells share no points.
void expect_same_on_points_of_their_own(const MapFile& map) {
  const auto all = map.cells.reshaped<Eigen::RowMajor>();
  MapFile shared = map, own = map;
  own.points = map.points(all, Eigen::all);
  own.uv = map.uv(all, Eigen::all);
  own.input_vertex = map.input_vertex(all);
  for (Index k = 0; k < own.cells.size(); ++k) own.cells.data()[k] = k;
  take_as_lagrange_nodes(shared, "a.vtu");
  take_as_lagrange_nodes(own, "a.vtu");
  EXPECT_EQ(own.uv, shared.uv(all, Eigen::all));
  EXPECT_EQ(own.uv_rounding, shared.uv_rounding(all, Eigen::all));
}

// Both cells of an edge have equal bits of its control points, with shared points or without.
TEST(LagrangeCell, EdgesStayContinuous) {
  for (int degree = 2; degree <= 8; ++degree) {
    SCOPED_TRACE(degree);
    expect_same_on_points_of_their_own(random_strip(degree, 6, static_cast<unsigned>(degree)));
  }
}

// Along an edge where the first terms of (-5 a + 18 b - 9 c + 2 d) / 6 cancel, digits of the sum
// depend on the order of terms. Both cells agree.
TEST(LagrangeCell, EdgesAreSummedInOneOrder) {
  const std::vector<int> edge = bezier_edge_points(3, 1);
  for (unsigned seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    MapFile map = random_strip(3, 2, seed);
    map.uv(map.cells(0, edge[0]), 0) = 0x1p85 * 18;
    map.uv(map.cells(0, edge[1]), 0) = 0x1p85 * 5;
    expect_same_on_points_of_their_own(map);
  }
}

// Two cells share an edge except for one of its two inner points: the other inner point would be on
// two curves.
TEST(LagrangeCell, RefusesEdgesThatArePartlyShared) {
  for (const std::size_t inner : {1, 2}) {
    MapFile map = random_strip(3, 2, 1);
    map.cells(1, bezier_edge_points(3, 0)[inner]) = map.cells(0, 9);  // its interior point
    expect_contains(
        error_message(ErrorKind::Unreadable, [&] { take_as_lagrange_nodes(map, "a.vtu"); }),
        {"a.vtu: cell 1: its point", "on another curve"});
  }
}

TEST(LagrangeCell, RefusesPointsOnTwoCurves) {
  MapFile map = random_strip(3, 2, 1);
  map.cells(1, 7) = map.cells(0, 3);  // the inner point of another edge
  expect_contains(
      error_message(ErrorKind::Unreadable, [&] { take_as_lagrange_nodes(map, "a.vtu"); }),
      {"a.vtu: cell 1: its point 7"});
}

TEST(LagrangeCell, RefusesHighDegrees) {
  MapFile map = random_strip(11, 1, 1);
  expect_contains(
      error_message(ErrorKind::Unreadable, [&] { take_as_lagrange_nodes(map, "a.vtu"); }),
      {"degree 11", "up to 10"});
  const TemporaryFolder folder;
  expect_contains(error_message(ErrorKind::Unsupported,
                                [&] { write_vtu(folder.file("a.vtu"), map, VtuCells::Lagrange); }),
                  {"cannot write", "the map 11"});
}

TEST(LagrangeCell, VtuReadsBack) {
  const TemporaryFolder folder;
  for (int degree = 1; degree <= 8; ++degree) {
    const MapFile map = random_strip(degree, 5, static_cast<unsigned>(degree));
    write_vtu(folder.file("map.vtu"), map, VtuCells::Lagrange);
    const MapFile read = read_vtu(folder.file("map.vtu"));
    EXPECT_EQ(read.points, map.points);
    EXPECT_EQ(read.cells, map.cells);
    EXPECT_EQ(read.claims, map.claims);
    EXPECT_LE((read.uv - map.uv).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_EQ(degree > 1, read.uv_rounding.rows() > 0);
  }
}

// A cell with det J = 2 r at one corner, where rounding is about r.
TEST(LagrangeCell, NearlyInvertedCellsAreNotProven) {
  const auto verdict = [](double height) {
    MapFile map;
    map.degree = 2;
    map.cells.resize(1, 6);
    map.cells << 0, 1, 2, 3, 4, 5;
    map.points.resize(6, 3);
    map.points << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0.5, 0, 0, 0.5, 0.5, 0, 0, 0.5, 0;
    map.uv.resize(6, 2);
    map.uv << 0.1, 0.1, 1.1, 0.1, 0.1, 1.1, 0.6, 0.1, 0.6, 0.6, 0.6, 0.1 + height;
    const TemporaryFolder folder;
    write_vtu(folder.file("a.vtu"), map, VtuCells::Lagrange);
    EXPECT_EQ(MapProof(map, "a.vtu", {}).positive.answer, ProofStatus::Proven);
    return MapProof(read_vtu(folder.file("a.vtu")), "a.vtu", {}).positive.answer;
  };
  EXPECT_EQ(verdict(1e-13), ProofStatus::Proven);
  EXPECT_EQ(verdict(1e-16), ProofStatus::Undecided);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
