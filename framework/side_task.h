// A task that runs beside its owner's work, on a free thread of the pool (parallel.h).
//
//   std::vector<int> order;
//   SideTask side([&] { order.assign(1000, 0); });
//   const double x = std::sqrt(2.0);             // work that does not need the order
//   if (!side.finish()) order.assign(1000, 0);   // no thread was free
//
// It begins only if its owner may use a second thread and is in no task of a parallel loop. While
// it runs, loops of the owner have one thread less. Loops inside the task run on its thread. Not
// for many pieces of work (parallel_tasks()), nor for work of less than some 0.1 ms.
#pragma once

#include <exception>
#include <functional>
#include <memory>

#include "majorant/framework/parallel.h"

namespace majorant {

class SideTask {
 public:
  explicit SideTask(std::function<void()> work);
  // Waits for the task if it has begun, and cancels it otherwise.
  ~SideTask();
  SideTask(const SideTask&) = delete;
  SideTask& operator=(const SideTask&) = delete;

  // Waits for the end of the task, and throws its exception. Returns false if it has not run and
  // never will: no thread was free, or this is a forked child, which does not have the thread.
  bool finish();

  struct State;  // of the pool

 private:
  std::unique_ptr<State> state_;
};

// Calls first() and second(), which must be independent, at the same time if a thread is free. Both
// are called, even if the other throws. Then throws the exception of first(), otherwise that of
// second().
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
