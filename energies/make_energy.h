// From a density of the Jacobian to an energy term: the usual way to add an energy.
//
//   auto energy = make_energy(space, rest, spectral("my-energy",
//       [](auto S, auto s) { return S / s + s / S; }));
//   builder.add(energy, 1.0 / rest.measure.sum());       // a mean over the surface
//
// Integrated by the rule that fits the space and its degree; others may be named (quadrature.h).
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

// object: has the density as its member, and is what kernels are called with: called(object).
// again: the factory of another density of the type.
template <class Object, class Called, class Again>
EnergyFactory make_factory(std::shared_ptr<const Object> object, const DensityKernels& kernels,
                           Called called, Again again) {
  const auto& density = object->density;
  bool supported[std::size(kCurvatures)];
  for (std::size_t k = 0; k < std::size(kCurvatures); ++k)
    supported[k] = density.supports(kCurvatures[k]);
  DensityTraits traits = traits_of(density.name(), density.traits, supported);
  if constexpr (requires(Vec parameters) { density.with_parameters(parameters); })
    traits.with_parameters = [object, called](const Vec& parameters) {
      return called(std::make_shared<const Object>(object->density.with_parameters(parameters)));
    };
  EnergyFactory::Part part;
  if constexpr (requires { density.element_count(); }) {
    traits.elements = density.element_count();
    part = [object, again](std::span<const Index> elements) {
      return again(object->density.of(elements));
    };
  }
  return EnergyFactory::of_density(std::move(traits), called(std::move(object)), kernels,
                                   std::move(part));
}

template <class Density>
struct CalledItself {
  explicit CalledItself(Density d) : density(std::move(d)) {}
  const Density density;
};

}  // namespace detail

// Throws InvalidArgument for a spectral() formula that is not symmetric.
template <class Density>
EnergyFactory energy_factory(const Density& density) {
  detail::require_symmetric<double>(density);
  using Object = detail::CalledByPoint<Density>;
  return detail::make_factory(
      std::make_shared<const Object>(density), detail::point_kernels<Density>(),
      [](const std::shared_ptr<const Object>& object) {
        return std::shared_ptr<const void>(object, &object->function);
      },
      [](const Density& other) { return energy_factory(other); });
}
// With kernels that this density is compiled into (energies/vectorized.h).
template <class Density>
EnergyFactory energy_factory(const Density& density, const DensityKernels& kernels) {
  using Object = detail::CalledItself<Density>;
  return detail::make_factory(
      std::make_shared<const Object>(density), kernels,
      [](const std::shared_ptr<const Object>& object) {
        return std::shared_ptr<const void>(object, &object->density);
      },
      [kernels](const Density& other) { return energy_factory(other, kernels); });
}

// Throw InvalidArgument as DensityTerm does. Without rules: as EnergyFactory::operator() has it.
template <class Density>
std::shared_ptr<const DensityTerm> make_energy(std::shared_ptr<const ElementSpace> space,
                                               const RestShapes& rest, const Density& density) {
  return energy_factory(density)(std::move(space), rest);
}
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
