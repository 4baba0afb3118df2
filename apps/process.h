// The process around a run: signals, threads, memory.
//
//   prepare_process();                                          // first thing in main
//   const ThreadCount threads(usable_threads(0));
//   RunRecord record(60, 10000, interruption_flag(), nullptr);  // signals stop it from now on
//
// SIGINT, SIGTERM and SIGHUP end the process and remove its temporary files. From the first call of
// interruption_flag() on, the first of them only sets the flag, so that a run can stop and write
// what it has; the next one ends the process. One that is ignored at the start (nohup) stays
// ignored.
#pragma once

#include <sys/resource.h>

#include <atomic>

namespace majorant::app {

// Closed standard streams are opened, signals handled, and SIGPIPE and SIGXFSZ ignored: what cannot
// be written is an error of that write. OpenBLAS gets one thread, where a plugin loads it later:
// its own would map 128 MiB of address space each, spin for ever where that is refused, and run
// signal handlers.
void prepare_process();

// Set by the first of the signals above. Outlives everything.
const std::atomic<bool>* interruption_flag();
// Says whether the first of them is answered with a line on stderr, at once.
void acknowledge_signals(bool answered);

// While one lives the process gets no more memory than is free when it begins (reading_limit.h):
// std::bad_alloc instead of being killed. For what takes as much as it asks for.
class FreeMemoryOnly {
 public:
  FreeMemoryOnly();
  ~FreeMemoryOnly();
  FreeMemoryOnly(const FreeMemoryOnly&) = delete;
  FreeMemoryOnly& operator=(const FreeMemoryOnly&) = delete;

 private:
  rlimit before_{};
};

// The number of threads for a number asked for; 0: as many as ThreadCount has; fewer where an
// address space limit (ulimit -v) leaves no space for their stacks: results do not depend on it.
int usable_threads(int requested);

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
