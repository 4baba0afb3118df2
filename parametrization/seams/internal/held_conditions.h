// Conditions C chi = 0 on the minimum of a quadratic energy, and the energy that releasing some of
// them adds.
//
//   HeldConditions conditions(Eigen::MatrixXd::Identity(8, 8), Vec::Ones(8));
//   if (conditions.added_strain({4, 5}) < 0.01) conditions.release({4, 5});
//
// Let A be the matrix of the energy, G = C A^-1 C^T, P = G^-1, x = P C chi with the chi that has no
// conditions. Releasing some of them (rows R) adds
//     x_R^T P_RR^-1 x_R
// to the strain, and P, x of the rest follow from P, x. This costs half a solve for each row, and
// none for a query.
#pragma once

#include <vector>

#include "majorant/framework/types.h"

namespace majorant {

class HeldConditions {
 public:
  HeldConditions() = default;  // none
  // responses: G. values: C chi.
  HeldConditions(Eigen::MatrixXd responses, const Vec& values);

  // rows: conditions that are held, all different.
  double added_strain(const std::vector<Index>& rows) const;
  void release(const std::vector<Index>& rows);

 private:
  std::vector<Index> places_of(const std::vector<Index>& rows) const;
  void drop(Index row);

  std::vector<Index> place_;   // of every condition in P and x
  Index held_ = 0;             // rows of P and x that are not released: the first ones
  Eigen::MatrixXd precision_;  // P
  Vec force_;                  // x
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
