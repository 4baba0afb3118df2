// All terms: energies of lambdas, their derivatives by dual numbers, and soft linear constraints.
// Not for densities of a Jacobian: energies/energies.h.
//
//   const auto barrier = make_term<1>("x0 > 1", Cells::Zero(1, 1), [](Index, const auto& z) {
//     using std::log;
//     return -log(z[0] - 1.0);
//   });
//
// The headers:
//     list_term.h                 make_term() for elements of any size: polygons
//     local_term.h                make_term(): any function of few unknowns an element; loads
//     least_squares.h             residuals, Gauss-Newton; robust losses
//     dual_matrix.h               vectors and matrices of dual numbers; SVD of 2 by 2 and 3 by 3
//     parameter_blocks.h          terms of blocks of unknowns of different sizes
//     quadratic_penalty.h         soft constraints
//     equality.h                  g(x) = 0 for an element, exactly
//     inequality.h                g(x) > 0 for an element, and its barrier; bounds of unknowns
//     manifold_problem.h          unknowns on spheres, rotations and manifolds of your own
//     manifold_sensitivity.h      derivatives of such solutions by data
#pragma once

#include "majorant/framework/terms/dual_matrix.h"
#include "majorant/framework/terms/equality.h"
#include "majorant/framework/terms/inequality.h"
#include "majorant/framework/terms/least_squares.h"
#include "majorant/framework/terms/list_term.h"
#include "majorant/framework/terms/local_term.h"
#include "majorant/framework/terms/manifold_problem.h"
#include "majorant/framework/terms/manifold_sensitivity.h"
#include "majorant/framework/terms/parameter_blocks.h"
#include "majorant/framework/terms/quadratic_penalty.h"

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
