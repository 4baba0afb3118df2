// Polynomials on an element on which the dilatation is projected (energies/solid.h): of total
// degree k in the coordinates of the reference cell, orthonormal by the points and weights of a
// rule.
//
//     theta(x_l) = sum_a phi_a(x_l) sum_m w_m phi_a(x_m) det J(x_m)
#pragma once

#include "majorant/elements/quadrature.h"
#include "majorant/framework/types.h"

namespace majorant {

struct DilatationModes {
  RowMatrix values;     // #L by #modes, at the points of the rule
  RowMatrix transform;  // #modes by #modes: modes are monomials times this
  int count() const { return static_cast<int>(transform.rows()); }
};

// Returns the monomials at some points, which are rows as in Quadrature::points: #points by #modes.
// Throws InvalidArgument for points of another cell.
RowMatrix dilatation_monomials(const Factors& cell, const RowMatrix& points, int degree);

// Returns the modes of a rule. weights: those of the rule, or these times the measure of a curved
// rest shape. Throws InvalidArgument unless degree is 0 to kMaxDilatationDegree and the rule has
// enough points.
DilatationModes dilatation_modes(const Quadrature& rule, const Vec& weights, int degree);

inline constexpr int kMaxDilatationDegree = 2;

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
