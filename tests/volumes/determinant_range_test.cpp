// Bounds of det J on single cells with known minimum. Random cells against rational subdivision:
// tests/checker/volume_cells_test.py.
#include "majorant/volumes/determinant_range.h"

#include <gtest/gtest.h>

#include <cmath>

#include "majorant/volumes/internal/reference_cell.h"
#include "majorant/volumes/node_orders.h"
#include "random.h"

namespace majorant {
namespace {

const std::vector<CellType> kTypes{
    {CellShape::Triangle, 1},
    {CellShape::Triangle, 4},
    {CellShape::Quad, 1},
    {CellShape::Quad, 3},
    {CellShape::Tetrahedron, 1},
    {CellShape::Tetrahedron, 2},
    {CellShape::Tetrahedron, 4},
    {CellShape::Wedge, 1},
    {CellShape::Wedge, 3},
    {CellShape::Hexahedron, 1},
    {CellShape::Hexahedron, 2},
    {CellShape::Hexahedron, 3},
    {CellShape::Quad, 2, NodeKind::Uniform, NodeSet::Serendipity},
    {CellShape::Wedge, 2, NodeKind::Uniform, NodeSet::Serendipity},
    {CellShape::Hexahedron, 2, NodeKind::Uniform, NodeSet::Serendipity},
    {CellShape::Tetrahedron, 3, NodeKind::GaussLobatto},
    {CellShape::Quad, 4, NodeKind::GaussLobatto},
    {CellShape::Tetrahedron, 3, NodeKind::ControlPoints}};

// Returns reference coordinates of the nodes of a cell on a uniform lattice, also for control
// points.
std::vector<double> reference_nodes(const CellType& type) {
  const BernsteinElement element = bernstein_element(type.shape, type.degree);
  const auto place = [&](int e) {
    if (type.kind != NodeKind::GaussLobatto) return static_cast<double>(e) / type.degree;
    const double inner = type.degree == 3 ? 0.5 - std::sqrt(0.05) : 0.5 - std::sqrt(3.0 / 28);
    const std::vector<double> x = type.degree == 3
                                      ? std::vector<double>{0, inner, 1 - inner, 1}
                                      : std::vector<double>{0, inner, 0.5, 1 - inner, 1};
    return x[to_size(e)];
  };
  std::vector<double> out;
  const std::vector<Exponents> nodes = vtk_order(type.shape, type.degree);
  for (int k = 0; k < type.node_count(); ++k) {
    const Exponents& e = nodes[to_size(k)];
    std::size_t slot = 0;
    for (const int corners : element.factors) {
      double sum = 0;
      for (int c = 0; c < corners; ++c) sum += place(e[slot + to_size(c)]);
      for (int c = 1; c < corners; ++c) out.push_back(place(e[slot + to_size(c)]) / sum);
      slot += to_size(corners);
    }
  }
  return out;
}

// Applies x -> A x + b to all nodes, det A = det.
std::vector<double> affine(std::vector<double> nodes, int dim, double det, double shift) {
  for (std::size_t k = 0; k < nodes.size(); k += to_size(dim)) {
    nodes[k] = det * nodes[k] + 0.25 * nodes[k + 1] + shift;
    nodes[k + 1] += shift;
  }
  return nodes;
}

TEST(DeterminantRange, OfAffineCellsIsTheirDeterminant) {
  for (const CellType& type : kTypes)
    for (const double det : {2.0, 1e-3, -0.5}) {
      const int dim = dimension(type.shape);
      const std::vector<double> nodes = affine(reference_nodes(type), dim, det, 0);
      const DeterminantRange range = determinant_range(type, nodes.data());
      EXPECT_EQ(range.positive, det > 0 ? ProofStatus::Proven : ProofStatus::Violated)
          << describe(type);
      EXPECT_LE(range.low, det + 1e-12);
      EXPECT_GE(range.high, det - 1e-12);
      EXPECT_NEAR(range.low, det, 1e-2 * std::abs(det)) << describe(type);
      EXPECT_NEAR(range.high, det, 1e-2 * std::abs(det)) << describe(type);
      EXPECT_NEAR(range.largest, det, 1e-6) << describe(type);
    }
}

TEST(DeterminantRange, FarFromTheOriginOnlyTheDoublesCount) {
  for (const CellType& type : kTypes) {
    const std::vector<double> nodes =
        affine(reference_nodes(type), dimension(type.shape), 1, 1 << 20);
    EXPECT_EQ(determinant_range(type, nodes.data()).positive, ProofStatus::Proven)
        << describe(type);
  }
}

// The edge 01 of a triangle of degree 2 is curved: x(s) has the derivative 0 at corner 0 if the
// node is at a quarter.
TEST(DeterminantRange, ExactlyZeroAtACornerIsNoProof) {
  const CellType type{CellShape::Triangle, 2};
  std::vector<double> nodes = reference_nodes(type);
  const std::size_t middle = 3;  // of the edge 01
  nodes[2 * middle] = 0.25;
  const DeterminantRange zero = determinant_range(type, nodes.data());
  EXPECT_EQ(zero.positive, ProofStatus::Violated);
  EXPECT_EQ(zero.high, 0);
  nodes[2 * middle] = std::nextafter(0.25, 1);
  const DeterminantRange above = determinant_range(type, nodes.data());
  EXPECT_EQ(above.positive, ProofStatus::Proven);
  EXPECT_GT(above.high, 0);
  EXPECT_LT(above.high, 1e-14);
  nodes[2 * middle] = std::nextafter(0.25, 0);
  EXPECT_EQ(determinant_range(type, nodes.data()).positive, ProofStatus::Violated);
}

TEST(DeterminantRange, NonFiniteNodesAreUndecided) {
  const CellType type{CellShape::Tetrahedron, 2};
  std::vector<double> nodes = reference_nodes(type);
  nodes[4] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(determinant_range(type, nodes.data()).positive, ProofStatus::Undecided);
  EXPECT_EQ(exact_determinant_range(type, nodes.data()).positive, ProofStatus::Undecided);
}

// Integer arithmetic has the same result, for cells of any size.
TEST(DeterminantRange, ExactlyTheSame) {
  test::Random random(3);
  for (const CellType& type : kTypes)
    for (int trial = 0; trial < 4; ++trial) {
      std::vector<double> nodes = reference_nodes(type);
      const double scale = std::ldexp(1.0, 60 * (trial - 2)), spread = 0.4 / type.degree;
      for (double& x : nodes) x = scale * (x + spread * random.uniform());
      const DeterminantRange one = determinant_range(type, nodes.data());
      const DeterminantRange two = exact_determinant_range(type, nodes.data());
      EXPECT_NE(two.positive, ProofStatus::Undecided);
      EXPECT_EQ(one.positive, two.positive) << describe(type);
      EXPECT_LE(one.low, two.high) << describe(type);
      EXPECT_LE(two.low, one.high) << describe(type);
      EXPECT_LE(one.low, one.high);
      EXPECT_LE(two.low, two.high);
    }
}

TEST(DeterminantRange, ThePlaceOfTheLeastHasThatValue) {
  test::Random random(8);
  const CellType type{CellShape::Tetrahedron, 3};
  std::vector<double> nodes = reference_nodes(type);
  for (double& x : nodes) x += 0.05 * random.uniform();
  const DeterminantRange range = determinant_range(type, nodes.data());
  // By differences of adjacent points.
  const double h = 1e-5;
  Eigen::Matrix3d j;
  const Vector3 here = point_of_cell(type, nodes.data(), range.at);
  for (std::size_t d = 0; d < 3; ++d) {
    auto there = range.at;
    there[d + 1] += h;
    there[0] -= h;
    j.col(static_cast<Index>(d)) = (point_of_cell(type, nodes.data(), there) - here) / h;
  }
  EXPECT_NEAR(j.determinant(), range.high, 1e-3);
}

TEST(ScaledJacobian, OfRegularCellsIsOne) {
  const double root3 = std::sqrt(3.0), root2 = std::sqrt(2.0);
  const Vector3 up = Vector3::UnitZ();
  const std::vector<double> triangle{0, 0, 0, 1, 0, 0, 0.5, root3 / 2, 0};
  EXPECT_NEAR(sampled_scaled_jacobian({CellShape::Triangle, 1}, triangle.data(), up), 1, 1e-12);
  const std::vector<double> tetrahedron{0,   0,         0, 1,   0,         0,
                                        0.5, root3 / 2, 0, 0.5, root3 / 6, root2 / root3};
  EXPECT_NEAR(sampled_scaled_jacobian({CellShape::Tetrahedron, 1}, tetrahedron.data(), up), 1,
              1e-12);
  std::vector<double> cube = reference_nodes({CellShape::Hexahedron, 2});
  for (std::size_t k = 0; k < cube.size(); k += 3) cube[k] *= 7;  // boxes have right angles
  EXPECT_NEAR(sampled_scaled_jacobian({CellShape::Hexahedron, 2}, cube.data(), up), 1, 1e-12);
  const std::vector<double> wedge{0, 0, 0, 1, 0, 0, 0.5, root3 / 2, 0,
                                  0, 0, 2, 1, 0, 2, 0.5, root3 / 2, 2};
  EXPECT_NEAR(sampled_scaled_jacobian({CellShape::Wedge, 1}, wedge.data(), up), 1, 1e-12);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
