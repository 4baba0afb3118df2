// Sparse recombination entries of a contraction (element_space.h). They are plain data without
// includes: kernels compiled for special instruction sets use no other part of the library.
#pragma once

namespace majorant {

struct GradientEntry {  // d_a B_node contains coefficient * first_k
  int node, direction, shape_gradient;
  double coefficient;
};

struct HessianEntry {  // d_a B_i d_b B_j contains coefficient * gradient_product_m
  int direction_i, direction_j, gradient_product;
  double coefficient;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
