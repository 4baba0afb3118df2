#include "majorant/constraints/fixed_unknowns.h"

namespace majorant {

void FixedUnknowns::append_rows(ConstraintRows& rows) const {
  for (const FixedUnknown& u : unknowns_) {
    rows.begin_row("unknown " + std::to_string(u.unknown));
    rows.add(u.unknown, 1);
    rows.end_row(u.value);
  }
}

}  // namespace majorant
