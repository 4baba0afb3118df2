// Writes to outputs that may block: FIFOs, pipes, sockets, terminals.
//
//   set_output_stop(record.stop());               // of the program
//   const int code = write_all(1, "v 0 0 0\n");   // ETIMEDOUT: stopped, and no reader took it
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <string_view>

#include "majorant/framework/stop_check.h"

namespace majorant {

// Time between two calls of the stop while waiting. Chosen, not tuned.
inline constexpr int kWaitMilliseconds = 50;

// Seconds that a reader may take for a piece after the run was stopped. Schedulers kill 10 to 30
// seconds after their signal. Chosen, not tuned.
inline constexpr double kOutputPatience = 2;

// Sets the stop of the whole process, for programs. Without it, outputs wait for their readers
// without limit.
void set_output_stop(StopCheck stop);

// Writes all of `content`, even if calls are interrupted, write a part or would block. Returns 0 or
// an error number. written, if not null, grows by the bytes taken.
int write_all(int descriptor, std::string_view content,
              std::atomic<std::uint64_t>* written = nullptr) noexcept;

// Opens an existing path for writing; waits for a reader of a FIFO. Returns -1 on errors: see
// errno.
int open_waiting(const std::string& path) noexcept;

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
