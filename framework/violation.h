// How far a point violates a bound, as an energy: what leads a start inside, and tells whether
// there is an inside.
//
//   struct Below final : ViolationMeasure {
//     std::shared_ptr<const EnergyTerm> violation(double margin) const override {
//       return make_term<1>("below 1", Cells{{0}}, [=](Index, const auto& z) {
//         auto missing = z[0] - 1.0 + margin;  // g = 1 - z
//         if (missing <= 0) missing = 0.0;
//         return missing * missing;
//       });
//     }
//   };
//
// BarrierMinimizer::of_bounds() asks bounds that are one beside a BarrierChecker. Other bounds are
// relaxed and tightened instead, which ends without an answer where bounds hold each other back.
#pragma once

#include <memory>

#include "majorant/framework/energy_term.h"

namespace majorant {

class ViolationMeasure {
 public:
  virtual ~ViolationMeasure() = default;
  // max(0, margin - g)^2 of the rooms g that the bound wants positive, finite wherever g is. The
  // elements of the bound's barrier(), with one room each.
  virtual std::shared_ptr<const EnergyTerm> violation(double margin) const = 0;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
