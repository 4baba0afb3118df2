// From a density of the Jacobian to an energy term: the usual way to add an energy.
//
//   auto energy = make_energy(space, rest, spectral("my-energy", Domain::PositiveDeterminant,
//       Convexity::Unknown, [](auto S, auto s) { return S / s + s / S; }), {rule});
//   builder.add(energy, 1.0 / rest.measure.sum());       // a mean over the surface
//
// The kernel is compiled where make_energy is called, for the instruction set of that file.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "majorant/energies/contraction_kernel.h"
#include "majorant/energies/density_term.h"
#include "majorant/energies/spectral.h"

namespace majorant {

template <class Density>
std::shared_ptr<const DensityTerm> make_energy(std::shared_ptr<const ElementSpace> space,
                                               const RestShapes& rest, Density density,
                                               const std::vector<Quadrature>& rules) {
  std::string name(density.name());
  return std::make_shared<const DensityTerm>(std::move(name), std::move(space), rest, rules,
                                             std::make_shared<const Density>(std::move(density)),
                                             kernel::make_kernels<xsimd::default_arch, Density>());
}

}  // namespace majorant
