#include "majorant/energies/internal/instruction_sets.h"

#include <xsimd/xsimd.hpp>

namespace majorant {

std::vector<InstructionSet> instruction_sets() {
  std::vector<InstructionSet> sets{InstructionSet::Baseline};
#ifdef MAJORANT_X86_KERNELS
  const auto machine = xsimd::available_architectures();
  if (machine.fma3_avx2) sets.push_back(InstructionSet::Avx2);
  if (machine.avx512bw) sets.push_back(InstructionSet::Avx512);
#endif
  return sets;
}

InstructionSet widest_instruction_set() {
  static const InstructionSet set = instruction_sets().back();
  return set;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
