// A thick ring in plane strain whose inner side is pushed outwards: pressures of elements with a
// projected dilatation against the solution of the incompressible ring, which is an integral.
#pragma once

#include <string>
#include <vector>

namespace majorant::elasticity {

struct RingElement {
  const char* name;
  bool is_product,
      is_solid;  // is_product: quadrilaterals or hexahedra; is_solid: in space, with the ends held
  int degree, pressure_degree;
};

// The largest error of the pressure at corners of elements, and its largest jump between elements
// with a common corner, relative to the range of the pressure.
struct RingResult {
  int elements = 0, unknowns = 0, iterations = 0, factorizations = 0;
  bool has_converged = false;
  double error = 0, jump = 0;
};

const std::vector<RingElement>& ring_elements();
// Solves a quarter ring with n elements across and 2 n around it.
RingResult solve_ring(const RingElement& element, int n, double nu);

}  // namespace majorant::elasticity

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
