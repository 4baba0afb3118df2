// A minimal element space for tests: linear tetrahedra, one basis gradient each.
#pragma once

#include <Eigen/Dense>
#include <limits>
#include <memory>

#include "majorant/elements/element_space.h"
#include "majorant/elements/rest_shapes.h"

namespace majorant::test {

// d_a B_i = delta_ai in the four formal barycentric directions, so `first` and `gradient_product`
// are 1.
class LinearTetrahedra final : public ElementSpace {
 public:
  LinearTetrahedra(const Cells& cells, Index node_count) : cells_(cells), node_count_(node_count) {}
  int reference_dim() const override { return 3; }
  double reference_measure() const override { return 1.0 / 6; }
  const Cells& cells() const override { return cells_; }
  Index node_count() const override { return node_count_; }

  ContractionTable tabulate(const Quadrature& rule) const override {
    ContractionTable t;
    t.nodes = 4;
    t.directions.resize(4, 3);
    t.directions << -1, -1, -1, 1, 0, 0, 0, 1, 0, 0, 0, 1;
    t.weights = rule.weights;
    t.shape_gradient.setOnes(rule.size(), 1);
    t.gradient_product.setOnes(rule.size(), 1);
    t.pair_starts.push_back(0);
    for (int i = 0; i < 4; ++i) {
      t.gradient.push_back({i, i, 0, 1.0});
      for (int j = 0; j <= i; ++j) {
        t.hessian.push_back({i, j, 0, 1.0});
        t.pair_starts.push_back(static_cast<int>(t.hessian.size()));
      }
    }
    return t;
  }

  PositivityProof certify(Index e, VecIn x, int) const override {
    const double det = tangents(e, x).determinant();
    return {det > 0 ? ProofStatus::Proven : ProofStatus::Violated, det, 0};
  }
  double largest_step(Index, VecIn, VecIn, double s, int) const override { return s; }

  // Returns the columns x_1 - x_0, x_2 - x_0, x_3 - x_0.
  Eigen::Matrix3d tangents(Index e, VecIn x) const {
    Eigen::Matrix3d t;
    for (int k = 0; k < 3; ++k)
      t.col(k) = x.segment<3>(3 * cells_(e, k + 1)) - x.segment<3>(3 * cells_(e, 0));
    return t;
  }

 private:
  Cells cells_;
  Index node_count_;
};

inline Quadrature tetrahedron_centroid() {
  Quadrature rule;
  rule.cell = {4};
  rule.points.setConstant(1, 4, 0.25);
  rule.weights.setOnes(1);
  return rule;
}

}  // namespace majorant::test

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
