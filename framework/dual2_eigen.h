// Dual numbers as the scalars of Eigen's small matrices, mixed with doubles:
//
//   Eigen::Matrix<Dual2<double, 4>, 2, 2> J;   // or Dual1
//   const Eigen::Matrix2d rest_inverse = Eigen::Matrix2d::Identity();
//   const auto det = (J * rest_inverse).determinant();
//
// Norms, products, determinants and inverses up to 4 by 4 work; decompositions do not.
#pragma once

#include <Eigen/Core>

#include "majorant/framework/dual2.h"

namespace Eigen {

template <int N, int Order>
struct NumTraits<majorant::Dual<double, N, Order>> : NumTraits<double> {
  using Real = majorant::Dual<double, N, Order>;
  using NonInteger = Real;
  using Nested = Real;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = Order == 2 ? N * N / 2 : N,
    AddCost = ReadCost,
    MulCost = Order == 2 ? 3 * N * N : 2 * N
  };
};

template <int N, int Order, class Operation>
struct ScalarBinaryOpTraits<majorant::Dual<double, N, Order>, double, Operation> {
  using ReturnType = majorant::Dual<double, N, Order>;
};
template <int N, int Order, class Operation>
struct ScalarBinaryOpTraits<double, majorant::Dual<double, N, Order>, Operation> {
  using ReturnType = majorant::Dual<double, N, Order>;
};

}  // namespace Eigen

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
