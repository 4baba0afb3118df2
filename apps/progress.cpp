#include "apps/progress.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include "apps/streams.h"

namespace majorant::app {
namespace {

using Clock = std::chrono::steady_clock;

std::string without_degree(const TraceEntry& e) {
  const std::string phase =
      e.phase == Phase::Newton ? "" : fmt::format("  ({})", phase_name(e.phase));
  const std::string level = e.level == 0 ? "" : fmt::format("  (level {})", e.level);
  // With a scaffold the sum of both energies decreases.
  const double decrease = e.record.relative_decrease;
  return fmt::format("iteration {:3}  energy {:.8g}  {} {:.1e}  step {:.2g}{}{}",
                     e.record.iteration, e.energy, decrease < 0 ? "increase" : "decrease",
                     std::abs(decrease), e.record.step, phase, level);
}

std::string line(const TraceEntry& e) {
  return fmt::format("degree {}  {}", e.degree, without_degree(e));
}

// The number of characters that fit on one line: a line that wraps cannot be taken away.
std::size_t terminal_width() {
  winsize size{};
  if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return 80;
  return size.ws_col;
}

}  // namespace

// The line at the bottom of a terminal.
class LiveLine {
 public:
  explicit LiveLine(std::vector<Activity> stages)
      : stages_(std::move(stages)), cuts_(std::ranges::count(stages_, Activity::Cutting) > 0) {
    try {
      thread_ = std::jthread([this](const std::stop_token& ended) { tick(ended); });
    } catch (const std::system_error&) {  // no room for a thread: shown when something happens
    }
  }
  ~LiveLine() {
    thread_.request_stop();
    if (thread_.joinable()) thread_.join();
    show_live({});
  }

  void begin(Activity activity) {
    const std::lock_guard lock(mutex_);
    if (activity_ != activity) part_.clear();  // a chart may be solved more than once
    activity_ = activity;
    since_ = Clock::now();
    step_.clear();
    show();
  }
  void say_of_part(std::string_view text) {
    const std::lock_guard lock(mutex_);
    part_ = text;
    step_.clear();
    show();
  }
  // After a chart there is room for the energy on 80 columns without the degree that most have.
  void say_of_step(const TraceEntry& e) {
    const std::lock_guard lock(mutex_);
    if (!cuts_) part_.clear();
    step_ = cuts_ && e.degree == 1 ? without_degree(e) : line(e);
    show();
  }

 private:
  static constexpr std::chrono::milliseconds kPeriod{500};

  void tick(const std::stop_token& ended) {
    std::unique_lock lock(mutex_);
    while (!changed_.wait_for(lock, ended, kPeriod, [&] { return ended.stop_requested(); })) show();
  }
  void show() const {
    if (!activity_) return;
    const std::string text = fmt::format("{}{} {:.1f} s  {}{}{}", bar(), activity_name(*activity_),
                                         seconds_since(since_), part_,
                                         part_.empty() || step_.empty() ? "" : "  ", step_);
    show_live(std::string_view(text).substr(0, terminal_width() - 1));
  }

  // "[##..] 2 of 4 "; empty where the activity is none of the stages.
  std::string bar() const {
    const auto found = std::find(stages_.begin(), stages_.end(), *activity_);
    if (found == stages_.end()) return {};
    const auto done = static_cast<std::size_t>(found - stages_.begin()) + 1;
    return fmt::format("[{}{}] {} of {} ", std::string(done, '#'),
                       std::string(stages_.size() - done, '.'), done, stages_.size());
  }

  const std::vector<Activity> stages_;
  const bool cuts_;   // then parts are charts, and last for many steps; else until the next step
  std::mutex mutex_;  // of all below
  std::condition_variable_any changed_;
  std::optional<Activity> activity_;
  Clock::time_point since_;
  std::string part_;  // what was announced
  std::string step_;  // the last one of it
  std::jthread thread_;
};

// The lines of a log.
class Log {
 public:
  void begin(Activity activity) {
    end();
    activity_ = activity;
    since_ = Clock::now();
  }
  // Steps tell of what is solved, nothing else of what is cut.
  void announce(std::string_view part) {
    if (activity_ == Activity::Cutting) held_ += fmt::format("{}\n", part);
  }
  void end() {
    if (!activity_) return;
    held_ += fmt::format("{:<9} {:8.2f} s\n", activity_name(*activity_), seconds_since(since_));
    if (*activity_ == Activity::Solving) flush();
    if (is_open_) flush();
    activity_.reset();
  }
  void flush() {
    is_open_ = true;
    if (!held_.empty()) say_text(held_);
    held_.clear();
  }

 private:
  std::optional<Activity> activity_;
  Clock::time_point since_;
  std::string held_;
  bool is_open_ = false;  // nothing is held back any more
};

class Progress::Display {
 public:
  Display(const CommonOptions& options, std::vector<Activity> stages)
      : is_verbose_(options.verbose) {
    if (!is_verbose_ && isatty(STDERR_FILENO))
      live_.emplace(std::move(stages));
    else
      log_.emplace();
  }
  void begin(Activity activity) {
    degree_ = 0;
    if (live_) live_->begin(activity);
    if (log_) log_->begin(activity);
  }
  void note(const TraceEntry& e) {
    if (live_) return live_->say_of_step(e);
    const bool is_told = is_verbose_ || e.degree != degree_ || e.record.iteration % 10 == 0;
    degree_ = e.degree;
    if (!is_told) return;
    log_->flush();
    say("{}\n", line(e));
  }
  void announce(std::string_view part) {
    if (live_) live_->say_of_part(part);
    if (log_) log_->announce(part);
  }
  void finish() {
    if (!log_) return;
    log_->end();
    log_->flush();
  }

 private:
  bool is_verbose_;
  int degree_ = 0;
  std::optional<LiveLine> live_;
  std::optional<Log> log_;  // where live_ is not
};

Progress::Progress(const CommonOptions& options, std::vector<Activity> stages) {
  if (!options.quiet) display_ = std::make_unique<Display>(options, std::move(stages));
}

Progress::~Progress() = default;

void Progress::begin(Activity activity) {
  if (display_) display_->begin(activity);
}

void Progress::announce(std::string_view part) {
  if (display_) display_->announce(part);
}

Directive Progress::after_step(const TraceEntry& row, const Vec&) {
  if (display_) display_->note(row);
  return Directive::Continue;
}

void Progress::finish() {
  if (display_) display_->finish();
  display_.reset();
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
