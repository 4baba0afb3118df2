#include "majorant/pictures/internal/claimed_energy.h"

#include "majorant/io/claims.h"
#include "majorant/maps/energy_text.h"

namespace majorant {

ClaimedEnergy claimed_energy(const MapFile& map) {
  const std::string name = readable_claims(map.claims).energy.value_or("");
  const std::optional<EnergySum> sum = find_energy_sum(name);
  return sum ? ClaimedEnergy{name, *sum} : ClaimedEnergy{};
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
