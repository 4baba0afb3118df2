// The one owner of what spans a whole run: trace over degrees and rebuilt problems, counters, time
// limit, interruption.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <limits>
#include <vector>

#include "majorant/framework/minimizer.h"

namespace majorant {

struct TraceEntry {
  int degree = 1;
  IterationRecord record;  // record.iteration counts through the whole run
};

class RunRecord {
 public:
  // Called after every iteration.
  using Progress = std::function<void(const TraceEntry&)>;

  explicit RunRecord(double time_limit_seconds = std::numeric_limits<double>::infinity(),
                     int max_iterations = std::numeric_limits<int>::max(),
                     const std::atomic<bool>* interrupt = nullptr, Progress progress = {})
      : time_limit_(time_limit_seconds),
        max_iterations_(max_iterations),
        interrupt_(interrupt),
        progress_(std::move(progress)) {}

  // Observer for a solve at one degree.
  Observer observer(int degree) {
    return [this, degree](const IterationRecord& record, const Vec&) {
      TraceEntry entry{degree, record};
      entry.record.iteration = static_cast<int>(trace_.size()) + 1;
      trace_.push_back(entry);
      if (progress_) progress_(entry);
      return directive();
    };
  }
  Directive directive() const {
    if (interrupt_ && interrupt_->load()) return Directive::Interrupt;
    return seconds() > time_limit_ ? Directive::TimeLimit : Directive::Continue;
  }
  int iterations_left() const { return max_iterations_ - static_cast<int>(trace_.size()); }
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  const std::vector<TraceEntry>& trace() const { return trace_; }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  double time_limit_;
  int max_iterations_;
  const std::atomic<bool>* interrupt_;
  Progress progress_;
  std::vector<TraceEntry> trace_;
};

}  // namespace majorant
