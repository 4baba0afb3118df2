#include "majorant/framework/barrier_path.h"

#include <string>

#include "majorant/framework/error.h"

namespace majorant {

const BarrierChecker* HeldBounds::violated(VecIn x) const {
  for (const auto& bound : bounds_)
    if (!bound->check(x).feasible) return bound.get();
  return nullptr;
}

void HeldBounds::hold(VecIn x) {
  held_.clear();
  barriers_.clear();
  for (const auto& bound : bounds_) {
    held_.push_back(bound->check(x).feasible ? bound : bound->relaxed(x));
    if (!held_.back() || !held_.back()->check(x).feasible)
      throw InvalidArgument("bound '" + std::string(bound->name()) +
                            "': relaxed(x) is null, or x does not meet it either");
    barriers_.push_back(held_.back()->barrier());
  }
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
