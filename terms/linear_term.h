// A linear energy c.x: loads, gravity, prices.
//
//   Vec pull = Vec::Zero(3 * 20);
//   pull[3 * 19 + 2] = -9.81;                          // at node 19, against z
//   builder.add(linear_term("weight", -pull), 1.0);    // the energy of a load is -f.x
//
// Without bound below by itself: something else has to hold x.
#pragma once

#include <memory>
#include <string>

#include "majorant/framework/energy_term.h"

namespace majorant {

// coefficients: one for each of the full unknowns; those that are 0 cost nothing. Throws
// Error where one is not finite. Supports every curvature: it has none.
std::shared_ptr<const EnergyTerm> linear_term(std::string name, Vec coefficients);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
