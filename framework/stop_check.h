// Asks, now and then, whether to go on: a time limit, Ctrl-C, a test. What may run for long is
// given one by value and polls it between pieces of bounded work; where it knows how much of the
// work is done, it says so to the same.
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
// Most checks are silent: what is said to them goes nowhere. Who begins work that is all of what is
// shown as under way makes a telling one (RunRecord::telling), and who divides such work into
// pieces gives each its part of it, so that shares only grow:
//
//   const StopCheck told = stop.telling([](double share) { std::cerr << 100 * share << " %\n"; });
//   const auto work = [](const StopCheck& check) { check.advance(0.5); };
//   work(told.between(0, 0.3));   // 15 % of all
//   work(told.between(0.3, 1));   // 65 %
//   work(told.silent());
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
  // Told the share of the work that is done, from 0 to 1, by several threads at a time.
  using Tell = std::function<void(double share)>;

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
  // The same in a loop of so many, which is all of the work.
  void poll_at(std::size_t index, std::size_t count) const {
    if (index % kPeriod != 0) return;
    poll();
    advance(index, count);
  }
  static constexpr std::size_t kPeriod = 4096;

  // Says that this share of the work is done; so many pieces of it.
  void advance(double share) const {
    if (tell_) tell_(from_ + share * (to_ - from_));
  }
  void advance(std::size_t done, std::size_t count) const {
    if (tell_ && count > 0) advance(static_cast<double>(done) / static_cast<double>(count));
  }
  // These ask as this one does: of work all of which `tell` is told of, of the piece from one share
  // of this work to another, of what nobody is told of.
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
  // Tells as this one does.
  StopCheck asking(Ask ask) const {
    StopCheck check = *this;
    check.ask_ = std::move(ask);
    return check;
  }

 private:
  Ask ask_;
  Tell tell_;                 // none: silent
  double from_ = 0, to_ = 1;  // the part of what tell_ is told of
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
