#include "majorant/framework/energy_term.h"

namespace majorant {

std::string_view curvature_name(Curvature curvature) {
  switch (curvature) {
    case Curvature::Projected:
      return "projected";
    case Curvature::Majorizer:
      return "majorizer";
    case Curvature::CompositeMajorizer:
      return "paper-majorizer";
    case Curvature::Exact:
      return "exact";
    case Curvature::Reweighted:
      return "reweighted";
  }
  return "unknown";
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
