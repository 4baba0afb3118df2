#include "apps/run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>

#include "apps/process.h"
#include "apps/streams.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/files/waiting_output.h"
#include "majorant/io/temporary_file.h"

namespace majorant::app {
namespace {

// Seconds that a picture may take after a stop. Blocked outputs are reported earlier.
constexpr double kDrawingPatience = Run::kPatience + 0.5;

// Returns the time until which a picture that is begun now may take.
std::chrono::steady_clock::time_point drawing_until() {
  const std::chrono::duration<double> patience(kDrawingPatience);
  return std::chrono::steady_clock::now() +
         std::chrono::duration_cast<std::chrono::steady_clock::duration>(patience);
}

// Runs without stages show no progress.
CommonOptions progress_options(const RunPlan& plan) {
  CommonOptions options = plan.common;
  options.quiet = options.quiet || plan.stages.empty();
  return options;
}

// Lets signals stop runs from now on, and acknowledges the first one.
const std::atomic<bool>* stop_on_signals(const CommonOptions& common) {
  acknowledge_signals(!common.quiet);
  return interruption_flag();
}

// Returns whether a file only shows the result.
bool is_drawing(const RunPlan& plan, const std::string& path) {
  const Format* const format = written_format(path);
  return !plan.images_are_results && format && serves(*format, FormatUse::Show);
}

// Returns "reading", for "interrupted while reading in.obj".
std::string_view doing(Activity activity) {
  if (activity == Activity::Starting) return "making the start of";
  if (activity == Activity::Scaffold) return "making the scaffold of";
  return activity_name(activity);
}

}  // namespace

// Forwards the events of a run to its progress, and watches for a stop on a thread of its own.
// kPatience after a stop it ends the process if no result would be lost.
class Run::Watch final : public RunObserver {
 public:
  // Ends a stopped run: writes the report and the line, and returns the exit code.
  using Ending = std::function<int(Directive)>;
  using Clock = std::chrono::steady_clock;

  Watch(const RunPlan& plan, Progress& progress) : plan_(plan), progress_(progress) {}
  ~Watch() override { end(); }
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  // without_result: the ending for activities that leave nothing to write.
  void start(StopCheck stop, Ending without_result) {
    stop_ = std::move(stop);
    without_result_ = std::move(without_result);
    try {
      thread_ = std::jthread([this](const std::stop_token& ended) { look(ended); });
    } catch (const std::system_error&) {  // no thread could be started: the work itself polls
    }
  }
  // Allows the process to end as `ending` describes, `patience` seconds after a stop but not before
  // `earliest`. An empty ending forbids it. Does not return if the process is already ending.
  void allow(Ending ending, double patience = kPatience, Clock::time_point earliest = {}) {
    const std::lock_guard lock(mutex_);
    ending_ = std::move(ending);
    patience_ = patience;
    earliest_ = earliest;
  }
  void end() {
    allow({});
    thread_.request_stop();
    if (thread_.joinable() && thread_.get_id() != std::this_thread::get_id()) thread_.join();
  }
  Activity activity() const { return activity_.load(); }

  void begin(Activity activity) override {
    const auto& kept = plan_.with_result;
    const bool has_result = std::find(kept.begin(), kept.end(), activity) != kept.end();
    allow(has_result ? Ending() : without_result_);
    activity_.store(activity);
    progress_.begin(activity);
  }
  void announce(std::string_view part) override { progress_.announce(part); }
  void advance(double share) override { progress_.advance(share); }
  void begin_pass(int pass, int most) override { progress_.begin_pass(pass, most); }
  Directive after_step(const TraceEntry& row, const Vec& y) override {
    return progress_.after_step(row, y);
  }
  void after_part(std::string_view part, const std::vector<TraceEntry>& rows) override {
    progress_.after_part(part, rows);
  }

 private:
  static constexpr std::chrono::milliseconds kPeriod{50};

  void look(const std::stop_token& ended) {
    std::unique_lock lock(mutex_);
    std::optional<Clock::time_point> since;
    while (!changed_.wait_for(lock, ended, kPeriod, [&] { return ended.stop_requested(); })) {
      const Directive why = stop_();
      if (why == Directive::Continue) continue;
      if (!since) since = Clock::now();
      const double waited = std::chrono::duration<double>(Clock::now() - *since).count();
      if (!ending_ || waited < patience_ || Clock::now() < earliest_) continue;
      const int code = ending_(why);  // the run waits for the mutex if it gets there
      remove_temporary_files();
      ::_exit(code);
    }
  }

