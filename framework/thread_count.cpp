#include "majorant/framework/thread_count.h"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>

#include "majorant/framework/error.h"
#include "majorant/framework/internal/parallel_errors.h"

namespace majorant {

ThreadCount::ThreadCount(int count)
    : threads_(omp_get_max_threads()), levels_(omp_get_max_active_levels()) {
  if (count < 0)
    throw InvalidArgument(fmt::format("ThreadCount: {} threads, at least 0 are needed", count));
  if (count == 0) return;
  omp_set_num_threads(count);
  // num_threads(4) of somebody else counts for nothing where no level may be active.
  omp_set_max_active_levels(count == 1 ? 0 : std::max(levels_, 1));
}

ThreadCount::~ThreadCount() {
  omp_set_num_threads(threads_);
  omp_set_max_active_levels(levels_);
}

int ThreadCount::current() { return omp_get_max_threads(); }

void ThreadCount::run_on_each(const std::function<void()>& work) {
  ParallelErrors errors;
#pragma omp parallel
  errors.guard(work);
  errors.rethrow();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
