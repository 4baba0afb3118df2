// An oracle of many tests, compiled once, since Eigen's templates of it take seconds to compile.
#pragma once

#include <Eigen/Core>

namespace majorant::test {

// Returns the singular values by Jacobi rotations, in descending order.
Eigen::VectorXd singular_values(const Eigen::MatrixXd& matrix);

}  // namespace majorant::test

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
