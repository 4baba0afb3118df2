#include "majorant/energies/named_energies.h"

#include <algorithm>
#include <tuple>
#include <utility>
#include <vector>

#include "majorant/energies/internal/builtin_densities.h"
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
DensityKernels best_kernels([[maybe_unused]] int index) {
#ifdef MAJORANT_X86_KERNELS
  const auto machine = xsimd::available_architectures();
  if (machine.avx512bw) return builtin_kernels_avx512(index);
  if (machine.fma3_avx2) return builtin_kernels_avx2(index);
#endif
  return kernel::make_kernels<xsimd::default_arch, Density>();
}

template <class Density>
EnergyFactory builtin(Density density) {
  constexpr int index = position<Density>(static_cast<const BuiltinEnergies*>(nullptr));
  static_assert(index < static_cast<int>(std::tuple_size_v<BuiltinEnergies>));
  return energy_factory(std::move(density), best_kernels<Density>(index));
}

template <class Density>
NamedEnergy named(BuiltinEnergy<Density> energy) {
  return {std::string(energy.density.name()), energy.summary, builtin(std::move(energy.density))};
}

}  // namespace

std::span<const NamedEnergy> named_energies() {
  static const auto all = std::apply(
      [](auto... energies) { return std::vector<NamedEnergy>{named(std::move(energies))...}; },
      builtin_energies());
  return all;
}

const NamedEnergy* find_energy(std::string_view name) {
  for (const NamedEnergy& e : named_energies())
    if (e.name == name) return &e;
  return nullptr;
}

EnergyFactory symmetric_dirichlet() { return builtin(symmetric_dirichlet_density()); }
EnergyFactory mips() { return builtin(mips_density()); }

}  // namespace majorant
