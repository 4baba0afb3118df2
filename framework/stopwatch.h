// Wall-clock time of pieces of work.
//
//     Stopwatch watch;
//     assemble();   record.seconds.assemble = watch.restart();
//     factorize();  record.seconds.factorize = watch.restart();
//
//     const AddedSeconds time(counters.value_seconds);   // until the end of this block
#pragma once

#include <chrono>
#include <utility>

namespace majorant {

class Stopwatch {
 public:
  // Returns the seconds since the last call, or since construction.
  double restart() {
    const auto now = Clock::now();
    return std::chrono::duration<double>(now - std::exchange(started_, now)).count();
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point started_ = Clock::now();
};

// Adds the time from its construction to its destruction to a sum.
class AddedSeconds {
 public:
  explicit AddedSeconds(double& sum) : sum_(sum) {}
  ~AddedSeconds() { sum_ += watch_.restart(); }
  AddedSeconds(const AddedSeconds&) = delete;
  AddedSeconds& operator=(const AddedSeconds&) = delete;

 private:
  double& sum_;
  Stopwatch watch_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
