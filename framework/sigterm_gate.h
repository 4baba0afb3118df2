// Handles SIGTERM while METIS orders on another thread than its owner's, which receives the
// signals.
//
//   SigtermGate gate;                            // the owner's
//   const auto analyse = [&] { gate.enter(); };  // on the other thread, before the analysis;
//   gate.leave();                                // and after it
//   const StopCheck stop = gate.polled({});      // for the owner's work meanwhile
//
// METIS has a handler of SIGTERM in place while it orders (metis_scope.h), which is safe only on
// the thread of METIS. So that thread waits until the owner, at one of its polls, has blocked
// SIGTERM. The owner unblocks it when the analysis is over.
//
// Not for the thread that calls METIS itself: MetisScope handles that.
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

  // Waits until SIGTERM is blocked. Throws Stopped after refuse().
  void enter();
  void leave() { stage_ = Stage::Left; }

  // The owner calls one of both when it stops polling. open() blocks SIGTERM until close(), whether
  // or not a thread has entered; after refuse() no thread can enter.
  void open();
  void refuse();
  void close();

  // Returns a check that asks `stop` and, on the owner's thread, polls this gate, which must
  // outlive it.
  StopCheck polled(const StopCheck& stop);

 private:
  enum class Stage { Closed, Requested, Open, Left, Refused };
  void poll();
  void hold();
  void move_to(Stage stage);

  const std::thread::id owner_ = std::this_thread::get_id();
  std::atomic<Stage> stage_{Stage::Closed};
  std::optional<sigset_t> mask_;  // the owner's mask, while SIGTERM is blocked
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
