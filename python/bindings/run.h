// A piece of work of the library on behalf of Python: without the interpreter's lock, ended by
// Ctrl-C, watched by a callback.
//
//     Run run(time_limit, max_iterations, callback);
//     ParametrizationResult result = run([&] { return parametrize(mesh, options, run.record()); });
//
// Ctrl-C ends the work at the next poll, some milliseconds later, and then raises what Python's own
// handler of SIGINT raises, KeyboardInterrupt unless a program has changed that; where it raises
// nothing, the work has ended like one that was interrupted. As everywhere in Python, that concerns
// the main thread alone. What the callback raises ends the work, and is raised again as it was.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <csignal>
#include <exception>
#include <functional>
#include <mutex>

#include "majorant/framework/run_record.h"

namespace majorant::python {

namespace py = pybind11;

// The exception to be raised once the work has ended: the first exception of any callback, from any
// thread.
class Raised {
 public:
  // call(), with the interpreter's lock; false where that raised or something had before.
  bool guard(const std::function<void()>& call);
  bool any() const { return any_.load(); }
  void rethrow() const {
    if (any()) std::rethrow_exception(first_);
  }

 private:
  std::mutex alone_;
  std::atomic<bool> any_{false};
  std::exception_ptr first_;
};

// While one lives on the main thread, SIGINT sets the flag, and then does what it did before.
class InterruptScope {
 public:
  explicit InterruptScope(std::atomic<bool>& flag);
  ~InterruptScope();
  InterruptScope(const InterruptScope&) = delete;
  InterruptScope& operator=(const InterruptScope&) = delete;

 private:
  std::atomic<bool>* outer_ = nullptr;
  struct sigaction before_ {};
  bool installed_ = false;
};

class Run final : public RunObserver {
 public:
  // callback: called with a Step after every step, or None; what it returns is true ends the run.
  Run(double time_limit, int max_iterations, py::object callback);
  // The run of programs without limits.
  Run();

  RunRecord& record() { return record_; }
  const StopCheck& stop() const { return record_.stop(); }
  Raised& raised() { return raised_; }
  // For exceptions that come up elsewhere: the work ends at its next poll.
  std::atomic<bool>& interrupted() { return interrupted_; }

  template <class Work>
  auto operator()(const Work& work) {
    const InterruptScope scope(interrupted_);
    const auto unlocked = [&] {
      const py::gil_scoped_release release;
      return work();
    };
    try {
      auto result = unlocked();
      raise();
      return result;
    } catch (...) {
      raise();
      throw;
    }
  }

 private:
  Directive after_step(const TraceEntry& row, const Vec&) override;
  void raise() const;

  py::object callback_;
  std::atomic<bool> interrupted_{false};
  Raised raised_;
  RunRecord record_;
};

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
