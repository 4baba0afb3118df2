// One run of a verb. It handles threads, progress, signals, limits, memory, files that are read and
// written, the report, the lines on stderr and the exit code. A verb supplies a RunPlan and makes a
// result (Made).
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
// The first SIGINT, SIGTERM or SIGHUP, or the time limit, stops a run. It ends within kPatience,
// except while a result is written: if the work has not stopped by then, the process ends.
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
  std::string command;  // as in reports: "mesh check"
  const CommonOptions& common;
  std::vector<std::string> inputs;  // files to read, the run's input first; empty names are skipped
  std::vector<OutputNames> outputs = {};  // without the report of `common`
  std::vector<Activity> stages = {};      // for the progress; none: no progress is shown
  double time_limit = std::numeric_limits<double>::infinity();  // seconds
  int max_iterations = 0;
  // The activities that may leave a result to be written after a stop.
  std::vector<Activity> with_result = {Activity::Writing};
  // True if a .png holds the result. Otherwise pictures and pages only show it, and a stop may
  // leave them out.
  bool images_are_results = false;
  std::string speaker = "majorant";  // opens the lines about stops and failures
};

// A file to write. A failure does not affect other files.
struct MadeFile {
  std::string path;
  std::function<void()> write;
  std::vector<std::string> beside = {};  // further files that write() writes
};

// The result of a verb.
struct Made {
  RunReport report;  // its status decides the exit code; its command is that of the plan
  std::vector<MadeFile> files = {};  // without reports
  std::string verdict = {};          // printed on stdout, or on stderr if the report uses stdout
  bool is_verdict_news = false;      // whether quiet runs print it, too
  std::vector<std::string> faults = {};   // lines on stderr, printed by quiet runs, too
  std::vector<std::string> remarks = {};  // lines before the list of files
  // Returns the lines after the list of files, which sum up the run.
  std::function<std::vector<std::string>(const WrittenFiles&)> summary = {};
  std::optional<ExitCode> code = {};  // overrides the exit code of the status
};

class Run {
 public:
  // Seconds that a stopped run may take, unless it writes a result.
  static constexpr double kPatience = 2;

  // Checks outputs against inputs, starts the clock, the threads and the progress, and handles
  // signals. Throws the Error(Usage) of require_writable().
  explicit Run(const RunPlan& plan);
  ~Run();
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  RunRecord& record() { return record_; }
  const StopCheck& stop() const { return record_.stop(); }
  const StopCheck& start_stop() const { return record_.start_stop(); }
  bool is_quiet() const { return plan_.common.quiet; }
  // Returns whether a report is written, by --report or as an output.
  bool has_report() const { return !report_paths().empty(); }
  // Returns the input, for lines "FILE: ..." of quiet runs, too.
  const std::string& input() const { return plan_.inputs.front(); }
  double seconds() const { return record_.seconds(); }

  // Returns read() of the file, with at most the free memory. Its duration becomes the report's
  // seconds.read unless the verb sets that. Throws Interrupted if it is stopped, Error(Unsupported)
  // if memory is short.
  template <class Read>
  auto read(const std::string& path, const Read& read) const {
    const AddedSeconds time(read_seconds_);
    return or_interrupted("reading " + path, [&] { return within_memory(path, read); });
  }
  // Returns work(). Throws Interrupted if it is stopped; doing: "unwrapping IN".
  template <class Work>
  auto make(const std::string& doing, const Work& work) const {
    return or_interrupted(doing, work);
  }

  // Makes the result, writes its files and the reports, prints the lines; returns the exit code.
  int conclude(const std::function<Made(Run&)>& make);

 private:
  class Watch;  // ends the process if the work does not stop

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

// Makes a Run and concludes it.
int run_verb(const RunPlan& plan, const std::function<Made(Run&)>& make);

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
