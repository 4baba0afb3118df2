#include "majorant/framework/parallel.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <new>
#include <numeric>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "majorant/framework/error.h"
#include "majorant/framework/side_task.h"

namespace majorant {
namespace {

std::vector<Index> squares(Index count, Index piece) {
  std::vector<Index> out(to_size(count), -1);
  parallel_for(count, piece, [&](Index i) { out[i] = i * i; });
  return out;
}

TEST(Parallel, EveryTaskRunsOnce) {
  for (int threads = 1; threads <= 64; threads += threads < 4 ? 1 : 12) {
    const ThreadCount some(threads);
    for (const Index count : {0, 1, 2, 3, 63, 64, 1000}) {
      std::vector<std::atomic<int>> runs(to_size(count));
      parallel_tasks(count, [&](Index task, int thread) {
        EXPECT_TRUE(thread >= 0 && thread < threads) << thread;
        ++runs[task];
      });
      for (const auto& r : runs) ASSERT_EQ(r, 1);
      for (const Index piece : {1, 7, 1000, 5000}) {
        const std::vector<Index> out = squares(count, piece);
        for (Index i = 0; i < count; ++i) ASSERT_EQ(out[i], i * i);
      }
    }
  }
}

// All tasks wait for each other, so that there must be one thread per task.
TEST(Parallel, ThreadsWorkAtTheSameTimeWithNumbersOfTheirOwn) {
  constexpr int kThreads = 4;
  const ThreadCount four(kThreads);
  for (int round = 0; round < 20; ++round) {
    std::mutex mutex;
    std::condition_variable all_here;
    int here = 0;
    std::array<int, kThreads> used{};
    parallel_tasks(kThreads, [&](Index, int thread) {
      std::unique_lock lock(mutex);
      ++used[static_cast<std::size_t>(thread)];
      if (++here == kThreads) all_here.notify_all();
      EXPECT_TRUE(
          all_here.wait_for(lock, std::chrono::seconds(60), [&] { return here == kThreads; }));
    });
    for (const int uses : used) EXPECT_EQ(uses, 1);
  }
}

TEST(Parallel, TheLowestFailureIsThrown) {
  for (const int threads : {1, 2, 5}) {
    const ThreadCount some(threads);
    for (int round = 0; round < 50; ++round) {
      std::atomic<int> begun = 0;
      try {
        parallel_tasks(1000, [&](Index task, int) {
          ++begun;
          if (task >= 20 && task % 10 == 0) throw std::runtime_error(std::to_string(task));
        });
        ADD_FAILURE() << "nothing was thrown";
      } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "20");
      }
      EXPECT_LT(begun, 1000) << "the others are skipped";
      EXPECT_EQ(squares(100, 1)[99], 99 * 99) << "and the pool goes on";
    }
  }
  EXPECT_THROW(parallel_for(3, 1, [](Index) { throw std::bad_alloc(); }), std::bad_alloc);
}

TEST(Parallel, LoopsInsideATaskRunOnItsThread) {
  const ThreadCount four(4);
  parallel_tasks(16, [&](Index, int) {
    EXPECT_TRUE(is_parallel_task());
    EXPECT_EQ(ThreadCount::current(), 1);
    const auto self = std::this_thread::get_id();
    parallel_tasks(100, [&](Index, int thread) {
      EXPECT_EQ(std::this_thread::get_id(), self);
      EXPECT_EQ(thread, 0);
    });
    EXPECT_TRUE(is_parallel_task());
  });
  EXPECT_FALSE(is_parallel_task());
  EXPECT_EQ(ThreadCount::current(), 4);
}

