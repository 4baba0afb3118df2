// The list of the library's energies, from which their names for users (energy_factory.h) and their
// kernels for every instruction set (kernels/builtin_kernels.cpp) are made. A new file in
// densities/ becomes a named energy by its #include and its line here (docs/energies.md).
#pragma once

#include <tuple>

#include "majorant/energies/densities/amips_exponential.h"
#include "majorant/energies/densities/arap.h"
#include "majorant/energies/densities/asap.h"
#include "majorant/energies/densities/authalic.h"
#include "majorant/energies/densities/log_isometric.h"
#include "majorant/energies/densities/mips.h"
#include "majorant/energies/densities/symmetric_arap.h"
#include "majorant/energies/densities/symmetric_dirichlet.h"

namespace majorant {

template <class D>
struct BuiltinEnergy {
  using Density = D;
  D density;
  const char* summary;  // formula; where it is smallest, and its value there
};
template <class D>
BuiltinEnergy(D, const char*) -> BuiltinEnergy<D>;  // clang 14 does not deduce aggregates

inline auto builtin_energies() {
  return std::tuple{
      BuiltinEnergy{symmetric_dirichlet_density(), "|J|^2 + |J^-1|^2; isometry 4"},
      BuiltinEnergy{asap_density(), "(Sigma - sigma)^2, conformal; similarity 0"},
      BuiltinEnergy{mips_density(), "|J|^2 / det J, conformal; similarity 2"},
      BuiltinEnergy{arap_density(), "|J - R|^2; isometry 0"},
      BuiltinEnergy{symmetric_arap_density(), "|J - R|^2 + |J^-1 - R^-1|^2; isometry 0"},
      BuiltinEnergy{log_isometric_density(), "log^2 Sigma + log^2 sigma; isometry 0"},
      BuiltinEnergy{authalic_density(), "det J + 1 / det J, areas; equal areas 2"},
      BuiltinEnergy{amips_exponential_density(), "exp(5 ((mips + authalic) / 4 - 1)); isometry 1"},
  };
}
using BuiltinEnergies = decltype(builtin_energies());

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
