// Discretized fields and chains, as in [ACMX92] and [GOT15], and degenerate functions.
#pragma once

#include "suite.h"

namespace majorant::newton_suite {

SuiteInstance minimal_surface(int n);
SuiteInstance torsion(int n, double barrier);  // |u| bounded by the distance to the border
SuiteInstance bratu(int n, double lambda);
SuiteInstance p_laplacian(int n, double power);
SuiteInstance double_well_chain(int n, double coupling);
SuiteInstance phase_field(int n);         // a double well in the plane, -1 and 1 at the border
SuiteInstance ginzburg_landau(int n);     // one vortex
SuiteInstance director_field(int n);      // angles of a nematic, cos 2 (a - b)
SuiteInstance total_variation(int n);     // smoothed, of a noisy step
SuiteInstance analytic_center(int rows);  // of a polytope: sum of -log distance to its planes
SuiteInstance chained_rosenbrock(int n);
SuiteInstance engval1(int n);
SuiteInstance arwhead(int n);
SuiteInstance bdqrtic(int n);
SuiteInstance nondquar(int n);
SuiteInstance dqrtic(int n);
SuiteInstance sinquad(int n);
SuiteInstance cragglvy(int n);

SuiteInstance quadratic();               // z0^2 + (z1 - 1)^2
SuiteInstance stiff_quadratic(int n);    // eigenvalues from 1e-6 to 1e6
SuiteInstance quartic_chain(int n);      // sum of (z_i - z_i+1)^4 and z_0^4
SuiteInstance crossing_valleys();        // (x y)^2 and a weak pull
SuiteInstance saddle();                  // x^2 - y^2 + y^4, beside the saddle
SuiteInstance monkey_saddle();           // x^3 - 3 x y^2 + (x^2 + y^2)^2 / 4
SuiteInstance many_saddles(int n);       // x_i^2 - y_i^2 + y_i^4, coupled
SuiteInstance logarithm();               // -log x: no minimum
SuiteInstance linear();                  // no minimum
SuiteInstance distances_squared(int n);  // (|a - b|^2 - l^2)^2, free in the plane

}  // namespace majorant::newton_suite

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
