// Functions of [MGH81]: energies |r|^2 / 2 with one element per residual.
#pragma once

#include "suite.h"

namespace majorant::newton_suite {

SuiteInstance rosenbrock();
SuiteInstance rosenbrock_as_term();  // one element, f / 2
SuiteInstance extended_rosenbrock(int pairs);
SuiteInstance freudenstein_roth();
SuiteInstance powell_badly_scaled();
SuiteInstance brown_badly_scaled();
SuiteInstance beale();
SuiteInstance beale_as_term();
SuiteInstance jennrich_sampson();
SuiteInstance helical_valley();
SuiteInstance bard();
SuiteInstance gaussian();
SuiteInstance gulf();
SuiteInstance box_3d();
SuiteInstance powell_singular(int fours);
SuiteInstance wood();
SuiteInstance wood_as_term();
SuiteInstance kowalik_osborne();
SuiteInstance brown_dennis();
SuiteInstance biggs_exp6();
SuiteInstance watson();
SuiteInstance penalty_1();
SuiteInstance penalty_2();
SuiteInstance variably_dimensioned();
SuiteInstance trigonometric();
SuiteInstance brown_almost_linear();
SuiteInstance discrete_boundary_value(int size);
SuiteInstance broyden_tridiagonal(int size);
SuiteInstance broyden_banded(int size);
SuiteInstance linear_rank_1();
SuiteInstance chebyquad();

}  // namespace majorant::newton_suite

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
