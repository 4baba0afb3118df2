#include "majorant/energies/named_energies.h"

#include <algorithm>
#include <tuple>
#include <utility>
#include <vector>

#include "majorant/energies/internal/builtin_densities.h"
#include "majorant/energies/internal/instruction_sets.h"
#include "majorant/energies/make_energy.h"

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

// For the baseline they are compiled here: who touches a density waits for three files.
template <class Density>
EnergyFactory builtin(Density density, [[maybe_unused]] InstructionSet set) {
  constexpr int index = position<Density>(static_cast<const BuiltinEnergies*>(nullptr));
  static_assert(index < static_cast<int>(std::tuple_size_v<BuiltinEnergies>));
#ifdef MAJORANT_X86_KERNELS
  if (set == InstructionSet::Avx512)
    return energy_factory(std::move(density), builtin_kernels_avx512(index));
  if (set == InstructionSet::Avx2)
    return energy_factory(std::move(density), builtin_kernels_avx2(index));
#endif
  return energy_factory(std::move(density));
}

InstructionSet widest() {
  static const InstructionSet set = instruction_sets().back();
  return set;
}

}  // namespace

std::vector<InstructionSet> instruction_sets() {
  std::vector<InstructionSet> sets{InstructionSet::Baseline};
#ifdef MAJORANT_X86_KERNELS
  const auto machine = xsimd::available_architectures();
  if (machine.fma3_avx2) sets.push_back(InstructionSet::Avx2);
  if (machine.avx512bw) sets.push_back(InstructionSet::Avx512);
#endif
  return sets;
}

std::vector<NamedEnergy> named_energies(InstructionSet set) {
  const auto named = [set](auto energy) {
    std::string name(energy.density.name());
    return NamedEnergy{std::move(name), energy.summary, builtin(std::move(energy.density), set)};
  };
  return std::apply([&](auto... energies) { return std::vector{named(std::move(energies))...}; },
                    builtin_energies());
}

std::span<const NamedEnergy> named_energies() {
  static const std::vector<NamedEnergy> all = named_energies(widest());
  return all;
}

const NamedEnergy* find_energy(std::string_view name) {
  for (const NamedEnergy& e : named_energies())
    if (e.name == name) return &e;
  return nullptr;
}

EnergyFactory symmetric_dirichlet() { return builtin(symmetric_dirichlet_density(), widest()); }
EnergyFactory mips() { return builtin(mips_density(), widest()); }

}  // namespace majorant
