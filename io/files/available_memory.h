// The memory that is available to this process.
//
//   const std::size_t needed = 1 << 30;
//   const bool fits = needed <= available_memory().value_or(needed);
//
// root: the folder that contains /proc and /sys; tests use another one.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace majorant {

// Returns the minimum of Linux' MemAvailable and of the remaining limits of control groups. File
// caches that can be dropped count as free. None if the system does not tell.
std::optional<std::size_t> free_memory(const std::string& root = "");
// Returns the memory that a run may use: MAJORANT_MEMORY_BYTES of the environment, for tests, or
// free_memory().
std::optional<std::size_t> available_memory(const std::string& root = "");

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
