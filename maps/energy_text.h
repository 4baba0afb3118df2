// Energies as text in files and command lines: 'symmetric-dirichlet + 0.1*asap'.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "majorant/energies/energy_factory.h"

namespace majorant {

struct EnergyWord {
  std::optional<std::string> weight;  // as written, which may be no number
  std::string name;
};

// Returns the summands `[weight *] name` joined by +, without surrounding space. There is at least
// one.
std::vector<EnergyWord> split_energy_text(std::string_view text);

// Returns the number if the text is one, positive and finite.
std::optional<double> parse_energy_weight(std::string_view text);

// Returns the energy of a text; none if a summand is not understood.
std::optional<EnergySum> find_energy_sum(std::string_view text);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
