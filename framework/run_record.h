// The one owner of what spans a whole run: trace over degrees and rebuilt problems, time limit,
// interruption.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "majorant/framework/error.h"
#include "majorant/framework/minimizer.h"
#include "majorant/framework/ranks.h"
#include "majorant/framework/trace.h"

namespace majorant {

class RunRecord {
 public:
  // Seconds beyond the time limit that reading and making the start may take: what is stopped
  // before it has a map has nothing to show. (50,000 faces take half a second for both.) Ctrl-C has
  // no such grace.
  static constexpr double kGrace = 10;

  // interrupt: set by others, a signal handler say, and looked at between pieces of work; may be
  // null, and so may the observer, which outlives the record. Throws InvalidArgument for a time
  // limit that is NaN and a negative number of iterations.
  explicit RunRecord(double time_limit_seconds = std::numeric_limits<double>::infinity(),
                     int max_iterations = std::numeric_limits<int>::max(),
                     const std::atomic<bool>* interrupt = nullptr, RunObserver* observer = nullptr)
      : max_iterations_(max_iterations),
        stop_(limits(start_, time_limit_seconds, interrupt)),
        start_stop_(limits(start_, time_limit_seconds + kGrace, interrupt)),
        observer_(observer) {
    if (std::isnan(time_limit_seconds))
      throw InvalidArgument("RunRecord: the time limit is nan; infinity is no limit");
    if (max_iterations < 0) throw InvalidArgument("RunRecord: the iteration limit is negative");
  }
  // Ended by `stop` alone, without grace.
  explicit RunRecord(const StopCheck& stop) : stop_(stop), start_stop_(stop) {}
  // Processes that solve one problem together stop together: from here on directive(), note() and
  // iterations_left() answer what they do on rank 0, and all ranks ask them. ranks: outlives that.
  void agree(const Ranks& ranks) { ranks_ = &ranks; }
  // Of one part of the run that is solved by itself, perhaps on another thread: the same limits
  // (iterations count from 0), a trace of its own; what it begins is not announced, its steps are
  // told the observer.
  RunRecord part(RunObserver* observer = nullptr) const {
    RunRecord part;
    part.max_iterations_ = max_iterations_;
    part.observer_ = observer;
    part.is_part_ = true;
    part.stop_ = stop_;
    part.start_stop_ = start_stop_;
    return part;
  }

  // A row of the trace, right after its step: its number, its times and the remedy that was marked
  // are filled in.
  Directive note(TraceEntry row) {
    const double before = trace_.empty() ? 0.0 : trace_.back().elapsed;
    row.record.iteration = static_cast<int>(trace_.size()) + 1;
    row.remedy = std::exchange(remedy_, std::nullopt);
    row.elapsed = seconds();
    row.other_seconds = std::max(0.0, row.elapsed - before - row.record.seconds.sum());
    trace_.push_back(std::move(row));
    const Directive asked =
        observer_ ? observer_->after_step(trace_.back(), {}) : Directive::Continue;
    const Directive limit = stop_();
    return ranks_->of_first(limit == Directive::Continue ? asked : limit);
  }
  void begin(Activity activity) const {
    if (observer_ && !is_part_) observer_->begin(activity);
  }
  // The next iteration is the first one after that.
  void mark(Remedy remedy) { remedy_ = remedy; }
  // At the end of a solve: the next one's first iteration is not.
  void forget_mark() { remedy_.reset(); }
  // For everything once there is a map, and before. Both may outlive the record.
  const StopCheck& stop() const { return stop_; }
  const StopCheck& start_stop() const { return start_stop_; }
  Directive directive() const { return ranks_->of_first(stop_()); }
  // On coarser meshes iterations do not count, in vain they do.
  int iterations_left() const {
    const auto used = std::count_if(trace_.begin(), trace_.end(),
                                    [](const TraceEntry& row) { return row.level == 0; });
    return ranks_->of_first(max_iterations_ - static_cast<int>(used));
  }
  double seconds() const { return seconds_since(start_); }
  const std::vector<TraceEntry>& trace() const { return trace_; }
  RunObserver* observer() const { return observer_; }  // may be null

 private:
  using Clock = std::chrono::steady_clock;

  static double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
  }
  static StopCheck limits(Clock::time_point start, double limit,
                          const std::atomic<bool>* interrupt) {
    return StopCheck([=] {
      if (interrupt && interrupt->load(std::memory_order_relaxed)) return Directive::Interrupt;
      const bool late =
          limit < std::numeric_limits<double>::infinity() && seconds_since(start) > limit;
      return late ? Directive::TimeLimit : Directive::Continue;
    });
  }

  Clock::time_point start_ = Clock::now();
  int max_iterations_ = std::numeric_limits<int>::max();
  StopCheck stop_, start_stop_;
  RunObserver* observer_ = nullptr;
  bool is_part_ = false;
  std::vector<TraceEntry> trace_;
  std::optional<Remedy> remedy_;
  const Ranks* ranks_ = one_process().get();
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
