// What the direct solver finds out about a pattern before there are numbers, made sooner than the
// solver, and perhaps on another thread.
//
//   const SparsePattern& pattern = problem.pattern();      // outlives the analysis, where it is
//   PatternAnalysis analysis(pattern, Ordering::Automatic);
//   const OfferedAnalysis offer(&analysis);                // until the end of this block
//   const auto solver = make_direct_solver();
//   solver->analyze(pattern);                              // takes it
//
// Who makes a solver for a pattern need not know of an offer: whatever is between, a factory of a
// caller say, passes it on. Not for a second solver: the first one that fits takes it along.
#pragma once

#include <atomic>
#include <csignal>
#include <memory>
#include <optional>

#include "majorant/framework/linear_solver.h"
#include "majorant/framework/stop_check.h"

namespace majorant {

class PatternAnalysis {
 public:
  // Orders, and finds the structure of the factor. Throws std::bad_alloc.
  PatternAnalysis(const SparsePattern& pattern, Ordering asked);
  ~PatternAnalysis();
  PatternAnalysis(const PatternAnalysis&) = delete;
  PatternAnalysis& operator=(const PatternAnalysis&) = delete;

  struct Parts;  // of the direct solver
  // What has been found out, once, where this is the pattern, the very object; else null.
  std::shared_ptr<Parts> take(const SparsePattern& pattern, Ordering asked);

 private:
  const SparsePattern* pattern_;
  Ordering asked_;
  std::shared_ptr<Parts> parts_;
};

// An offer to the direct solvers that analyse on this thread. The last one holds.
class OfferedAnalysis {
 public:
  explicit OfferedAnalysis(PatternAnalysis* analysis);  // null: nothing
  ~OfferedAnalysis();
  OfferedAnalysis(const OfferedAnalysis&) = delete;
  OfferedAnalysis& operator=(const OfferedAnalysis&) = delete;

  static PatternAnalysis* current();

 private:
  PatternAnalysis* before_;
};

// For an analysis on another thread than that of its owner, to whom signals come: METIS has a
// handler of SIGTERM in place while it orders, which only the thread that runs it survives. So the
// other one waits with that until SIGTERM waits on the owner's thread, who is asked whenever he
// polls, and has it come again when the analysis is over.
//
//   SigtermGate gate;                            // the owner's
//   const auto analyse = [&] { gate.enter(); };  // of the other thread, around the analysis;
//   gate.leave();                                // likewise
//   const StopCheck stop = SigtermGate::polled({});   // for what the owner does meanwhile
class SigtermGate {
 public:
  SigtermGate();
  ~SigtermGate();
  SigtermGate(const SigtermGate&) = delete;
  SigtermGate& operator=(const SigtermGate&) = delete;

  // Throws Stopped where it was refused.
  void enter();
  void leave() { stage_ = Stage::Left; }

  // The owner polls no more. SIGTERM waits until close(), whether or not somebody has entered; or
  // nobody enters from now on.
  void open();
  void refuse();
  void close();

  // A check that asks `stop`, and polls the gate of the thread that asks, if it has one.
  static StopCheck polled(const StopCheck& stop);

 private:
  enum class Stage { Closed, Asked, Open, Left, Refused };
  void poll();
  void hold();
  void move_to(Stage stage);

  SigtermGate* before_;  // of this thread
  std::atomic<Stage> stage_{Stage::Closed};
  std::optional<sigset_t> mask_;  // the owner's, while SIGTERM waits
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
