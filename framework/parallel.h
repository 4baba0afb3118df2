// Loops on all threads of the process: one pool, whose threads sleep while there is nothing to do.
//
//   std::vector<double> y(1000);
//   parallel_for(1000, 100, [&](Index i) { y[i] = std::sqrt(i); });   // pieces of 100
//
//   std::vector<Workspace> scratch(to_size(ThreadCount::current()));
//   parallel_tasks(64, [&](Index task, int thread) { scratch[thread].reserve(100); });
//
// The calling thread works, too; up to ThreadCount::current() - 1 threads of the pool join it. A
// task must write what no other one reads, so that results do not depend on the number of threads.
// Loops inside of a task run on the thread of the task. Threads that solve at the same time share
// the pool: where as many are at work as a loop may have, nobody joins it. In a forked child the
// pool begins anew. Not for a handful of short tasks: waking a thread is a call of the system.
#pragma once

#include <algorithm>
#include <functional>

#include "majorant/framework/thread_count.h"
#include "majorant/framework/types.h"

namespace majorant {

// work(task, thread) for all tasks 0 to count - 1, begun in ascending order; thread: from 0 to
// threads - 1, no two tasks have the same one at the same time. After one has thrown none begins
// any more, and what the lowest of those that failed threw is thrown.
void parallel_tasks(Index count, const std::function<void(Index task, int thread)>& work,
                    int threads = ThreadCount::current());

// Whether the calling thread runs a task, where further loops are its own.
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
