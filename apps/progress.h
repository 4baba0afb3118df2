// Shows the progress of a run on stderr: one live line on a terminal, plain lines otherwise.
//
//   Progress progress(common, {Activity::Reading, Activity::Proving});   // what is to come
//   RunRecord record(60, 1000, interruption_flag(), &progress);
//   record.begin(Activity::Reading);
//   ...
//   progress.finish();   // before the line that sums up
//
// The live line shows the number of the stage, its share or the bytes read and written, the time
// since the start of the run, the remaining time of the stage, the current part and the last step:
//
//     [###...] 3 of 6 solving 41 %  1:12, about 0:40 left  pass 2  chart 3 of 17  iteration 7 ...
//
// A thread of its own updates the line twice a second. Stages, time and (within a pass) shares
// never go backwards: an activity that returns in another pass is shown at the stage of the run.
// The remaining time is the time of the stage times (1 - share) / share, from two seconds and 5 %
// on.
//
// Without a terminal, every activity prints a line with its seconds. Steps print the first one of a
// degree and every tenth, or all if verbose; cuts print their announcements. After five seconds of
// silence, and at the first signal, the line of a terminal is printed without its bar. Quiet runs
// print nothing.
//
// Lines of activities are held back until the first step, the end of the solve, or five seconds. So
// a run that is refused prints one line, the refusal. An exception discards the lines held back.
#pragma once

#include <chrono>
#include <memory>
#include <string_view>
#include <vector>

#include "apps/command.h"
#include "majorant/framework/run_record.h"

namespace majorant::app {

inline double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

class Progress final : public RunObserver {
 public:
  // stages: the expected activities, in order.
  Progress(const CommonOptions& options, std::vector<Activity> stages);
  ~Progress() override;  // clears the live line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void begin(Activity activity) override;
  void announce(std::string_view part) override;
  void advance(double share) override;
  void begin_pass(int pass, int most) override;
  Directive after_step(const TraceEntry& row, const Vec&) override;  // always continues
  void after_part(std::string_view part, const std::vector<TraceEntry>& rows) override;
  // Ends the last activity and the display.
  void finish();

 private:
  class Display;
  std::unique_ptr<Display> display_;  // null if quiet
};

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
