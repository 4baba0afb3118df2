#include "majorant/energies/named_energies.h"

#include <algorithm>
#include <vector>

#include "majorant/energies/builtin_densities.h"
#include "majorant/energies/make_energy.h"

namespace majorant {

#ifdef MAJORANT_X86_KERNELS
DensityKernels builtin_kernels_avx2(int index);
DensityKernels builtin_kernels_avx512(int index);
#endif

namespace {

template <class Density, class... All>
constexpr int position(const std::tuple<All...>*) {
  const bool same[] = {std::is_same_v<Density, All>...};
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
NamedEnergy named(const Density& density, FreeScale free_scale, std::string summary) {
  constexpr int index = position<Density>(static_cast<const BuiltinDensities*>(nullptr));
  static_assert(index < static_cast<int>(std::tuple_size_v<BuiltinDensities>));
  return {std::string(density.name()), std::move(summary), free_scale,
          [density, kernels = best_kernels<Density>(index)](
              std::shared_ptr<const ElementSpace> space, const RestShapes& rest,
              const std::vector<Quadrature>& rules) {
            return make_energy(std::move(space), rest, density, rules, kernels);
          }};
}

}  // namespace

std::span<const NamedEnergy> named_energies() {
  using enum FreeScale;
  static const std::vector<NamedEnergy> all{
      named(symmetric_dirichlet_density(), Determined, "|J|^2 + |J^-1|^2; barrier; isometry 4"),
      named(asap_density(), Collapses, "(Sigma - sigma)^2, conformal; no barrier; similarity 0"),
      named(mips_density(), Arbitrary, "|J|^2 / det J, conformal; barrier; similarity 2"),
      named(arap_density(), Determined, "|J - R|^2; no barrier; isometry 0"),
      named(symmetric_arap_density(), Determined,
            "|J - R|^2 + |J^-1 - R^-1|^2; barrier; isometry 0"),
      named(log_isometric_density(), Determined, "log^2 Sigma + log^2 sigma; barrier; isometry 0"),
      named(authalic_density(), Determined, "det J + 1 / det J, areas; barrier; equal areas 2"),
      named(amips_exponential_density(), Determined,
            "exp(5 ((mips + authalic) / 4 - 1)); barrier; isometry 1"),
  };
  return all;
}

const NamedEnergy* find_energy(std::string_view name) {
  for (const NamedEnergy& e : named_energies())
    if (e.name == name) return &e;
  return nullptr;
}

EnergyFactory symmetric_dirichlet() { return find_energy("symmetric-dirichlet")->make; }

}  // namespace majorant
