#include "majorant/framework/kept_factor_memory.h"

#include <utility>

namespace majorant {
namespace {

thread_local KeptFactorMemory* kept_of_this_thread = nullptr;

void keep_larger(FactorMemory::Part& kept, FactorMemory::Part& part) {
  if (part.size > kept.size) std::swap(kept, part);
}

}  // namespace

KeptFactorMemory::KeptFactorMemory() {
  if (!kept_of_this_thread) kept_of_this_thread = this;
}

KeptFactorMemory::~KeptFactorMemory() {
  if (kept_of_this_thread == this) kept_of_this_thread = nullptr;
}

FactorMemory KeptFactorMemory::take() {
  return kept_of_this_thread ? std::exchange(kept_of_this_thread->memory_, {}) : FactorMemory();
}

void KeptFactorMemory::give(FactorMemory memory) {
  if (!kept_of_this_thread) return;
  FactorMemory& kept = kept_of_this_thread->memory_;
  keep_larger(kept.factor, memory.factor);
  keep_larger(kept.updates, memory.updates);
  keep_larger(kept.packed, memory.packed);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
