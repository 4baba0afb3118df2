// Energies that can be put on any space and rules: what drivers take as "the energy".
//
//   const EnergySum sum{{mips(), 1.0}, {symmetric_dirichlet(), 0.1}};
//   const bool has_a_scale = free_scale_of(sum) == FreeScale::Determined;   // true
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "majorant/energies/density_term.h"
#include "majorant/energies/traits.h"

namespace majorant {

// Made by energy_factory() of make_energy.h, or taken from named_energies.h. An energy may be that
// of one mesh only, because its formula is told of the elements or their frames are turned: its
// traits say of how many elements.
class EnergyFactory {
 public:
  using Make = std::function<std::shared_ptr<const DensityTerm>(
      std::shared_ptr<const ElementSpace> space, const RestShapes& rest,
      const std::vector<Quadrature>& rules)>;
  using Part = std::function<EnergyFactory(std::span<const Index> elements)>;
  // make: gives terms of these traits. part: for_elements() where traits.elements is set.
  // Throws InvalidArgument where `make` is empty.
  EnergyFactory(DensityTraits traits, Make make, Part part = {});
  // density: what `kernels` are called with; all terms share it.
  static EnergyFactory of_density(DensityTraits traits, std::shared_ptr<const void> density,
                                  const DensityKernels& kernels, Part part = {});

  const DensityTraits& traits() const { return traits_; }
  // Value of the term = sum over elements of measure * mean density. Throws InvalidArgument
  // as DensityTerm does.
  std::shared_ptr<const DensityTerm> operator()(std::shared_ptr<const ElementSpace> space,
                                                const RestShapes& rest,
                                                const std::vector<Quadrature>& rules) const {
    return make_(std::move(space), rest, rules);
  }
  // On the default rule of the space (ElementSpace::default_rule). Where J is not constant and the
  // energy has a barrier, guarded_rule() adds the corners, with kCornerGuard.
  std::shared_ptr<const DensityTerm> operator()(std::shared_ptr<const ElementSpace> space,
                                                const RestShapes& rest) const;
  // The same energy on a mesh made of these elements, in this order. Throws InvalidArgument for
  // an element it does not know, InvalidArgument if it has no part().
  EnergyFactory for_elements(std::span<const Index> elements) const;

 private:
  DensityTraits traits_;
  Make make_;
  Part part_;
};

namespace detail {
// supported: of each of kCurvatures. No with_parameters, no elements.
DensityTraits traits_of(std::string_view name, const Traits& traits,
                        std::span<const bool> supported);
}  // namespace detail

// The energy in frames that are turned so that their first axes are those given: #E by D, of any
// length, in the frames of the rest shapes (turned() and in_frames() of elements/rest_shapes.h).
//
//   const RowMatrix fibres = in_frames(*mesh, directions);         // #F by 3, in space
//   options.map.energy = {{symmetric_dirichlet()}, {along(fibres, energy_factory(shear)), 0.1}};
//
// Throws InvalidArgument where `make` is for another number of elements; the terms it makes
// do for directions without a length, and for curved rest shapes.
EnergyFactory along(RowMatrix first_axes, EnergyFactory make);

// sum of weight * energy.
struct WeightedEnergy {
  EnergyFactory make;
  double weight = 1.0;
  Vec face_weight = {};  // #E positive factors on single elements, empty = all 1
};
using EnergySum = std::vector<WeightedEnergy>;

// Whether a summand is made for the elements of one mesh: has face weights, or data, or fibres.
bool knows_elements(const EnergySum& energy);
// The sum on a mesh made of these elements: EnergyFactory::for_elements().
EnergySum for_elements(const EnergySum& energy, std::span<const Index> elements);
// Throws InvalidArgument unless the summands are for `count` elements, or for any.
void require_elements(const EnergySum& energy, Index count);

// The strongest of the summands; None of an empty sum.
Barrier barrier_of(const EnergySum& energy);
// Determined if one summand is, else Collapses if one does, else Arbitrary: one scale is enough,
// and nothing but a scale withstands a summand that shrinks the map.
FreeScale free_scale_of(const EnergySum& energy);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
