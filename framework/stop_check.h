// A check whether to go on, for a time limit, Ctrl-C or a test. Long-running functions get one by
// value and poll it between pieces of bounded work. They report the share of the work that is done
// to the same object.
//
//   std::atomic<bool> flag = false;
//   StopCheck stop([&] { return flag ? Directive::Interrupt : Directive::Continue; });
//   for (int piece = 0; piece < 1000; ++piece) {
//     stop.poll();  // throws Stopped
//     ...
//   }
//
// Whoever catches Stopped keeps the former state: solvers return the last accepted point with the
// status of the stop, readers and starts pass the exception on. Tasks of a parallel loop may throw
// it, too (parallel.h).
//
// Most checks are silent: reported shares are ignored. Code that begins work shown as a progress
// bar makes a telling check (RunRecord::telling). Code that divides such work into pieces gives
// each piece its part of the check, so that shares only grow:
//
//   const StopCheck told = stop.telling([](double share) { std::cerr << 100 * share << " %\n"; });
//   const auto work = [](const StopCheck& check) { check.advance(0.5); };
//   work(told.between(0, 0.3));   // 15 % of all
//   work(told.between(0.3, 1));   // 65 %
//   work(told.silent());
//
// Not for the limits of a whole run, for which RunRecord (run_record.h) makes the checks, nor for
// the rules by which a solver stops: StoppingRules (minimizer.h).
#pragma once

#include <cstddef>
#include <exception>
#include <functional>
#include <utility>

namespace majorant {

// The result of a check: any value but Continue ends a run.
enum class Directive { Continue, TimeLimit, Interrupt };

// Thrown by StopCheck::poll(). It is no error: the user requested the stop.
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
  // Called by several threads at a time; once it has returned another value than Continue, it must
  // not return Continue again.
  using Ask = std::function<Directive()>;
  // Receives the share of the work that is done, from 0 to 1, from several threads at a time.
  using Tell = std::function<void(double share)>;

  StopCheck() = default;  // never stops, costs nothing
  explicit StopCheck(Ask ask) : ask_(std::move(ask)) {}

  bool may_stop() const { return ask_ != nullptr; }
  Directive operator()() const { return ask_ ? ask_() : Directive::Continue; }
  void poll() const {
    if (const Directive why = (*this)(); why != Directive::Continue) throw Stopped(why);
  }
  // Polls at every n-th index, for loops over small pieces; n of them take some 0.1 ms.
  void poll_at(std::size_t index) const {
    if (index % kPeriod == 0) poll();
  }
  // Does the same in a loop of `count` pieces that is all of the work, and reports its share.
  void poll_at(std::size_t index, std::size_t count) const {
    if (index % kPeriod != 0) return;
    poll();
    advance(index, count);
  }
  static constexpr std::size_t kPeriod = 4096;

  // Reports the share of the work that is done, or the number of its pieces.
  void advance(double share) const {
    if (tell_) tell_(from_ + share * (to_ - from_));
  }
  void advance(std::size_t done, std::size_t count) const {
    if (tell_ && count > 0) advance(static_cast<double>(done) / static_cast<double>(count));
  }
  // Return checks that ask as this one does: one that reports all of its work to `tell`, one for
  // the piece of this work between two shares, and one that reports to nobody.
  StopCheck telling(Tell tell) const {
    StopCheck check(ask_);
    check.tell_ = std::move(tell);
    return check;
  }
  StopCheck between(double from, double to) const {
    StopCheck check = *this;
    check.from_ = from_ + from * (to_ - from_);
    check.to_ = from_ + to * (to_ - from_);
    return check;
  }
  StopCheck silent() const { return StopCheck(ask_); }
  // Returns a check that asks `ask` and reports as this one does.
  StopCheck asking(Ask ask) const {
    StopCheck check = *this;
    check.ask_ = std::move(ask);
    return check;
  }

 private:
  Ask ask_;
  Tell tell_;                 // none: silent
  double from_ = 0, to_ = 1;  // the part of the work reported to tell_
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
