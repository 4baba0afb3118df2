#include "majorant/framework/internal/parallel_errors.h"

#include <gtest/gtest.h>

#include <atomic>
#include <new>

#include "majorant/framework/thread_count.h"

namespace majorant {
namespace {

TEST(ParallelErrors, LeaveTheRegion) {
  const ThreadCount threads(4);
  EXPECT_THROW(ThreadCount::run_on_each([] { throw std::bad_alloc(); }), std::bad_alloc);
  std::atomic<int> calls = 0;
  ThreadCount::run_on_each([&] { ++calls; });
  EXPECT_EQ(calls, ThreadCount::current());
}

TEST(ParallelErrors, TheRestIsSkipped) {
  ParallelErrors errors;
  int done = 0;
  for (int i = 0; i < 10; ++i)
    errors.guard([&] {
      ++done;
      if (i == 3) throw std::bad_alloc();
    });
  EXPECT_EQ(done, 4);
  EXPECT_THROW(errors.rethrow(), std::bad_alloc);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
