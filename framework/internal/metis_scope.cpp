#include "majorant/framework/internal/metis_scope.h"

#include <pthread.h>

#include <cstdlib>

namespace majorant {
namespace {

std::mutex metis;

}  // namespace

MetisScope::MetisScope() : alone_(metis) {
  sigaction(SIGTERM, nullptr, &term_);
  sigaction(SIGABRT, nullptr, &abort_);
  sigset_t term;
  sigemptyset(&term);
  sigaddset(&term, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &term, &mask_);
  program_random_ = ::initstate(1, random_.data(), random_.size());
}

MetisScope::~MetisScope() {
  ::setstate(program_random_);
  sigaction(SIGTERM, &term_, nullptr);
  sigaction(SIGABRT, &abort_, nullptr);
  pthread_sigmask(SIG_SETMASK, &mask_, nullptr);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
