// The energy that a map claims. Its density is that of pictures.
#pragma once

#include <string>

#include "majorant/energies/energy_factory.h"
#include "majorant/maps/map_file.h"

namespace majorant {

struct ClaimedEnergy {
  std::string name;  // as claimed; empty: none, or not understood
  EnergySum sum;     // empty if name is
};

// Reads MapFile::claims. Never throws: `check` judges claims.
ClaimedEnergy claimed_energy(const MapFile& map);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
