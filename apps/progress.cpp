#include "apps/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstdint>
#include <iterator>
#include <mutex>
#include <optional>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include "apps/process.h"
#include "apps/streams.h"
#include "majorant/io/files/byte_counts.h"

namespace majorant::app {
namespace {

using Clock = std::chrono::steady_clock;

// This buffer usually stays on the stack. An allocation on the display's thread would map 64 MiB of
// address space for that thread.
using Text = fmt::memory_buffer;

template <class... Args>
void append(Text& text, fmt::format_string<Args...> format, Args&&... args) {
  fmt::format_to(std::back_inserter(text), format, std::forward<Args>(args)...);
}

std::string without_degree(const TraceEntry& e) {
  const std::string phase =
      e.phase == Phase::Newton ? "" : fmt::format("  ({})", phase_name(e.phase));
  const std::string level = e.level == 0 ? "" : fmt::format("  (level {})", e.level);
  // With a scaffold, the sum of both energies decreases.
  const double decrease = e.record.relative_decrease;
  return fmt::format("iteration {:3}  energy {:.8g}  {} {:.1e}  step {:.2g}{}{}",
                     e.record.iteration, e.energy, decrease < 0 ? "increase" : "decrease",
                     std::abs(decrease), e.record.step, phase, level);
}

std::string line(const TraceEntry& e) {
  return fmt::format("degree {}  {}", e.degree, without_degree(e));
}

// Returns the number of characters that fit on one line. A line that wraps could not be cleared.
std::size_t terminal_width() {
  winsize size{};
  if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return 80;
  return size.ws_col;
}

// Returns the longest beginning that fits and does not split a multi-byte character.
std::string_view cut_to(std::string_view text, std::size_t size) {
  if (text.size() <= size) return text;
  while (size > 0 && (static_cast<unsigned char>(text[size]) & 0xc0) == 0x80) --size;
  return text.substr(0, size);
}

// Appends "1:07" or "1:02:03".
void append_clock(Text& text, double seconds) {
  const auto all = static_cast<long>(seconds);
  if (all >= 3600) append(text, "{}:{:02}:{:02}", all / 3600, all / 60 % 60, all % 60);
  if (all < 3600) append(text, "{}:{:02}", all / 60, all % 60);
}

// The mark of a start's share in an announcement: "chart 1 of 2, start 20 %".
constexpr std::string_view kStartShare = ", start ";

// Rounds an estimate to a plausible precision.
double rounded_estimate(double seconds) {
  const double unit = seconds < 10 ? 1 : seconds < 60 ? 5 : seconds < 600 ? 10 : 60;
  return std::max(1.0, std::round(seconds / unit)) * unit;
}

}  // namespace

// A snapshot of ByteCounts.
struct Bytes {
  std::uint64_t to_read = byte_counts().to_read, read = byte_counts().read;
  std::uint64_t to_parse = byte_counts().to_parse, parsed = byte_counts().parsed;
  std::uint64_t written = byte_counts().written;
};

// The current activity of a run with its share and its duration.
class Standing {
 public:
  explicit Standing(std::vector<Activity> stages) : stages_(std::move(stages)) {}

  bool has_begun() const { return activity_.has_value(); }
  bool cuts() const { return std::ranges::count(stages_, Activity::Cutting) > 0; }

  void begin(Activity activity) {
    if (activity_ != activity) {
      part_.clear();  // a chart may be solved more than once
      begin_shares();
    }
    activity_ = activity;
    step_.clear();
    const auto first = stages_.begin() + std::max<std::ptrdiff_t>(stage_, 0);
    const auto next = std::find(first, stages_.end(), activity);
    if (next != stages_.end()) stage_ = next - stages_.begin();
  }
  void begin_pass(int pass, int most) {
    pass_ = pass;
    most_ = most;
    begin_shares();
  }
  void announce(std::string_view part) {
    part_ = one_line(part);
    step_.clear();
  }
  // May be called from any thread.
  void advance(double share) {
    double known = share_.load();
    while (share > known && !share_.compare_exchange_weak(known, share)) {
    }
  }
  // After "chart N of M" 80 columns have no room for both degree and energy, so the degree is left
  // out.
  void note(const TraceEntry& e) {
    if (!cuts()) part_.clear();
    part_ = part_.substr(0, part_.find(kStartShare));  // removes the share of the start, which is
                                                       // over
    step_ = cuts() && e.degree == 1 ? without_degree(e) : line(e);
  }

