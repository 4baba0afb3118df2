// A run of the library for Python. It releases the interpreter's lock, ends on Ctrl-C, and calls a
// callback after every step.
//
//     Run run(time_limit, max_iterations, callback);
//     ParametrizationResult result = run([&] { return parametrize(mesh, options, run.record()); });
//
// Ctrl-C ends the run at its next poll, some milliseconds later. Then Python's handler of SIGINT is
// called, which usually raises KeyboardInterrupt; if it raises nothing, the run returns as an
// interrupted one. As usual in Python, this applies to the main thread only. An exception of the
// callback ends the run and is raised again.
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

// The exception that is raised after the end of a run: the first one of any callback on any
// thread.
class Raised {
 public:
  // Runs call() with the interpreter's lock. Returns false if it raised, or if an earlier call did.
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

// During its life on the main thread, SIGINT sets the flag, and then calls the previous handler.
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
  // callback: None, or called with a Step after every step; a true return value ends the run.
  Run(double time_limit, int max_iterations, py::object callback);
  // Makes a run without limits and callback.
  Run();

  RunRecord& record() { return record_; }
  const StopCheck& stop() const { return record_.stop(); }
  Raised& raised() { return raised_; }
  // The flag that ends the run at its next poll. Other callbacks set it if they raise.
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
