#include "majorant/framework/iteration.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace majorant {

std::string_view status_name(Status status) {
  switch (status) {
    case Status::Converged:
      return "converged";
    case Status::MaxIterations:
      return "max_iterations";
    case Status::TimeLimit:
      return "time_limit";
    case Status::Interrupted:
      return "interrupted";
    case Status::Stalled:
      return "stalled";
    case Status::Infeasible:
      return "infeasible";
    case Status::Failed:
      return "failed";
  }
  return "failed";
}

Status stopped_status(Directive why) {
  return why == Directive::TimeLimit ? Status::TimeLimit : Status::Interrupted;
}

double relative_to(double energy, double value) {
  return value / std::max(std::abs(energy), std::numeric_limits<double>::min());
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