  // Appends "[##..] "; nothing if the activity is not one of the stages.
  void append_bar(Text& text) const {
    if (stage_ < 0) return;
    append(text, "[{:#<{}}{:.<{}}] ", "", stage_ + 1, "", count() - stage_ - 1);
  }
  // Appends "2 of 4 solving 41 %  1:12, about 0:40 left  pass 2  chart 3 of 17  iteration 7 ...".
  void append_to(Text& text) const {
    if (stage_ >= 0) append(text, "{} of {} ", stage_ + 1, count());
    append(text, "{}", activity_name(*activity_));
    const Bytes now;
    const std::optional<double> done = share(now);
    if (done) append(text, " {} %", static_cast<int>(100 * *done));
    append_bytes(text, now);
    append(text, "  ");
    append_clock(text, seconds_since(start_));
    if (interruption_flag()->load(std::memory_order_relaxed))
      append(text, ", stopping");
    else
      append_what_is_left(text, done);
    if (pass_ > 1) append(text, "  pass {}", pass_);
    if (pass_ > 1 && most_ > 0) append(text, " of at most {}", most_);
    if (!part_.empty()) append(text, "  {}", part_);
    if (!step_.empty()) append(text, "  {}", step_);
  }

 private:
  // The share and time of a stage from which on its remaining time is estimated.
  static constexpr double kLeastShare = 0.05, kLeastSeconds = 2;

  std::ptrdiff_t count() const { return std::ssize(stages_); }

  void begin_shares() {
    share_ = kNoShare;
    since_ = Clock::now();
    before_ = Bytes();
  }

  // Returns the reported share, or while files are read the share of bytes that are read and
  // parsed.
  std::optional<double> share(const Bytes& now) const {
    if (const double reported = share_.load(); reported > kNoShare)
      return std::clamp(reported, 0.0, 1.0);
    // Announcements begin after files are parsed.
    return activity_ == Activity::Reading && part_.empty() ? parsed_share(now) : std::nullopt;
  }
  std::optional<double> parsed_share(const Bytes& now) const {
    if (now.to_parse <= before_.to_parse) return {};
    return std::min(1.0, static_cast<double>(now.parsed - before_.parsed) /
                             static_cast<double>(now.to_parse - before_.to_parse));
  }

  void append_bytes(Text& text, const Bytes& now) const {
    const std::uint64_t read = now.read - before_.read, to_read = now.to_read - before_.to_read;
    if (activity_ == Activity::Reading && read > 0) append(text, " {}", bytes_text(read));
    if (activity_ == Activity::Reading && read < to_read)
      append(text, " of {}", bytes_text(to_read));
    if (activity_ != Activity::Writing) return;
    if (now.written > before_.written)
      append(text, " {}", bytes_text(now.written - before_.written));
    if (const std::optional<double> parsed = parsed_share(now))
      append(text, ", {} % read back", static_cast<int>(100 * *parsed));
  }

  void append_what_is_left(Text& text, std::optional<double> done) const {
    const double taken = seconds_since(since_);
    if (!done || *done < kLeastShare || taken < kLeastSeconds) return;
    append(text, ", about ");
    append_clock(text, rounded_estimate(taken * (1 - *done) / *done));
    append(text, " left");
  }

  static constexpr double kNoShare = -1;

  const std::vector<Activity> stages_;
  const Clock::time_point start_ = Clock::now();
  std::optional<Activity> activity_;
  std::ptrdiff_t stage_ = -1;  // -1: none yet
  int pass_ = 1, most_ = 0;
  Clock::time_point since_;  // start of this activity in this pass
  Bytes before_;
  std::atomic<double> share_{kNoShare};
  std::string part_;  // last announcement
  std::string step_;  // last step of that part
};

// The plain lines of a log.
class Log {
 public:
  // Analysing and cutting a surface, which begin one after the other, share one line.
  void begin(Activity activity) {
    if (activity_ == activity && activity == Activity::Cutting && !is_announced_) return;
    end();
    activity_ = activity;
    since_ = Clock::now();
    is_announced_ = false;
  }
  // Steps are printed for solves, announcements for cuts.
  void announce(std::string_view part) {
    is_announced_ = true;
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
    if (!held_.empty()) say(held_);
    held_.clear();
  }
  void say(std::string_view text) {
    last_line_ = Clock::now();
    say_text(text);
  }
  double silence() const { return seconds_since(last_line_); }

