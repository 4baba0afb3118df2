// A stop check that counts its polls and stops from the k-th one on. Tests end runs at every
// possible moment, and count polls afterwards instead of seconds.
#pragma once

#include <atomic>
#include <limits>
#include <memory>

#include "majorant/framework/stop_check.h"

namespace majorant {

class CountedStop {
 public:
  explicit CountedStop(long last = std::numeric_limits<long>::max()) : last_(last) {}

  StopCheck check() const {
    return StopCheck([polls = polls_, last = last_] {
      return ++*polls >= last ? Directive::Interrupt : Directive::Continue;
    });
  }
  long polls() const { return *polls_; }
  bool stopped() const { return polls() >= last_; }
  long polls_after() const { return stopped() ? polls() - last_ : 0; }

 private:
  std::shared_ptr<std::atomic<long>> polls_ = std::make_shared<std::atomic<long>>(0);
  long last_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
