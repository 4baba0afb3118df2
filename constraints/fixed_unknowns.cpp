#include "majorant/constraints/constraints.h"
#include "majorant/framework/argument_check.h"

namespace majorant {

void FixedUnknowns::append_rows(ConstraintRows& rows) const {
  for (const FixedUnknown& u : unknowns_) {
    require_at_least("FixedUnknowns: an unknown", u.unknown, 0);
    rows.begin_row("unknown " + std::to_string(u.unknown));
    rows.add(u.unknown, 1);
    rows.end_row(u.value);
  }
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
