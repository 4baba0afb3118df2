// The densities the library ships, as a list of types: kernels are compiled for every instruction
// set from it (kernels/builtin_kernels.cpp). A new file in densities/ becomes a named energy by its
// #include and type here and one line in named_energies.cpp (docs/add_an_energy.md).
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

using BuiltinDensities =
    std::tuple<decltype(symmetric_dirichlet_density()), decltype(asap_density()),
               decltype(mips_density()), decltype(arap_density()),
               decltype(symmetric_arap_density()), decltype(log_isometric_density()),
               decltype(authalic_density()), decltype(amips_exponential_density())>;

}  // namespace majorant
