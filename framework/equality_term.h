// A term whose elements are equalities g = 0, in the form of an augmented Lagrangian ([NW06] Sec.
// 17.3):
//     l g + r g^2 / 2,
// with two parameters an element: its multiplier l and its penalty r. equality()
// (framework/terms/equality.h) makes such terms, BarrierMinimizer moves the parameters until g = 0.
//
//   const TermState shows_g{.parameters = Eigen::Vector2d(1, 0)};   // of one element: its energy
//                                                                   // is g, its gradient that of g
//
// Not for equations that are linear in the unknowns, which are eliminated (constraint.h).
#pragma once

namespace majorant {

// The first parameters of the term are these two of each element, in the order above; the initial
// ones are 0 and 1.
class EqualityTerm {
 public:
  virtual ~EqualityTerm() = default;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
