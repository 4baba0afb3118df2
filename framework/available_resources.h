// The memory and the processors that this process may use.
//
//   const std::size_t needed = 1 << 30;
//   const bool fits = needed <= available_memory().value_or(needed);
//   const int threads = available_processors();
//
// Linux's control groups are asked, versions 1 and 2, from that of the process all the way up:
// containers set their limits there. root: where /proc and /sys are.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace majorant {

// The least of what Linux calls MemAvailable and of what the limits of the control groups leave,
// file caches that give way counted as free. None where nobody says.
std::optional<std::size_t> free_memory(const std::string& root = "");
// The memory that a solver may count on: the environment's MAJORANT_MEMORY_BYTES, for tests,
// replaces it.
std::optional<std::size_t> available_memory(const std::string& root = "");

// The bytes of a factor from which on memory that is not needed now goes back to the system: of a
// map of 300,000 faces. To have it mapped again takes a hundredth of the factorization.
inline constexpr std::size_t kLargeFactor = std::size_t(256) << 20;
// Gives memory that is free in the heap back to the system: a program keeps it to be fast, and a
// great demand comes on top of it. With glibc; with other libraries nothing happens.
void release_free_memory();

// The least of the processors of its affinity, of the CPU quota of its control groups, rounded up,
// and of OMP_NUM_THREADS, which batch systems set; at least 1.
int available_processors(const std::string& root = "");

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
