// The number of threads that the work of a block may use, and loops on them: one pool for the
// process, whose threads sleep while there is nothing to do.
//
//   const ThreadCount two(2);          // until the end of this block, for what this thread calls
//   std::vector<double> y(1000);
//   parallel_for(1000, 100, [&](Index i) { y[i] = std::sqrt(i); });   // pieces of 100
//
//   std::vector<Workspace> scratch(to_size(ThreadCount::current()));
//   parallel_tasks(64, [&](Index task, int thread) { scratch[thread].reserve(100); });
//
// Evaluators, checkers and all solvers run their loops like this. The calling thread works, too; up
// to ThreadCount::current() - 1 threads of the pool join it. A task must write what no other one
// reads, so that results do not depend on the number of threads, to the last bit. Loops inside of
// a task run on the thread of the task. Threads that solve at the same time share the pool: where
// as many are at work as a loop may have, nobody joins it. In a forked child the pool begins anew.
// Not for a handful of short tasks: waking a thread is a call of the system.
#pragma once

#include <algorithm>
#include <functional>

#include "majorant/framework/types.h"

namespace majorant {

// The number of threads that the work of a block may use: a value that the block owns. Two threads
// that solve at the same time do not see each other's number. parametrize(), deform() and
// make_seamless() take the number with their options.
class ThreadCount {
 public:
  // 0: as it is. Throws InvalidArgument where count < 0.
  explicit ThreadCount(int count);
  ~ThreadCount();  // on the same thread: as before
  ThreadCount(const ThreadCount&) = delete;
  ThreadCount& operator=(const ThreadCount&) = delete;

  // The number that holds for the calling thread now. Without any ThreadCount: the number of
  // processors of the process, by its affinity and the CPU quota of its control groups, and at most
  // OMP_NUM_THREADS. In a task of a parallel loop: 1.
  static int current();

 private:
  int before_;
};

// work(task, thread) for all tasks 0 to count - 1, begun in ascending order; thread: from 0 to
// threads - 1, no two tasks have the same one at the same time. After one has thrown none begins
// any more, and what the lowest of those that failed threw is thrown.
void parallel_tasks(Index count, const std::function<void(Index task, int thread)>& work,
                    int threads = ThreadCount::current());

// True in a task, where further loops run on the calling thread.
bool is_parallel_task();

// work(i) for all i from 0 to count - 1, `piece` successive ones a task.
template <class Work>
void parallel_for(Index count, Index piece, const Work& work) {
  parallel_tasks(count > 0 ? (count - 1) / piece + 1 : 0, [&](Index task, int) {
    const Index last = task < (count - 1) / piece ? (task + 1) * piece : count;
    for (Index i = task * piece; i < last; ++i) work(i);
  });
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
