#include "majorant/energies/energy_factory.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "majorant/energies/detail/pointwise.h"
#include "majorant/framework/argument_check.h"
#include "majorant/framework/error.h"

namespace majorant {
namespace {

void require_count(const std::string& what, Index given, Index count) {
  if (given != count)
    throw InvalidArgument(what + " for " + std::to_string(given) + " elements, not " +
                          std::to_string(count));
}

// Returns a rule that is exact for polynomials of a degree higher by `more`.
Quadrature finer(const Quadrature& rule, int more) {
  const int highest = highest_exactness(rule.cell);
  int degree = 0;
  while (degree < highest && exact_rule(rule.cell, degree + 1).size() <= rule.size()) ++degree;
  return exact_rule(rule.cell, highest - more < degree ? highest : degree + more);
}

template <class Rows>
Rows rows_of(const Rows& all, std::span<const Index> elements) {
  Rows part(static_cast<Index>(elements.size()), all.cols());
  for (std::size_t k = 0; k < elements.size(); ++k) {
    if (elements[k] < 0 || elements[k] >= all.rows())
      throw InvalidArgument("there is no element " + std::to_string(elements[k]));
    part.row(static_cast<Index>(k)) = all.row(elements[k]);
  }
  return part;
}

}  // namespace

void detail::refuse_asymmetric(std::string_view name, double ab, double ba) {
  const bool neither = !std::isfinite(ab) && !std::isfinite(ba);
  if (neither || std::abs(ab - ba) <= kAsymmetry * std::max(std::abs(ab), std::abs(ba))) return;
  throw InvalidArgument(fmt::format(
      "energy '{0}': its formula is {1:g} at ({3}, {4}) and {2:g} at ({4}, {3}); spectral() takes "
      "formulas that are symmetric in both singular values, density<2, 2>() takes any of J",
      name, ab, ba, kTriedS, kTriedLess));
}

DensityTraits detail::traits_of(std::string_view name, const Traits& traits,
                                std::span<const bool> supported) {
  DensityTraits all{std::string(name), {}, traits.barrier, traits.free_scale};
  for (std::size_t k = 0; k < supported.size(); ++k)
    if (supported[k]) all.curvatures.push_back(kCurvatures[k]);
  return all;
}

EnergyFactory EnergyFactory::of_density(DensityTraits traits, std::shared_ptr<const void> density,
                                        const DensityKernels& kernels, Part part) {
  const auto make = [traits, density = std::move(density), kernels](
                        std::shared_ptr<const ElementSpace> space,
                        std::shared_ptr<const RestShapes> rest,
                        const std::vector<Quadrature>& rules) {
    return std::make_shared<const DensityTerm>(traits, std::move(space), std::move(rest), rules,
                                               density, kernels);
  };
  return {std::move(traits), make, std::move(part)};
}

std::shared_ptr<const DensityTerm> EnergyFactory::operator()(
    std::shared_ptr<const ElementSpace> space, const RestShapes& rest) const {
  // The rule for curved shapes also integrates det J.
  const RestJacobian jacobian = traits_.dilatation_degree ? RestJacobian::Varying : rest.jacobian();
  Quadrature rule = given("EnergyFactory: the space", space)->default_rule(jacobian);
  if (traits_.dilatation_degree && *traits_.dilatation_degree > 0)
    rule = finer(rule, *traits_.dilatation_degree);
  if (traits_.barrier != Barrier::None && rule.size() > 1)
    rule = guarded_rule(rule, 1, kCornerGuard);
  return make_(std::move(space), std::make_shared<const RestShapes>(rest), {std::move(rule)});
}

EnergyFactory EnergyFactory::for_elements(std::span<const Index> elements) const {
  if (!traits_.elements) return *this;
  if (!part_) throw InvalidArgument("EnergyFactory: '" + traits_.name + "' is made without part()");
  for (const Index e : elements)
    if (e < 0 || e >= *traits_.elements)
      throw InvalidArgument("EnergyFactory: there is no element " + std::to_string(e));
  return part_(elements);
}

EnergyFactory along(RowMatrix first_axes, EnergyFactory make) {
  DensityTraits traits = make.traits();
  const auto count = static_cast<Index>(first_axes.rows());
  if (traits.elements)
    require_count("along: '" + traits.name + "' has data", *traits.elements, count);
  traits.elements = count;
  const auto part = [first_axes, make](std::span<const Index> elements) {
    return along(rows_of(first_axes, elements), make.for_elements(elements));
  };
  return {std::move(traits),
          [first_axes = std::move(first_axes), make = std::move(make)](
              std::shared_ptr<const ElementSpace> space, std::shared_ptr<const RestShapes> rest,
              const std::vector<Quadrature>& rules) {
            return make(std::move(space), turned(*rest, first_axes), rules);
          },
          part};
}

bool knows_elements(const EnergySum& energy) {
  return std::any_of(energy.begin(), energy.end(), [](const WeightedEnergy& e) {
    return e.make.traits().elements || e.face_weight.size() > 0;
  });
}

EnergySum for_elements(const EnergySum& energy, std::span<const Index> elements) {
  EnergySum part;
  for (const WeightedEnergy& e : energy)
    part.push_back({e.make.for_elements(elements), e.weight,
                    e.face_weight.size() > 0 ? rows_of(e.face_weight, elements) : Vec()});
  return part;
}

void require_elements(const EnergySum& energy, Index count) {
  for (const WeightedEnergy& e : energy) {
    const DensityTraits& traits = e.make.traits();
    if (traits.elements)
      require_count("energy '" + traits.name + "' has data", *traits.elements, count);
    if (e.face_weight.size() > 0)
      require_count("energy '" + traits.name + "' has weights",
                    static_cast<Index>(e.face_weight.size()), count);
  }
}

EnergyFactory::EnergyFactory(DensityTraits traits, Make make, Part part)
    : traits_(std::move(traits)), make_(std::move(make)), part_(std::move(part)) {
  require_given("EnergyFactory: make", make_);
}

Barrier barrier_of(const EnergySum& energy) {
  Barrier strongest = Barrier::None;
  for (const WeightedEnergy& e : energy) strongest = std::max(strongest, e.make.traits().barrier);
  return strongest;
}

FreeScale free_scale_of(const EnergySum& energy) {
  const auto any = [&](FreeScale scale) {
    return std::any_of(energy.begin(), energy.end(), [scale](const WeightedEnergy& e) {
      return e.make.traits().free_scale == scale;
    });
  };
  if (any(FreeScale::Determined)) return FreeScale::Determined;
  return any(FreeScale::Collapses) ? FreeScale::Collapses : FreeScale::Arbitrary;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
