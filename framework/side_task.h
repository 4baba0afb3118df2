// Work that goes on beside what its owner does: on a thread of the pool (parallel.h) that is free.
//
//   std::vector<int> order;
//   SideTask side([&] { order.assign(1000, 0); });
//   const double x = std::sqrt(2.0);             // what does not need the order
//   if (!side.finish()) order.assign(1000, 0);   // no thread was free: here
//
// It begins only where its owner may have a second thread and is in no task of a parallel loop; as
// long as it runs, loops of the owner have one thread less. Loops inside of it run on its thread.
// Not for many pieces of work: parallel_tasks(); nor for what takes less than some 0.1 ms.
#pragma once

#include <exception>
#include <functional>
#include <memory>

#include "majorant/framework/parallel.h"

namespace majorant {

class SideTask {
 public:
  explicit SideTask(std::function<void()> work);
  // Waits where it has begun; where it has not, it never does.
  ~SideTask();
  SideTask(const SideTask&) = delete;
  SideTask& operator=(const SideTask&) = delete;

  // Waits for its end, and throws what it threw. False: it has not been done and never will be,
  // since no thread was free, or since this is a forked child, which has not the thread.
  bool finish();

  struct State;  // of the pool

 private:
  std::unique_ptr<State> state_;
};

// first() and second(), which do not depend on each other, at the same time where a thread is free.
// Throws what first() throws, else what second() does; either is called whatever the other throws.
template <class First, class Second>
void both(const First& first, const Second& second) {
  if (ThreadCount::current() == 1) {
    first();
    return second();
  }
  SideTask side([&] { first(); });
  std::exception_ptr error;
  try {
    second();
  } catch (...) {
    error = std::current_exception();
  }
  if (!side.finish()) first();
  if (error) std::rethrow_exception(error);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
