// Shows on stderr what a run is doing: one live line on a terminal, plain lines otherwise.
//
//   Progress progress(common, {Activity::Reading, Activity::Proving});   // what is to come
//   RunRecord record(60, 1000, interruption_flag(), &progress);
//   record.begin(Activity::Reading);
//   ...
//   progress.finish();   // before the line that sums up
//
// A terminal shows which of the stages it is, the share of it that is done where that is known, or
// the bytes read and written, the time since the run began, what is left of the stage, what of it
// is under way and the last step:
//
//     [###...] 3 of 6 solving 41 %  1:12, about 0:40 left  pass 2  chart 3 of 17  iteration 7 ...
//
// Twice a second it is shown anew, by a thread of its own, so that it never stands still. Neither
// stages nor time nor, within a pass, shares go backwards: an activity that comes once more in
// another pass is shown at the stage where the run was. What is left is the time that the stage has
// taken, times (1 - share) / share, once that was two seconds and the share is 5 %.
//
// Elsewhere every activity leaves a line with its seconds, steps leave one for the first of a
// degree and every tenth, or for each when verbose, and so does what is announced of cuts. Where
// for five seconds nothing was said, the line of a terminal is, without its bar; the first signal,
// which stops the run, has it said at once. Quiet runs say nothing.
//
// Lines of activities are held back until there was a step, the solve is over or five seconds were:
// what is refused before has said one line, that of the refusal. Ended by an exception, those held
// back are lost.
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
  // stages: the activities that are to come, in their order.
  Progress(const CommonOptions& options, std::vector<Activity> stages);
  ~Progress() override;  // takes the live line away
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void begin(Activity activity) override;
  void announce(std::string_view part) override;
  void advance(double share) override;
  void begin_pass(int pass, int most) override;
  Directive after_step(const TraceEntry& row, const Vec&) override;  // goes on
  void after_part(std::string_view part, const std::vector<TraceEntry>& rows) override;
  // The last activity is over. Nothing is shown any more.
  void finish();

 private:
  class Display;
  std::unique_ptr<Display> display_;  // none when quiet
};

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
