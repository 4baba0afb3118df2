// Asks, now and then, whether to go on: a time limit, Ctrl-C, a test. What may run for long is
// given one by value and polls it between pieces of bounded work.
//
//   std::atomic<bool> flag = false;
//   StopCheck stop([&] { return flag ? Directive::Interrupt : Directive::Continue; });
//   for (int piece = 0; piece < 1000; ++piece) {
//     stop.poll();  // throws Stopped
//     ...
//   }
//
// Who catches Stopped keeps the state it had before: solvers return the last accepted point with
// the status that belongs to it, readers and starts let it pass. Tasks of a parallel loop may throw
// it, too (parallel.h).
//
// Not for the limits of a whole run, of which RunRecord (run_record.h) makes the checks, nor for
// ends that a solver finds by itself: StoppingRules (minimizer.h).
#pragma once

#include <cstddef>
#include <exception>
#include <functional>
#include <utility>

namespace majorant {

// The answer to the question whether to go on: anything but Continue ends a run.
enum class Directive { Continue, TimeLimit, Interrupt };

// Thrown by StopCheck::poll(). Not an error: the user wanted it.
class Stopped : public std::exception {
 public:
  explicit Stopped(Directive why) : why_(why) {}
  Directive why() const { return why_; }
  const char* what() const noexcept override {
    return why_ == Directive::TimeLimit ? "the time limit was reached" : "interrupted";
  }

 private:
  Directive why_;
};

class StopCheck {
 public:
  // Called from several threads at a time; once it does not say Continue, it never does again.
  using Ask = std::function<Directive()>;

  StopCheck() = default;  // never stops, costs nothing
  explicit StopCheck(Ask ask) : ask_(std::move(ask)) {}

  bool may_stop() const { return ask_ != nullptr; }
  Directive operator()() const { return ask_ ? ask_() : Directive::Continue; }
  void poll() const {
    if (const Directive why = (*this)(); why != Directive::Continue) throw Stopped(why);
  }
  // Polls, in loops over small things, at multiples of a number of them that takes some 0.1 ms.
  void poll_at(std::size_t index) const {
    if (index % kPeriod == 0) poll();
  }
  static constexpr std::size_t kPeriod = 4096;

 private:
  Ask ask_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
