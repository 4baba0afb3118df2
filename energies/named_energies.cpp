#include <algorithm>
#include <tuple>
#include <utility>
#include <vector>

#include "majorant/energies/energy_factory.h"
#include "majorant/energies/internal/builtin_densities.h"
#include "majorant/energies/internal/instruction_sets.h"
#include "majorant/energies/make_energy.h"
#include "majorant/energies/vectorized.h"

namespace majorant {

#ifdef MAJORANT_X86_KERNELS
DensityKernels builtin_kernels_avx2(int index);
DensityKernels builtin_kernels_avx512(int index);
#endif

namespace {

template <class Density, class... All>
constexpr int position(const std::tuple<All...>*) {
  const bool same[] = {std::is_same_v<Density, typename All::Density>...};
  return static_cast<int>(std::find(std::begin(same), std::end(same), true) - std::begin(same));
}

// Kernels of the baseline instruction set are compiled in this file, so a changed density
// recompiles three files.
template <class Density>
EnergyFactory builtin(Density density, [[maybe_unused]] InstructionSet set) {
  constexpr int index = position<Density>(static_cast<const BuiltinEnergies*>(nullptr));
  static_assert(index < static_cast<int>(std::tuple_size_v<BuiltinEnergies>));
  DensityKernels kernels = vectorized(density);
#ifdef MAJORANT_X86_KERNELS
  if (set != InstructionSet::Baseline) {
    const auto baseline = kernels.local;
    kernels =
        set == InstructionSet::Avx512 ? builtin_kernels_avx512(index) : builtin_kernels_avx2(index);
    kernels.local_of_comparisons = baseline;
  }
#endif
  return energy_factory(std::move(density), kernels);
}

}  // namespace

std::vector<NamedEnergy> named_energies(InstructionSet set) {
  const auto named = [set](auto energy) {
    std::string name(energy.density.name());
    return NamedEnergy{std::move(name), energy.summary, builtin(std::move(energy.density), set)};
  };
  return std::apply([&](auto... energies) { return std::vector{named(std::move(energies))...}; },
                    builtin_energies());
}

std::span<const NamedEnergy> named_energies() {
  static const std::vector<NamedEnergy> all = named_energies(widest_instruction_set());
  return all;
}

const NamedEnergy* find_energy(std::string_view name) {
  for (const NamedEnergy& e : named_energies())
    if (e.name == name) return &e;
  return nullptr;
}

EnergyFactory symmetric_dirichlet() {
  return builtin(symmetric_dirichlet_density(), widest_instruction_set());
}
EnergyFactory mips() { return builtin(mips_density(), widest_instruction_set()); }

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
