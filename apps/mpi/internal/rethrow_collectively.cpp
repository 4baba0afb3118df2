#include "apps/mpi/internal/rethrow_collectively.h"

namespace majorant {

void rethrow_collectively(const Ranks& ranks, const std::exception_ptr& failure) {
  const int first =
      static_cast<int>(ranks.min(static_cast<double>(failure ? ranks.rank() : ranks.count())));
  if (first == ranks.count()) return;
  if (first == ranks.rank()) std::rethrow_exception(failure);
  throw FailedElsewhere();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
