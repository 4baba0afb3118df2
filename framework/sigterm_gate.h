// SIGTERM, while METIS orders on another thread than that of its owner, to whom signals come.
//
//   SigtermGate gate;                            // the owner's
//   const auto analyse = [&] { gate.enter(); };  // of the other thread, around the analysis;
//   gate.leave();                                // likewise
//   const StopCheck stop = gate.polled({});      // for what the owner does meanwhile
//
// METIS has a handler of SIGTERM in place while it orders (metis_scope.h), which only the thread
// that runs it survives. So that thread waits until SIGTERM waits on the owner's, who is asked
// whenever he polls, and has it come again when the analysis is over.
//
// Not for the thread that calls METIS itself: MetisScope looks after that.
#pragma once

#include <atomic>
#include <csignal>
#include <optional>
#include <thread>

#include "majorant/framework/stop_check.h"

namespace majorant {

class SigtermGate {
 public:
  SigtermGate() = default;
  ~SigtermGate() { close(); }
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

  // A check that asks `stop` and, on the owner's thread, polls this gate, which outlives it.
  StopCheck polled(const StopCheck& stop);

 private:
  enum class Stage { Closed, Requested, Open, Left, Refused };
  void poll();
  void hold();
  void move_to(Stage stage);

  const std::thread::id owner_ = std::this_thread::get_id();
  std::atomic<Stage> stage_{Stage::Closed};
  std::optional<sigset_t> mask_;  // the owner's, while SIGTERM waits
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
