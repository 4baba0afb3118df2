// How many threads the work of a block may use: a value that the block owns.
//
//   const ThreadCount two(2);          // until the end of this block, for what this thread calls
//   double e = Evaluator(problem).value(y0);
//
// Evaluators, checkers and all solvers run their loops on OpenMP's team of the thread that calls
// them. OpenMP keeps that number by thread, not by process (its data environments; libgomp and
// LLVM's libomp alike), so two threads that solve at the same time do not see each other's. Results
// are the same for any number, to the last bit. parametrize(), deform() and make_seamless() take
// the number with their options.
#pragma once

#include <functional>

namespace majorant {

class ThreadCount {
 public:
  // 0: as it is. 1: nothing that the calling thread calls starts an OpenMP team, not even libraries
  // that ask for threads of their own. Throws InvalidArgument where count < 0.
  explicit ThreadCount(int count);
  ~ThreadCount();  // on the same thread: as before
  ThreadCount(const ThreadCount&) = delete;
  ThreadCount& operator=(const ThreadCount&) = delete;

  // Of the calling thread, now. Without any ThreadCount: OpenMP's (OMP_NUM_THREADS, or all cores).
  static int current();
  // Calls `work` once on each of the current() threads, which start if they do not run yet. What
  // one of them throws is thrown.
  static void run_on_each(const std::function<void()>& work);

 private:
  int threads_, levels_;  // of OpenMP, before
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
