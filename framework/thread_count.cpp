#include <fmt/format.h>

#include "majorant/framework/available_resources.h"
#include "majorant/framework/error.h"
#include "majorant/framework/parallel.h"

namespace majorant {
namespace {

thread_local int threads_of_this_thread = 0;  // 0: as many as there are processors

}  // namespace

ThreadCount::ThreadCount(int count) : before_(threads_of_this_thread) {
  if (count < 0)
    throw InvalidArgument(fmt::format("ThreadCount: {} threads, at least 0 are needed", count));
  if (count > 0) threads_of_this_thread = count;
}

ThreadCount::~ThreadCount() { threads_of_this_thread = before_; }

int ThreadCount::current() {
  static const int processors = available_processors();
  if (is_parallel_task()) return 1;
  return threads_of_this_thread > 0 ? threads_of_this_thread : processors;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
