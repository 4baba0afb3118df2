// Losses that bound what an outlier may cost, for make_least_squares().
//
//   const RobustLoss loss = cauchy_loss(0.1);
//   const auto [rho, slope, bend] = loss(9.0);   // of |r| = 3
//
// A loss is rho(s) with its first and second derivative, s = |r|^2 the squared residual of one
// element, rho(s) = s where s is small; the energy is rho(|r|^2) / 2. `width` is the |r| from which
// a residual counts as an outlier, in its units. Formulas are those of Ceres.
#pragma once

#include <array>
#include <functional>

namespace majorant {

// rho(s), rho'(s), rho''(s); empty: rho(s) = s.
using RobustLoss = std::function<std::array<double, 3>(double s)>;

// All throw Error unless width > 0.
RobustLoss huber_loss(double width);    // linear in |r| beyond the width; convex
RobustLoss soft_l1_loss(double width);  // the same, smooth
RobustLoss cauchy_loss(double width);   // logarithmic; not convex, as those below
RobustLoss arctan_loss(double width);   // bounded
RobustLoss tukey_loss(double width);    // constant beyond the width: outliers do not count at all

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
