// How many threads the work of a block may use: a value that the block owns.
//
//   const ThreadCount two(2);          // until the end of this block, for what this thread calls
//   double e = Evaluator(problem).value(y0);
//
// Evaluators, checkers and all solvers run their loops on the pool of threads of the process; two
// threads that solve at the same time do not see each other's number. Results are the same for any
// number, to the last bit. parametrize(), deform() and make_seamless() take the number with their
// options.
#pragma once

namespace majorant {

class ThreadCount {
 public:
  // 0: as it is. Throws InvalidArgument where count < 0.
  explicit ThreadCount(int count);
  ~ThreadCount();  // on the same thread: as before
  ThreadCount(const ThreadCount&) = delete;
  ThreadCount& operator=(const ThreadCount&) = delete;

  // Of the calling thread, now. Without any ThreadCount: as many as the process has processors, by
  // its affinity and the CPU quota of its control groups, and at most OMP_NUM_THREADS. In a task of
  // a parallel loop: 1.
  static int current();

 private:
  int before_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
