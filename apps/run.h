// One run of a verb: threads, progress, signals, limits, memory, the files that are read and
// written, the report, the lines on stderr and the exit code. A verb says what it reads and writes
// (RunPlan) and makes a result (Made); the rest is here.
//
//   CommonOptions common;
//   const RunPlan plan{.command = "info", .common = common, .inputs = {"bunny.obj"}};
//   const int code = run_verb(plan, [&](Run& run) {
//     const PolygonMesh mesh = run.read("bunny.obj", [&] { return read_mesh("bunny.obj"); });
//     Made made{.report = {.status = "done"}};
//     made.verdict = std::to_string(mesh.polygons.size()) + " polygons\n";
//     return made;
//   });
//
// The first SIGINT, SIGTERM or SIGHUP and the time limit stop a run. It ends within kPatience, but
// for writing what holds a result: where the work has not noticed by then, the process ends here.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/command.h"
#include "apps/failure.h"
#include "apps/or_interrupted.h"
#include "apps/outputs.h"
#include "apps/progress.h"
#include "apps/within_memory.h"
#include "majorant/apps/jobs/report.h"
#include "majorant/framework/parallel.h"
#include "majorant/framework/run_record.h"
#include "majorant/framework/stopwatch.h"

namespace majorant::app {

struct RunPlan {
  std::string command;  // as reports have it: "mesh check"
  const CommonOptions& common;
  std::vector<std::string> inputs;        // files that are read, the run's input first; "": none
  std::vector<OutputNames> outputs = {};  // without the report of `common`
  std::vector<Activity> stages = {};      // that the progress shows; none: it shows nothing
  double time_limit = std::numeric_limits<double>::infinity();  // seconds
  int max_iterations = 0;
  // The activities in which there is, or may be, a result that is written after a stop.
  std::vector<Activity> with_result = {Activity::Writing};
  // A .png holds the result; else pictures and pages show it, and are left out where a stop comes
  // while they are drawn.
  bool images_are_results = false;
};

// A file to be written. Files that fail leave the others.
struct MadeFile {
  std::string path;
  std::function<void()> write;
  std::vector<std::string> beside = {};  // files that write() writes, too
};

// The result of a verb.
struct Made {
  RunReport report;                  // its status decides the exit code; `command` is the plan's
  std::vector<MadeFile> files = {};  // without reports
  std::string verdict = {};          // data: on stdout, or on stderr where the report has stdout
  bool is_verdict_news = false;      // it is printed by quiet runs, too
  std::vector<std::string> faults = {};   // lines on stderr, by quiet runs, too
  std::vector<std::string> remarks = {};  // lines before the one that names the files
  // The lines after that one: what sums up.
  std::function<std::vector<std::string>(const WrittenFiles&)> summary = {};
  std::optional<ExitCode> code = {};  // where the status does not say it
};

class Run {
 public:
  // Seconds that a run may go on after a stop, unless it writes.
  static constexpr double kPatience = 2;

  // Checks outputs against inputs, starts the clock, the threads and the progress, and takes over
  // signals. Throws Error(Usage) as require_writable().
  explicit Run(const RunPlan& plan);
  ~Run();
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  RunRecord& record() { return record_; }
  const StopCheck& stop() const { return record_.stop(); }
  const StopCheck& start_stop() const { return record_.start_stop(); }
  bool is_quiet() const { return plan_.common.quiet; }
  // Returns whether a report is written, by a flag or as an output.
  bool has_report() const { return !report_paths().empty(); }
  // "FILE: ..." for the lines of quiet runs, too.
  const std::string& input() const { return plan_.inputs.front(); }
  double seconds() const { return record_.seconds(); }

  // Returns read() of that file, of which no more memory is taken than is free. Its time is the
  // report's seconds.read, unless the verb says another one. Throws Interrupted
  // when it is stopped, Error(Unsupported) where memory is short.
  template <class Read>
  auto read(const std::string& path, const Read& read) const {
    const AddedSeconds time(read_seconds_);
    return or_interrupted("reading " + path, [&] { return within_memory(path, read); });
  }
  // Returns work(). Throws Interrupted when it is stopped; doing: "unwrapping IN".
  template <class Work>
  auto make(const std::string& doing, const Work& work) const {
    return or_interrupted(doing, work);
  }

  // Makes the result, writes its files and the reports, says the lines; returns the exit code.
  int conclude(const std::function<Made(Run&)>& make);

 private:
  class Watch;  // ends the process where nothing else does

  std::vector<std::string> report_paths() const;
  int write(Made made);
  int fail(const Failure& failure) const;
  void say_all(const Made& made, const WrittenFiles& written) const;
  void write_reports(RunReport report, WrittenFiles& written) const;

  const RunPlan& plan_;
  std::unique_ptr<Progress> progress_;
  std::unique_ptr<Watch> watch_;
  RunRecord record_;
  ThreadCount threads_;
  mutable double read_seconds_ = 0;
};

// A Run, concluded.
int run_verb(const RunPlan& plan, const std::function<Made(Run&)>& make);

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
