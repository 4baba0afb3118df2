#include "majorant/framework/processors.h"

#include <gtest/gtest.h>
#include <sched.h>

#include <cstdlib>

#include "framework/made_up_machine.h"

namespace majorant {
namespace {

using Machine = MadeUpMachine;

TEST_F(Machine, QuotasOfProcessors) {
  const int all = available_processors(root_);
  if (all < 2) GTEST_SKIP() << "one processor: there is nothing to limit";
  write("/proc/self/cgroup", "0::/user/job\n");
  write("/sys/fs/cgroup/user/job/cpu.max", "max 100000\n");
  EXPECT_EQ(available_processors(root_), all);
  write("/sys/fs/cgroup/user/cpu.max", "50000 100000\n");
  EXPECT_EQ(available_processors(root_), 1);
  write("/sys/fs/cgroup/user/cpu.max", "150000 100000\n");
  EXPECT_EQ(available_processors(root_), 2);
  write("/proc/self/cgroup", "4:memory:/job\n3:cpu,cpuacct:/job\n0::/\n");
  write("/sys/fs/cgroup/cpu,cpuacct/job/cpu.cfs_quota_us", "-1\n");
  write("/sys/fs/cgroup/cpu,cpuacct/job/cpu.cfs_period_us", "100000\n");
  EXPECT_EQ(available_processors(root_), all);
  write("/sys/fs/cgroup/cpu,cpuacct/job/cpu.cfs_quota_us", "20000\n");
  EXPECT_EQ(available_processors(root_), 1);
}

TEST(AvailableProcessors, AreThoseOfTheAffinity) {
  cpu_set_t before;
  ASSERT_EQ(::sched_getaffinity(0, sizeof before, &before), 0);
  cpu_set_t one;
  CPU_ZERO(&one);
  for (int k = 0; k < CPU_SETSIZE && CPU_COUNT(&one) == 0; ++k)
    if (CPU_ISSET(k, &before)) CPU_SET(k, &one);
  ASSERT_EQ(::sched_setaffinity(0, sizeof one, &one), 0);
  EXPECT_EQ(available_processors(), 1);
  ASSERT_EQ(::sched_setaffinity(0, sizeof before, &before), 0);
  ASSERT_EQ(::setenv("OMP_NUM_THREADS", "1", 1), 0);
  EXPECT_EQ(available_processors(), 1);
  ::unsetenv("OMP_NUM_THREADS");
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
