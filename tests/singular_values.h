// An oracle of many tests, compiled once: Eigen's templates of it take a compiler seconds wherever
// they are used.
#pragma once

#include <Eigen/Core>

namespace majorant::test {

// By Jacobi rotations, falling.
Eigen::VectorXd singular_values(const Eigen::MatrixXd& matrix);

}  // namespace majorant::test

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
