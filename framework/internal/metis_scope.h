// A scope around calls of METIS that undoes what it does to the process:
//
//   const MetisScope metis;
//
// Not public: for .cpp files of solvers.
#pragma once

#include <array>
#include <csignal>
#include <mutex>

namespace majorant {

// METIS puts its own handlers of SIGTERM and SIGABRT in place, which jump out of it, leaves those
// it found as one-shot handlers, and seeds rand(). A SIGTERM waits while this lives; handlers and
// the sequence of rand() are as before after it. All of that belongs to the process, so one of
// these lives at a time, the next waits: METIS would draw the other's numbers, and order
// differently. Other threads must block SIGTERM to be safe from METIS's handler, and leave rand()
// alone for orderings, and so the bits of results, to be the same every time.
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
  std::array<char, 128> random_;  // as large as the C library's own: the same numbers for a seed
  char* program_random_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
