#include "majorant/framework/internal/parallel_errors.h"

#include <gtest/gtest.h>

#include <atomic>
#include <new>

#include "majorant/framework/evaluator.h"

namespace majorant {
namespace {

TEST(ParallelErrors, LeaveTheRegion) {
  set_threads(4);
  EXPECT_THROW(run_on_threads([] { throw std::bad_alloc(); }), std::bad_alloc);
  std::atomic<int> calls = 0;
  run_on_threads([&] { ++calls; });
  EXPECT_EQ(calls, threads());
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
