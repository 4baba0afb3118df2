#include "majorant/pictures/internal/claimed_energy.h"

#include "majorant/parametrization/maps/internal/energy_text.h"
#include "majorant/pictures/internal/claims_json.h"

namespace majorant {

ClaimedEnergy claimed_energy(const MapFile& map) {
  const std::string name = text_at(claims_of(map), "energy");
  const std::optional<EnergySum> sum = find_energy_sum(name);
  return sum ? ClaimedEnergy{name, *sum} : ClaimedEnergy{};
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
