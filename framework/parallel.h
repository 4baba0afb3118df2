// The number of threads that a block may use, and parallel loops. The process has one pool, whose
// threads sleep while there is nothing to do.
//
//   const ThreadCount two(2);          // until the end of this block, for what this thread calls
//   std::vector<double> y(1000);
//   parallel_for(1000, 100, [&](Index i) { y[i] = std::sqrt(i); });   // pieces of 100
//
//   std::vector<Workspace> scratch(to_size(ThreadCount::current()));
//   parallel_tasks(64, [&](Index task, int thread) { scratch[thread].reserve(100); });
//
// Evaluators, checkers and all solvers run their loops this way. The calling thread takes part, and
// up to ThreadCount::current() - 1 threads of the pool join it. A task must not write what another
// task reads, so that results do not depend on the number of threads, to the last bit. Loops inside
// a task run on the thread of the task. Threads that solve at the same time share the pool: no
// thread joins a loop while as many are at work as the loop may use. A forked child gets a new
// pool. Not for a handful of short tasks: waking a thread is a system call.
#pragma once

#include <algorithm>
#include <functional>

#include "majorant/framework/types.h"

namespace majorant {

// Sets the number of threads for the block that owns it. Two threads that solve at the same time do
// not see each other's number. parametrize(), deform() and make_seamless() take the number with
// their options.
class ThreadCount {
 public:
  // count 0 keeps the present number. Throws InvalidArgument if count < 0.
  explicit ThreadCount(int count);
  ~ThreadCount();  // restores the number; on the same thread
  ThreadCount(const ThreadCount&) = delete;
  ThreadCount& operator=(const ThreadCount&) = delete;

  // Returns the number for the calling thread. Without any ThreadCount it is the number of
  // processors of the process, by its affinity and the CPU quota of its control groups, and at most
  // OMP_NUM_THREADS. In a task of a parallel loop it is 1.
  static int current();

 private:
  int before_;
};

// Calls work(task, thread) for all tasks 0 to count - 1, started in ascending order. thread: 0 to
// threads - 1, different for tasks that run at the same time. After a task has thrown no other
// begins; the exception of the lowest failed task is then thrown.
void parallel_tasks(Index count, const std::function<void(Index task, int thread)>& work,
                    int threads = ThreadCount::current());

// Returns whether the calling thread runs a task; further loops then run on it alone.
bool is_parallel_task();

// Calls work(i) for all i from 0 to count - 1, `piece` successive ones in a task.
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
