// The memory that this process may still take.
//
//   const std::size_t needed = 1 << 30;
//   const bool fits = needed <= available_memory().value_or(needed);
//
// root: the folder that has /proc and /sys, another one in tests.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace majorant {

// The least of what Linux calls MemAvailable and of what the limits of the control groups leave.
// File caches that give way count as free. None where the system does not say.
std::optional<std::size_t> free_memory(const std::string& root = "");
// The memory that a run may count on: the environment's MAJORANT_MEMORY_BYTES, for tests, replaces
// free_memory().
std::optional<std::size_t> available_memory(const std::string& root = "");

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
