#include "majorant/energies/energy_factory.h"

#include <algorithm>
#include <utility>

#include "majorant/framework/internal/argument_check.h"

namespace majorant {

EnergyFactory::EnergyFactory(DensityTraits traits, Make make)
    : traits_(std::move(traits)), make_(std::move(make)) {
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
