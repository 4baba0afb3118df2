// A thick ring in plane strain whose inner side is pushed outwards: pressures of elements with a
// projected dilatation against the solution of the incompressible ring, which is an integral.
#pragma once

#include <string>
#include <vector>

namespace majorant::elasticity {

struct RingElement {
  const char* name;
  bool is_product, is_solid;  // quadrilaterals or hexahedra; in space, with the ends held
  int degree, pressure_degree;
};

// Errors and jumps in parts of the range of the pressure: the largest at corners of elements, and
// between elements with a common corner.
struct RingResult {
  int elements = 0, unknowns = 0, iterations = 0, factorizations = 0;
  bool has_converged = false;
  double error = 0, jump = 0;
};

const std::vector<RingElement>& ring_elements();
// n elements across, 2 n around a quarter.
RingResult solve_ring(const RingElement& element, int n, double nu);

}  // namespace majorant::elasticity

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
