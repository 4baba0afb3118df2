// A scope around calls of METIS that undoes their effects on the process:
//
//   const MetisScope metis;
//
// Not public: for .cpp files of solvers.
#pragma once

#include <array>
#include <csignal>
#include <mutex>

namespace majorant {

// METIS installs its own handlers of SIGTERM and SIGABRT, which jump out of it, leaves the former
// handlers as one-shot handlers, and seeds rand(). A SIGTERM waits until this scope ends; handlers
// and the sequence of rand() are then restored. All of this belongs to the process, so only one
// scope exists at a time and the next one waits. Otherwise METIS would draw the other's random
// numbers and order differently. Other threads must block SIGTERM to be safe from METIS's handler.
// They must not call rand(), so that orderings, and so the bits of results, are reproducible.
class MetisScope {
 public:
  MetisScope();
  ~MetisScope();
  MetisScope(const MetisScope&) = delete;
  MetisScope& operator=(const MetisScope&) = delete;

 private:
  std::unique_lock<std::mutex> alone_;
  struct sigaction term_, abort_;
  sigset_t mask_;
  std::array<char, 128> random_;  // as large as that of the C library, for the same numbers
  char* program_random_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
