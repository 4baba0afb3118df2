#include "majorant/framework/sigterm_gate.h"

#include <pthread.h>

namespace majorant {
void SigtermGate::enter() {
  Stage now = Stage::Closed;
  if (stage_.compare_exchange_strong(now, Stage::Requested)) now = Stage::Requested;
  for (; now == Stage::Requested; now = stage_) stage_.wait(Stage::Requested);
  if (now == Stage::Refused) throw Stopped(Directive::Interrupt);
}

void SigtermGate::hold() {
  if (mask_) return;
  sigset_t term;
  sigemptyset(&term);
  sigaddset(&term, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &term, &mask_.emplace());
}

void SigtermGate::close() {
  if (mask_) pthread_sigmask(SIG_SETMASK, &*mask_, nullptr);
  mask_.reset();
}

// Does nothing if a thread has entered.
void SigtermGate::move_to(Stage stage) {
  for (Stage from : {Stage::Closed, Stage::Requested})
    if (stage_.compare_exchange_strong(from, stage)) break;
  stage_.notify_all();
}

void SigtermGate::open() {
  hold();
  move_to(Stage::Open);
}

void SigtermGate::refuse() { move_to(Stage::Refused); }

void SigtermGate::poll() {
  const Stage now = stage_;
  if (now == Stage::Requested) open();
  if (now == Stage::Left) close();
}

StopCheck SigtermGate::polled(const StopCheck& stop) {
  return stop.asking([this, stop] {
    if (std::this_thread::get_id() == owner_) poll();
    return stop();
  });
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
