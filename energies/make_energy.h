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
// Kernels of the library call the formula point by point; energies/vectorized.h has others. A
// density with a member `Density with_parameters(const Vec&) const` takes TermState::parameters,
// which may change between steps.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "majorant/energies/density.h"
#include "majorant/energies/density_term.h"
#include "majorant/energies/detail/pointwise.h"
#include "majorant/energies/element_data.h"
#include "majorant/energies/energy_factory.h"
#include "majorant/energies/spectral.h"

namespace majorant {

namespace detail {

// wrap: what kernels call a density as.
template <class Density, class Wrap>
EnergyFactory make_factory(const Density& density, const DensityKernels& kernels, Wrap wrap) {
  DensityTraits traits{std::string(density.name()), {}, density.traits.barrier,
                       density.traits.free_scale,   {}, {}};
  for (const Curvature c : kCurvatures)
    if (density.supports(c)) traits.curvatures.push_back(c);
  if constexpr (requires(Vec parameters) { density.with_parameters(parameters); })
    traits.with_parameters = [density, wrap](const Vec& parameters) {
      return wrap(density.with_parameters(parameters));
    };
  EnergyFactory::Part part;
  if constexpr (requires { density.element_count(); }) {
    traits.elements = density.element_count();
    part = [density, kernels, wrap](std::span<const Index> elements) {
      return make_factory(density.of(elements), kernels, wrap);
    };
  }
  return EnergyFactory::of_density(std::move(traits), wrap(density), kernels, std::move(part));
}

}  // namespace detail

template <class Density>
EnergyFactory energy_factory(const Density& density) {
  return detail::make_factory(density, detail::point_kernels<Density>(),
                              [](const auto& d) { return detail::point_object(d); });
}
// With kernels that this density is compiled into (energies/vectorized.h).
template <class Density>
EnergyFactory energy_factory(const Density& density, const DensityKernels& kernels) {
  return detail::make_factory(density, kernels, [](const auto& d) -> std::shared_ptr<const void> {
    return std::make_shared<const Density>(d);
  });
}

// Throw InvalidArgument as DensityTerm does.
template <class Density>
std::shared_ptr<const DensityTerm> make_energy(std::shared_ptr<const ElementSpace> space,
                                               const RestShapes& rest, const Density& density,
                                               const std::vector<Quadrature>& rules) {
  return energy_factory(density)(std::move(space), rest, rules);
}
template <class Density>
std::shared_ptr<const DensityTerm> make_energy(std::shared_ptr<const ElementSpace> space,
                                               const RestShapes& rest, const Density& density,
                                               const std::vector<Quadrature>& rules,
                                               const DensityKernels& kernels) {
  return energy_factory(density, kernels)(std::move(space), rest, rules);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
