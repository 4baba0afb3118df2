// Shows on stderr what a run is doing: one live line on a terminal, plain lines otherwise.
//
//   Progress progress(common, {Activity::Reading, Activity::Proving});   // what is to come
//   RunRecord record(60, 1000, interruption_flag(), &progress);
//   record.begin(Activity::Reading);
//   ...
//   progress.finish();   // before the line that sums up
//
// A terminal shows which of the stages it is, for how long, what of it is under way and the last
// step: "[##..] 2 of 4 solving 1.2 s  chart 3 of 17  iteration 7 ..."; twice a second it
// is shown anew, by a thread of its own, so that it never stands still. Elsewhere every activity
// leaves a line with its seconds, steps leave one for the first of a degree and every tenth, or for
// each when verbose, and so does what is announced of cuts. Quiet runs say nothing.
//
// Lines of activities are held back until there was a step or the solve is over: what is refused
// before has said one line, that of the refusal. Ended by an exception, those held back are lost.
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
  Directive after_step(const TraceEntry& row, const Vec&) override;  // goes on
  // The last activity is over. Nothing is shown any more.
  void finish();

 private:
  class Display;
  std::unique_ptr<Display> display_;  // none when quiet
};

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
