// The process of a run: signals, threads, memory.
//
//   prepare_process();                                          // first thing in main
//   const ThreadCount threads(usable_threads(0));
//   RunRecord record(60, 10000, interruption_flag(), nullptr);  // signals stop it from now on
//
// SIGINT, SIGTERM and SIGHUP end the process and remove its temporary files. After the first call
// of interruption_flag(), the first signal only sets the flag, so that a run can stop and write its
// result; the next one ends the process. A signal that is ignored at the start (nohup) stays
// ignored.
#pragma once

#include <sys/resource.h>

#include <atomic>

namespace majorant::app {

// Opens closed standard streams, handles signals, and ignores SIGPIPE and SIGXFSZ, so that failed
// writes are reported as errors. OpenBLAS, if a plugin loads it later, gets one thread: its threads
// would map 128 MiB of address space each, spin if that is refused, and run signal handlers.
void prepare_process();

// Returns the flag that the first signal sets. It is never destroyed.
const std::atomic<bool>* interruption_flag();
// Sets whether the first signal prints a line on stderr at once.
void acknowledge_signals(bool answered);

// Limits the memory of the process, while it exists, to the memory that is free at its construction
// (reading_limit.h). Allocations beyond it throw std::bad_alloc instead of the process being
// killed. For work of unknown size.
class ScopedMemoryLimit {
 public:
  ScopedMemoryLimit();
  ~ScopedMemoryLimit();
  ScopedMemoryLimit(const ScopedMemoryLimit&) = delete;
  ScopedMemoryLimit& operator=(const ScopedMemoryLimit&) = delete;

 private:
  rlimit before_{};
};

// Returns the number of threads to use. requested: 0 for the default of ThreadCount. The result is
// smaller if an address space limit (ulimit -v) leaves no room for stacks. Results do not depend on
// the number of threads.
int usable_threads(int requested);

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
