// The identities by which gradient_products suffice: gradients and products of gradients are sparse
// combinations of first and gradient_product rows.
#include <gtest/gtest.h>

#include "majorant/elements/bernstein_space.h"
#include "support.h"

namespace majorant {
namespace {

class Table : public testing::TestWithParam<int> {
 protected:
  Table() : rule_(guarded_rule(radon_rule(), 2, 0.1)), table_(make()) {}
  ContractionTable make() const {
    Cells face(1, 3);
    face << 0, 1, 2;
    return BezierTriangleSpace(face, 3, GetParam()).tabulate(rule_);
  }
  int n() const { return GetParam(); }
  Quadrature rule_;
  ContractionTable table_;
};

TEST_P(Table, Shapes) {
  EXPECT_EQ(table_.nodes, control_point_count(n()));
  EXPECT_EQ(table_.weights, rule_.weights);
  EXPECT_EQ(table_.directions.cols(), 2);
  EXPECT_EQ(table_.shape_gradient.rows(), rule_.size());
  EXPECT_EQ(table_.gradient_product.rows(), rule_.size());
  EXPECT_EQ(table_.shape_gradient.cols(), n() * (n() + 1) / 2);
  EXPECT_EQ(table_.gradient_product.cols(), control_point_count(2 * n() - 2));
  const auto pairs = static_cast<std::size_t>(table_.nodes * (table_.nodes + 1) / 2);
  ASSERT_EQ(table_.pair_starts.size(), pairs + 1);
  EXPECT_EQ(table_.pair_starts.front(), 0);
  EXPECT_EQ(table_.pair_starts.back(), static_cast<int>(table_.hessian.size()));
}

// Returns derivatives in the table's directions, D by 1 per node.
Eigen::MatrixXd directional(const ContractionTable& t, Index l) {
  Eigen::MatrixXd d = Eigen::MatrixXd::Zero(t.nodes, t.directions.rows());
  for (const GradientEntry& e : t.gradient)
    d(e.node, e.direction) += e.coefficient * t.shape_gradient(l, e.shape_gradient);
  return d;
}

TEST_P(Table, GradientsAreRecombinedFirstRows) {
  for (Index l = 0; l < rule_.size(); ++l) {
    const Eigen::MatrixXd g =
        directional(table_, l) * table_.directions;  // in reference coordinates
    EXPECT_LE((g - bernstein_gradients(n(), rule_.points.row(l))).norm(), 1e-12 * n());
  }
}

TEST_P(Table, ProductsAreRecombinedMoments) {
  const auto dirs = table_.directions.rows();
  for (Index l = 0; l < rule_.size(); ++l) {
    const Eigen::MatrixXd d = directional(table_, l);
    std::size_t p = 0;
    for (int i = 0; i < table_.nodes; ++i)
      for (int j = 0; j <= i; ++j, ++p) {
        Eigen::MatrixXd product = Eigen::MatrixXd::Zero(dirs, dirs);
        for (int q = table_.pair_starts[p]; q < table_.pair_starts[p + 1]; ++q) {
          const HessianEntry& e = table_.hessian[static_cast<std::size_t>(q)];
          product(e.direction_i, e.direction_j) +=
              e.coefficient * table_.gradient_product(l, e.gradient_product);
        }
        EXPECT_LE((product - d.row(i).transpose() * d.row(j)).norm(), 1e-12 * n() * n());
      }
  }
}

// method.md section 4: 6, 48, 180 terms for n = 1, 2, 3 (pairs i >= j, after symmetry).
TEST_P(Table, EntriesAreSparse) {
  EXPECT_EQ(table_.gradient.size(), static_cast<std::size_t>(3 * n() * (n() + 1) / 2));
  EXPECT_LE(table_.hessian.size(), static_cast<std::size_t>(9 * table_.nodes * table_.nodes));
  for (std::size_t p = 0; p + 1 < table_.pair_starts.size(); ++p)
    EXPECT_LE(table_.pair_starts[p + 1] - table_.pair_starts[p], 9);
}

INSTANTIATE_TEST_SUITE_P(Degrees, Table, testing::Range(1, 9));

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