  const RunPlan& plan_;
  Progress& progress_;
  StopCheck stop_;
  Ending without_result_;
  std::atomic<Activity> activity_{Activity::Reading};
  std::mutex mutex_;  // guards the members below
  std::condition_variable_any changed_;
  Ending ending_;
  double patience_ = kPatience;
  Clock::time_point earliest_;
  std::jthread thread_;
};

Run::Run(const RunPlan& plan)
    : plan_(plan),
      progress_(std::make_unique<Progress>(progress_options(plan), plan.stages)),
      watch_(std::make_unique<Watch>(plan, *progress_)),
      record_(plan.time_limit, plan.max_iterations, stop_on_signals(plan.common), watch_.get()),
      threads_(usable_threads(plan.common.threads)) {
  or_interrupted("reading " + input(), [&] {
    require_writable(plan.common, plan.outputs, plan.inputs, record_.start_stop());
  });
  set_output_stop(record_.stop());
  watch_->start(record_.stop(), [this](Directive why) {
    const std::string message =
        fmt::format("{} while {} {}", Stopped(why).what(), doing(watch_->activity()), input());
    return fail({kInvalid, std::string(status_name(stopped_status(why))), message,
                 message + "; nothing is written"});
  });
  record_.begin(Activity::Reading);
}

Run::~Run() = default;

std::vector<std::string> Run::report_paths() const {
  std::vector<std::string> paths;
  if (!plan_.common.report.empty()) paths.push_back(plan_.common.report);
  for (const OutputNames& names : plan_.outputs)
    for (const std::string& path : names.paths)
      if (names.may_be_report && extension(path) == ".json") paths.push_back(path);
  return paths;
}

int Run::conclude(const std::function<Made(Run&)>& make) {
  Made made;
  try {
    made = make(*this);
  } catch (...) {
    watch_->end();
    progress_.reset();
    return fail(failure_of(std::current_exception()));
  }
  watch_->allow({});
  return write(std::move(made));
}

int Run::write(Made made) {
  const double before = seconds();
  WrittenFiles written;
  const ExitCode code = made.code.value_or(exit_code(made.report.status));
  const auto& stages = plan_.stages;
  if (!made.files.empty() &&
      std::find(stages.begin(), stages.end(), Activity::Writing) != stages.end())
    record_.begin(Activity::Writing);
  if (const Directive why = record_.directive();
      why != Directive::Continue && !made.files.empty() && !is_quiet()) {
    std::vector<std::string> paths;
    for (const MadeFile& file : made.files) paths.push_back(file.path);
    const Json& faces = made.report.input.contains("faces") ? made.report.input["faces"] : Json();
    say("{}: {}; writing {}{}\n", plan_.speaker, Stopped(why).what(), fmt::join(paths, ", "),
        faces.is_number() ? fmt::format(" ({} faces)", faces.get<Index>()) : "");
  }
  // After a stop, files that hold the result are written first. Files that only show it may be left
  // out.
  if (record_.directive() != Directive::Continue)
    std::stable_partition(made.files.begin(), made.files.end(),
                          [&](const MadeFile& file) { return !is_drawing(plan_, file.path); });
  const auto last_data =
      std::find_if(made.files.rbegin(), made.files.rend(), [&](const auto& file) {
        return !is_drawing(plan_, file.path);
      }).base();
  for (auto file = made.files.begin(); file != made.files.end(); ++file) {
    if (file >= last_data)
      watch_->allow(
          [&, path = file->path](Directive why) {
            WrittenFiles all = written;
            all.write(path, [&] {
              throw Error(ErrorKind::Usage,
                          fmt::format("{} while drawing {}", Stopped(why).what(), path));
            });
            write_reports(made.report, all);
            return all.conclude(code, plan_.speaker);
          },
          kDrawingPatience, drawing_until());
    written.write(file->path, file->write);
    watch_->allow({});
    if (written.has(file->path))
      for (const std::string& path : file->beside) written.add(path);
  }
  watch_->end();
  made.report.seconds["write"] = seconds() - before;
  write_reports(made.report, written);
  progress_->finish();
  say_all(made, written);
  return written.conclude(code, plan_.speaker);
}

int Run::fail(const Failure& failure) const {
  say("{}: {}\n", plan_.speaker, failure.line);
  WrittenFiles written;
  write_reports({.status = failure.status,
                 .message = failure.message,
                 .input = {{"file", plan_.inputs.front()}}},
                written);
  written.conclude(failure.code, plan_.speaker);
  return failure.code;
}

void Run::write_reports(RunReport report, WrittenFiles& written) const {
  const std::vector<std::string> paths = report_paths();
  if (paths.empty()) return;
  report.command = plan_.command;
  Json by_stage{{"read", read_seconds_}};
  by_stage.update(report.seconds);
  by_stage["total"] = seconds();
  report.seconds = std::move(by_stage);
  const Json json = to_json(report, written.to_json());
  for (const std::string& path : paths) written.write(path, [&] { write_json(path, json); });
}

void Run::say_all(const Made& made, const WrittenFiles& written) const {
  if (!made.verdict.empty() && (!is_quiet() || made.is_verdict_news))
    plan_.common.report == kStandardOutput ? say_text(made.verdict) : print_text(made.verdict);
  for (const std::string& line : made.faults) say("{}\n", line);
  if (is_quiet()) return;
  for (const std::string& line : made.remarks) say("{}\n", line);
  if (!made.files.empty()) written.say_sizes();
  if (!made.summary) return;
  for (const std::string& line : made.summary(written)) say("{}\n", line);
}

int run_verb(const RunPlan& plan, const std::function<Made(Run&)>& make) {
  Run run(plan);
  return run.conclude(make);
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
