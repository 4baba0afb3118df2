#include "majorant/framework/internal/metis_scope.h"

#include <gtest/gtest.h>
#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <new>
#include <thread>
#include <vector>

#include "majorant/framework/linear_solver.h"
#include "majorant/framework/sigterm_gate.h"

namespace majorant {
namespace {

std::atomic<int> noticed{0};

// Returns the path of `count` nodes, large enough to be ordered by METIS.
SparsePattern path_pattern(Index count) {
  SparsePattern p;
  p.size = count;
  p.column_starts = {0};
  for (Index c = 0; c < count; ++c) {
    p.rows.push_back(c);
    if (c + 1 < count) p.rows.push_back(c + 1);
    p.column_starts.push_back(static_cast<Index>(p.rows.size()));
    p.block_of.push_back(c);
  }
  return p;
}

TEST(ForeignCode, HandlersSurviveMetis) {
  struct sigaction mine {};
  mine.sa_handler = [](int) { ++noticed; };
  sigaddset(&mine.sa_mask, SIGHUP);
  ASSERT_EQ(sigaction(SIGTERM, &mine, nullptr), 0);
  const SparsePattern pattern = path_pattern(2000);
  make_direct_solver({.ordering = Ordering::Metis})->analyze(pattern);
  struct sigaction after {};
  sigaction(SIGTERM, nullptr, &after);
  EXPECT_EQ(after.sa_handler, mine.sa_handler);
  EXPECT_EQ(after.sa_flags & int(SA_RESETHAND), 0);
  EXPECT_EQ(sigismember(&after.sa_mask, SIGHUP), 1);
  raise(SIGTERM);
  raise(SIGTERM);  // the first signal would have reset a handler left by METIS
  EXPECT_EQ(noticed, 2);
}

TEST(ForeignCode, RandomNumbersAreTheProgramsOwn) {
  std::srand(7);
  const int first = std::rand(), second = std::rand();
  std::srand(7);
  EXPECT_EQ(std::rand(), first);
  const SparsePattern pattern = path_pattern(2000);
  make_direct_solver({.ordering = Ordering::Metis})->analyze(pattern);
  EXPECT_EQ(std::rand(), second);
}

TEST(ForeignCode, SignalsWaitForTheEndOfTheCall) {
  struct sigaction mine {};
  mine.sa_handler = [](int) { ++noticed; };
  ASSERT_EQ(sigaction(SIGTERM, &mine, nullptr), 0);
  noticed = 0;
  {
    const MetisScope scope;
    std::signal(SIGTERM, SIG_DFL);  // as METIS does
    raise(SIGTERM);
    EXPECT_EQ(noticed, 0);
  }
  EXPECT_EQ(noticed, 1);
}

// While METIS runs on another thread, SIGTERM waits for its end.
TEST(ForeignCode, SignalsWaitForTheEndOfAnotherThreadsCall) {
  struct sigaction mine {};
  mine.sa_handler = [](int) { ++noticed; };
  ASSERT_EQ(sigaction(SIGTERM, &mine, nullptr), 0);
  noticed = 0;
  SigtermGate gate;
  const StopCheck stop = gate.polled({});
  stop.poll();
  raise(SIGTERM);
  EXPECT_EQ(noticed, 1) << "nobody has asked";
  std::atomic<bool> entered = false, leave = false, left = false;
  std::thread other([&] {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, nullptr);  // like the threads of the pool
    gate.enter();
    entered = true;
    while (!leave) std::this_thread::yield();
    gate.leave();
    left = true;
  });
  while (!entered) stop.poll();
  raise(SIGTERM);
  stop.poll();
  EXPECT_EQ(noticed, 1) << "it waits";
  leave = true;
  while (!left) std::this_thread::yield();
  stop.poll();
  EXPECT_EQ(noticed, 2);
  other.join();
}

TEST(ForeignCode, ARefusingGateLetsNoThreadEnter) {
  SigtermGate gate;
  std::atomic<bool> refused = false;
  std::thread other([&] {
    try {
      gate.enter();
    } catch (const Stopped&) {
      refused = true;
    }
  });
  gate.refuse();
  other.join();
  EXPECT_TRUE(refused);
}

// Otherwise the second thread would restore METIS's handlers as the program's.
TEST(ForeignCode, OneThreadAtATimeIsInMetis) {
  struct sigaction mine {};
  mine.sa_handler = [](int) { ++noticed; };
  ASSERT_EQ(sigaction(SIGTERM, &mine, nullptr), 0);
  std::atomic<bool> second_is_in{false}, second_may_leave{false};
  std::thread second;
  {
    const MetisScope scope;
    std::signal(SIGTERM, SIG_DFL);  // as METIS does
    second = std::thread([&] {
      const MetisScope waiting;
      second_is_in = true;
      while (!second_may_leave) std::this_thread::yield();
    });
    std::this_thread::sleep_for(
        std::chrono::milliseconds(20));  // the other thread must not enter meanwhile
    EXPECT_FALSE(second_is_in);
  }
  second_may_leave = true;
  second.join();
  struct sigaction after {};
  sigaction(SIGTERM, nullptr, &after);
  EXPECT_EQ(after.sa_handler, mine.sa_handler);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
