// From a density of the Jacobian to an energy term: the usual way to add an energy.
//
//   auto energy = make_energy(space, rest, spectral("my-energy",
//       [](auto S, auto s) { return S / s + s / S; }), {rule});
//   builder.add(energy, 1.0 / rest.measure.sum());       // a mean over the surface
//
// Drivers that build spaces and rules themselves take an EnergyFactory instead:
//
//   auto mine = spectral("my-energy", [](auto S, auto s) { return S / s + s / S; });
//   options.map.energy = {{energy_factory(mine), 1.0}};
//
// The kernel is compiled where these are called, for the instruction set of that file. A density
// with a member `Density with_parameters(const Vec&) const` takes TermState::parameters, which may
// change between steps.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "majorant/energies/density.h"
#include "majorant/energies/density_term.h"
#include "majorant/energies/detail/contraction_kernel.h"
#include "majorant/energies/energy_factory.h"
#include "majorant/energies/spectral.h"

namespace majorant {

template <class Density>
DensityTraits density_traits(const Density& density) {
  DensityTraits traits{
      std::string(density.name()), {}, density.traits.barrier, density.traits.free_scale, {}};
  for (const Curvature c : kCurvatures)
    if (density.supports(c)) traits.curvatures.push_back(c);
  if constexpr (requires(Vec parameters) { density.with_parameters(parameters); })
    traits.with_parameters = [density](const Vec& parameters) {
      return std::make_shared<const Density>(density.with_parameters(parameters));
    };
  return traits;
}

// With kernels compiled elsewhere. Throws InvalidArgument as DensityTerm does.
template <class Density>
std::shared_ptr<const DensityTerm> make_energy(std::shared_ptr<const ElementSpace> space,
                                               const RestShapes& rest, Density density,
                                               const std::vector<Quadrature>& rules,
                                               const DensityKernels& kernels) {
  DensityTraits traits = density_traits(density);
  return std::make_shared<const DensityTerm>(std::move(traits), std::move(space), rest, rules,
                                             std::make_shared<const Density>(std::move(density)),
                                             kernels);
}

template <class Density>
std::shared_ptr<const DensityTerm> make_energy(std::shared_ptr<const ElementSpace> space,
                                               const RestShapes& rest, Density density,
                                               const std::vector<Quadrature>& rules) {
  return make_energy(std::move(space), rest, std::move(density), rules,
                     kernel::make_kernels<xsimd::default_arch, Density>());
}

template <class Density>
EnergyFactory energy_factory(Density density, const DensityKernels& kernels) {
  DensityTraits traits = density_traits(density);
  return {std::move(traits), [density = std::move(density), kernels](
                                 std::shared_ptr<const ElementSpace> space, const RestShapes& rest,
                                 const std::vector<Quadrature>& rules) {
            return make_energy(std::move(space), rest, density, rules, kernels);
          }};
}

template <class Density>
EnergyFactory energy_factory(Density density) {
  return energy_factory(std::move(density), kernel::make_kernels<xsimd::default_arch, Density>());
}

}  // namespace majorant
