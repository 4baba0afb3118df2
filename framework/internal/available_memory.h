// What this process may still take of the machine's memory.
//
//   const std::size_t needed = 1 << 30;
//   const bool fits = needed <= available_memory().value_or(needed);
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace majorant {

// The least of what Linux calls MemAvailable and of what the limits of this process' control groups
// (versions 1 and 2) leave, file caches that give way counted as free. None where nobody says.
// root: where /proc and /sys are.
std::optional<std::size_t> free_memory(const std::string& root = "");
// That of a solver: the environment's MAJORANT_MEMORY_BYTES, for tests, replaces it.
std::optional<std::size_t> available_memory(const std::string& root = "");

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
