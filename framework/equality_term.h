// A term whose elements are equalities g = 0, as an augmented Lagrangian has them ([NW06]
// Sec. 17.3):
//     l g + r g^2 / 2,
// with two parameters an element: its multiplier l and its penalty r. equality()
// (framework/terms/equality.h) makes such terms, BarrierMinimizer moves the parameters until g = 0.
//
//   const TermState shows_g{.parameters = Eigen::Vector2d(1, 0)};   // of one element: its energy
//                                                                   // is g, its gradient that of g
//
// Not for what is linear in the unknowns: that is eliminated (constraint.h).
#pragma once

namespace majorant {

// EnergyTerm::parameters_per_element() is 2, in the order above; those that the term was made with
// are 0 and 1.
class EqualityTerm {
 public:
  virtual ~EqualityTerm() = default;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
