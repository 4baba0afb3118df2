// Eigenvalues of small dense symmetric matrices. Compiling Eigen's solver takes ten seconds for
// each size, so it is compiled once, here.
#pragma once

#include <Eigen/Core>

#include "majorant/framework/types.h"

namespace majorant {

struct SymmetricEigen {
  Vec values;               // ascending
  Eigen::MatrixXd vectors;  // of unit length, in the order of the values, one a column
};

// Reads the lower triangle of a square matrix, whose entries must be finite.
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& matrix);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
