// The built-in energies for one instruction set each. energy_factory.h offers the widest one that
// the machine has. Comparisons, and programs that need the same bits on every machine, choose one.
//
//   for (const InstructionSet set : instruction_sets())
//     for (const NamedEnergy& energy : named_energies(set)) ...
#pragma once

#include <vector>

#include "majorant/energies/energy_factory.h"

namespace majorant {

enum class InstructionSet { Baseline, Avx2, Avx512 };

std::vector<InstructionSet> instruction_sets();  // of this machine, the widest last
InstructionSet widest_instruction_set();

// Returns the energies in the order of named_energies(); `set` must be one of instruction_sets().
std::vector<NamedEnergy> named_energies(InstructionSet set);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