 private:
  std::optional<Activity> activity_;
  Clock::time_point since_;
  Clock::time_point last_line_ = Clock::now();
  std::string held_;
  bool is_announced_ = false;  // an announcement of the activity was printed
  bool is_open_ = false;       // lines are no longer held back
};

class Progress::Display {
 public:
  Display(const CommonOptions& options, std::vector<Activity> stages)
      : is_verbose_(options.verbose),
        is_live_(!options.verbose && isatty(STDERR_FILENO)),
        standing_(std::move(stages)) {
    try {
      thread_ = std::jthread([this](const std::stop_token& ended) { tick(ended); });
    } catch (const std::system_error&) {  // no thread could be started: the line is updated at
                                          // events instead
    }
  }
  ~Display() {
    thread_.request_stop();
    if (thread_.joinable()) thread_.join();
    if (is_live_) show_live({});
  }
  Display(const Display&) = delete;
  Display& operator=(const Display&) = delete;

  void begin(Activity activity) {
    const std::lock_guard lock(mutex_);
    degree_ = 0;
    standing_.begin(activity);
    if (!is_live_) log_.begin(activity);
    show();
  }
  void begin_pass(int pass, int most) {
    const std::lock_guard lock(mutex_);
    standing_.begin_pass(pass, most);
    show();
  }
  void announce(std::string_view part) {
    const std::lock_guard lock(mutex_);
    standing_.announce(part);
    if (!is_live_) log_.announce(part);
    name_ = part;
    show();
  }
  void advance(double share) { standing_.advance(share); }
  void note(const TraceEntry& e) {
    const std::lock_guard lock(mutex_);
    note(e, name_);
  }
  void note_part(std::string_view part, const std::vector<TraceEntry>& rows) {
    const std::lock_guard lock(mutex_);
    if (is_verbose_)
      for (const TraceEntry& row : rows) note(row, part);
    else if (!rows.empty())
      note(rows.back(), part);
  }
  void finish() {
    if (is_live_) return;
    const std::lock_guard lock(mutex_);
    log_.end();
    log_.flush();
  }

 private:
  static constexpr std::chrono::milliseconds kPeriod{500};
  // Seconds of silence after which a log prints the state of the run: five, less one period.
  static constexpr double kSilence = 4.3;

  void tick(const std::stop_token& ended) {
    std::unique_lock lock(mutex_);
    bool was_interrupted = false;
    while (!changed_.wait_for(lock, ended, kPeriod, [&] { return ended.stop_requested(); })) {
      show();
      const bool is_interrupted = interruption_flag()->load(std::memory_order_relaxed);
      const bool is_answer = is_interrupted && !std::exchange(was_interrupted, is_interrupted);
      if (!is_live_ && (is_answer || log_.silence() > kSilence)) say_where();
    }
  }

  void note(const TraceEntry& e, std::string_view part) {
    standing_.note(e);
    if (is_live_) return show();
    const bool is_shown = is_verbose_ || e.degree != degree_ || e.record.iteration % 10 == 0;
    degree_ = e.degree;
    if (!is_shown) return;
    log_.flush();
    const bool is_named = is_verbose_ && standing_.cuts() && !part.empty();
    log_.say(
        fmt::format("{}{}{}\n", is_named ? one_line(part) : "", is_named ? "  " : "", line(e)));
  }

  void show() const {
    if (!is_live_ || !standing_.has_begun()) return;
    Text text;
    standing_.append_bar(text);
    standing_.append_to(text);
    show_live(cut_to({text.data(), text.size()}, terminal_width() - 1));
  }

  void say_where() {
    if (!standing_.has_begun()) return;
    log_.flush();
    Text text;
    standing_.append_to(text);
    text.push_back('\n');
    log_.say({text.data(), text.size()});
  }

  const bool is_verbose_, is_live_;
  std::mutex mutex_;  // guards the members below, except Standing::advance()
  std::condition_variable_any changed_;
  Standing standing_;
  Log log_;           // used if stderr is not a terminal
  int degree_ = 0;    // degree of the last step
  std::string name_;  // part that the steps belong to
  std::jthread thread_;
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

void Progress::advance(double share) {
  if (display_) display_->advance(share);
}

void Progress::begin_pass(int pass, int most) {
  if (display_) display_->begin_pass(pass, most);
}

Directive Progress::after_step(const TraceEntry& row, const Vec&) {
  if (display_) display_->note(row);
  return Directive::Continue;
}

void Progress::after_part(std::string_view part, const std::vector<TraceEntry>& rows) {
  if (display_) display_->note_part(part, rows);
}

void Progress::finish() {
  if (display_) display_->finish();
  display_.reset();
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