// Busy threads do not join: four callers with two threads each use four threads.
TEST(Parallel, CallersShareThePool) {
  constexpr int kCallers = 4, kThreads = 2;
  std::atomic<int> callers = 0, at_work = 0, most = 0;
  std::vector<std::thread> all;
  for (int k = 0; k < kCallers; ++k)
    all.emplace_back([&] {
      const ThreadCount two(kThreads);
      for (++callers; callers < kCallers;) std::this_thread::yield();
      for (int round = 0; round < 50; ++round) {
        std::atomic<long> sum = 0;
        parallel_tasks(64, [&](Index task, int) {
          const int now = ++at_work;
          for (int seen = most; seen < now && !most.compare_exchange_weak(seen, now);) continue;
          sum += task;
          --at_work;
        });
        EXPECT_EQ(sum, 64 * 63 / 2);
      }
    });
  for (std::thread& thread : all) thread.join();
  EXPECT_LE(most, kCallers + kThreads - 1);
}

double cpu_seconds() {
  timespec now;
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

TEST(Parallel, ThreadsSleepWhereThereIsNothingToDo) {
  const ThreadCount eight(8);
  squares(1000, 1);
  const double before = cpu_seconds();
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_LT(cpu_seconds() - before, 0.1);
}

// Runs work in a child process and returns its exit code; the child skips gtest's final steps.
int exit_code_of_child(const std::function<int()>& work) {
  const pid_t child = ::fork();
  if (child == 0) {
    ::alarm(60);
    ::_exit(work());
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 100 + WTERMSIG(status);
}

TEST(Parallel, AForkedChildHasAPoolOfItsOwn) {
  const ThreadCount three(3);
  const std::vector<Index> expected = squares(1000, 10);
  const auto same = [&] { return squares(1000, 10) == expected ? 0 : 1; };
  for (int k = 0; k < 3; ++k) EXPECT_EQ(exit_code_of_child(same), 0);
  EXPECT_EQ(exit_code_of_child([&] { return same() + exit_code_of_child(same); }), 0);
  EXPECT_EQ(same(), 0);
}

TEST(Parallel, AChildForkedDuringWorkHasAPoolOfItsOwn) {
  std::atomic<bool> done = false;
  std::thread other([&] {
    const ThreadCount four(4);
    while (!done) squares(1000, 10);
  });
  const ThreadCount three(3);
  for (int k = 0; k < 20; ++k)
    EXPECT_EQ(exit_code_of_child([] { return squares(100, 1)[7] == 49 ? 0 : 1; }), 0);
  done = true;
  other.join();
}

TEST(ThreadCount, LastsAsLongAsItsBlock) {
  const int before = ThreadCount::current();
  {
    const ThreadCount outer(3);
    EXPECT_EQ(ThreadCount::current(), 3);
    const ThreadCount one(1);
    EXPECT_EQ(ThreadCount::current(), 1);
    const ThreadCount same(0);
    EXPECT_EQ(ThreadCount::current(), 1);
    std::thread([&] { EXPECT_EQ(ThreadCount::current(), before); }).join();
  }
  EXPECT_EQ(ThreadCount::current(), before);
  EXPECT_THROW(ThreadCount(-1), InvalidArgument);
}

// Returns true if the flag is set within a minute.
bool is_set(const std::atomic<bool>& flag) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!flag && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(std::chrono::microseconds(100));
  return flag;
}

// A task that runs until it is told to end.
class WaitingTask {
 public:
  bool begins() const { return is_set(begun_); }
  bool is_of_another_process() { return !task_.finish(); }
  bool end() {
    go_on_ = true;
    return task_.finish();
  }

 private:
  std::atomic<bool> begun_ = false, go_on_ = false;
  SideTask task_{[this] {
    begun_ = true;
    is_set(go_on_);
  }};
};

TEST(SideTask, RunsBesideItsOwner) {
  for (const int threads : {2, 3, 8}) {
    const ThreadCount some(threads);
    for (int round = 0; round < 50; ++round) {
      std::atomic<bool> begun = false, go_on = false;
      int x = 0;
      SideTask side([&] {
        begun = true;
        EXPECT_TRUE(is_parallel_task());
        EXPECT_EQ(ThreadCount::current(), 1);
        if (is_set(go_on)) x = 7;
      });
      ASSERT_TRUE(is_set(begun));
      go_on = true;
      EXPECT_TRUE(side.finish());
      EXPECT_EQ(x, 7);
    }
  }
}

TEST(SideTask, DoesNotRunWithOneThread) {
  const auto never = [] { ADD_FAILURE(); };
  {
    const ThreadCount one(1);
    EXPECT_FALSE(SideTask(never).finish());
    const SideTask dropped(never);
  }
  const ThreadCount four(4);
  parallel_tasks(8, [&](Index, int) { EXPECT_FALSE(SideTask(never).finish()); });
}

TEST(SideTask, TakesAThreadFromTheLoopsOfItsOwner) {
  const ThreadCount two(2);
  WaitingTask side;
  ASSERT_TRUE(side.begins());
  for (int round = 0; round < 20; ++round)
    parallel_tasks(100, [&](Index, int thread) { EXPECT_EQ(thread, 0); });
  EXPECT_TRUE(side.end());
}

// The second and the third task each need a thread. With two threads, the last task waits for that
// of the first, or its owner runs it.
TEST(SideTask, SeveralShareThePool) {
  const ThreadCount three(3);
  for (int round = 0; round < 200; ++round) {
    std::atomic<int> done = 0;
    SideTask a([&] { ++done; }), b([&] { ++done; }), c([&] { ++done; });
    int left = 0;
    for (SideTask* side : {&a, &b, &c}) left += side->finish() ? 0 : 1;
    EXPECT_EQ(done + left, 3);
  }
}

TEST(SideTask, ItsExceptionIsThrownByFinish) {
  const ThreadCount two(2);
  std::atomic<bool> begun = false;
  SideTask side([&] {
    begun = true;
    throw std::runtime_error("no");
  });
  ASSERT_TRUE(is_set(begun));
  EXPECT_THROW(side.finish(), std::runtime_error);
  begun = false;
  {
    const SideTask unasked([&] {
      begun = true;
      throw std::runtime_error("nobody hears it");
    });
    ASSERT_TRUE(is_set(begun));
  }
  int sum = 0;
  SideTask next([&] { sum = 1; });
  if (!next.finish()) sum = 1;
  EXPECT_EQ(sum, 1) << "and the pool goes on";
}

// The task is waited for at the end of the block, whose data it uses.
TEST(SideTask, IsWaitedFor) {
  const ThreadCount two(2);
  std::atomic<bool> begun = false, ended = false;
  {
    const SideTask side([&] {
      begun = true;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      ended = true;
    });
    ASSERT_TRUE(is_set(begun));
  }
  EXPECT_TRUE(ended);
}

TEST(SideTask, AForkedChildHasNoneOfItsParents) {
  const ThreadCount two(2);
  WaitingTask side;
  ASSERT_TRUE(side.begins());
  const auto in_child = [&] {
    int own = 0;
    SideTask other([&] { own = 1; });
    if (!other.finish()) own = 1;
    return side.is_of_another_process() && own == 1 ? 0 : 1;
  };
  EXPECT_EQ(exit_code_of_child(in_child), 0);
  EXPECT_TRUE(side.end());
}

TEST(Both, RunsBothAndThrowsTheFirstException) {
  for (const int threads : {1, 2, 5}) {
    const ThreadCount some(threads);
    for (int round = 0; round < 50; ++round) {
      int a = 0, b = 0;
      both([&] { a = 1; }, [&] { b = 2; });
      EXPECT_EQ(a + b, 3);
      const auto fail = [](int number) { throw number; };
      const auto nothing = [] {};
      EXPECT_THROW(both(nothing, [&] { fail(2); }), int);
      try {
        both([&] { fail(1); }, [&] { fail(2); });
        ADD_FAILURE() << "nothing was thrown";
      } catch (const int number) {
        EXPECT_EQ(number, 1);
      }
    }
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
