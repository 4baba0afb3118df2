// Dual2 as the scalar of Eigen's small matrices, mixed with doubles:
//
//   Eigen::Matrix<Dual2<double, 4>, 2, 2> J;
//   const Eigen::Matrix2d rest_inverse = Eigen::Matrix2d::Identity();
//   const auto det = (J * rest_inverse).determinant();
//
// Norms, products, determinants and inverses up to 4 by 4 work; decompositions do not.
#pragma once

#include <Eigen/Core>

#include "majorant/framework/dual2.h"

namespace Eigen {

template <int N>
struct NumTraits<majorant::Dual2<double, N>> : NumTraits<double> {
  using Real = majorant::Dual2<double, N>;
  using NonInteger = Real;
  using Nested = Real;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = N * N / 2,
    AddCost = N * N / 2,
    MulCost = 3 * N * N
  };
};

template <int N, class Operation>
struct ScalarBinaryOpTraits<majorant::Dual2<double, N>, double, Operation> {
  using ReturnType = majorant::Dual2<double, N>;
};
template <int N, class Operation>
struct ScalarBinaryOpTraits<double, majorant::Dual2<double, N>, Operation> {
  using ReturnType = majorant::Dual2<double, N>;
};

}  // namespace Eigen

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
