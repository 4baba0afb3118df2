// Writing where somebody else may keep the program waiting: FIFOs, pipes, sockets, terminals.
//
//   set_output_stop(record.stop());               // of the program
//   const int code = write_all(1, "v 0 0 0\n");   // ETIMEDOUT: the run is to end, nobody takes it
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <string_view>

#include "majorant/framework/stop_check.h"

namespace majorant {

// Between two questions whether to go on, while waiting. Chosen; nobody notices it.
inline constexpr int kWaitMilliseconds = 50;

// Seconds that a reader may take for a piece once the run is to end. Chosen; schedulers
// kill 10 to 30 seconds after they asked.
inline constexpr double kOutputPatience = 2;

// For programs, of the whole process: who says that the run is to end. Nobody before: then outputs
// wait for their readers for ever.
void set_output_stop(StopCheck stop);

// All of `content`, also where single calls are interrupted, write a part of it or would block.
// 0 or an error number. written, if not null: grows by the bytes that are taken, as they are.
int write_all(int descriptor, std::string_view content,
              std::atomic<std::uint64_t>* written = nullptr) noexcept;

// A descriptor for writing to what is there, of a FIFO as soon as it has a reader; -1: see errno.
int open_waiting(const std::string& path) noexcept;

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
