// The energy that a map says it was made with, which a density is measured in.
#pragma once

#include <string>

#include "majorant/energies/energy_factory.h"
#include "majorant/maps/map_file.h"

namespace majorant {

struct ClaimedEnergy {
  std::string name;  // as claimed; empty: nothing is, or nothing that is understood
  EnergySum sum;     // empty likewise
};

// From MapFile::claims. Never throws over what these say: claims are for `check` to judge.
ClaimedEnergy claimed_energy(const MapFile& map);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
