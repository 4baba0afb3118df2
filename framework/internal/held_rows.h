// The linear constraints of a problem as data of its minimum: how right-hand sides move the
// unknowns, and how a function of the minimum depends on them.
#pragma once

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <Eigen/SparseQR>
#include <optional>
#include <vector>

#include "majorant/framework/problem.h"
#include "majorant/framework/types.h"

namespace majorant {

class HeldRows {
 public:
  // problem, x: the minimum, full unknowns. Both must outlive this.
  HeldRows(const Problem& problem, const Vec& x) : problem_(problem), x_(x) {}

  Index count() const;
  // Returns what the full unknowns move along a change of the right-hand sides where the unknowns
  // of the problem stay. Throws InvalidArgument for another number of rows.
  Vec moved(const Vec& change) const;
  // Returns H moved, full unknowns, of a vector of moved().
  Vec curvature_of(const Vec& moved);
  // Returns dL/db of a function L of the minimum, by all rows: the multipliers lambda with
  //     A^T lambda = dL/dx - H u,
  // u the full unknowns of the adjoint state. Z^T takes the right-hand side to 0.
  Vec multipliers(const Vec& slope, const Vec& u);

 private:
  using Coupling = Eigen::SparseMatrix<double, Eigen::RowMajor>;

  Vec held_of(const Vec& x) const;
  const Coupling& coupling();
  void number_held();
  void factorize_rows();

  const Problem& problem_;
  const Vec& x_;
  std::vector<Index> held_;           // by full unknown: its place in held_unknowns_, or -1
  std::vector<Index> held_unknowns_;  // the unknowns of the rows
  Index held_count_ = 0;              // auxiliary ones included
  std::optional<Coupling> coupling_;
  std::optional<Eigen::SparseQR<Eigen::SparseMatrix<double>, Eigen::COLAMDOrdering<int>>> factors_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
