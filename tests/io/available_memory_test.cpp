#include "majorant/io/files/available_memory.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "framework/made_up_machine.h"

namespace majorant {
namespace {

class Machine : public MadeUpMachine {
 protected:
  void SetUp() override {
    MadeUpMachine::SetUp();
    write("/proc/meminfo",
          "MemTotal: 64 kB\nMemFree: 10 kB\nMemAvailable: 50 kB\nSwapFree: 7 kB\n");
  }
  std::size_t available() const { return available_memory(root_).value_or(0); }
};

TEST_F(Machine, WithoutLimits) { EXPECT_EQ(available(), 50u * 1024); }

TEST_F(Machine, WithoutAProcFolder) {
  std::filesystem::remove_all(root_ + "/proc");
  EXPECT_FALSE(available_memory(root_));
}

TEST_F(Machine, GroupOfVersionTwo) {
  write("/proc/self/cgroup", "0::/user/job\n");
  const std::string group = "/sys/fs/cgroup/user/job";
  write(group + "/memory.max", "30000\n");
  write(group + "/memory.current", "20000\n");
  EXPECT_EQ(available(), 10000u);
  write(group + "/memory.stat", "anon 5000\ninactive_file 4000\nactive_file 1\n");
  EXPECT_EQ(available(), 14000u);
  write(group + "/memory.current", "60000\n");
  EXPECT_EQ(available(), 0u);
  write(group + "/memory.max", "max\n");
  EXPECT_EQ(available(), 50u * 1024);
  // A parent group with a lower limit.
  write("/sys/fs/cgroup/user/memory.max", "9000\n");
  write("/sys/fs/cgroup/user/memory.current", "2000\n");
  EXPECT_EQ(available(), 7000u);
  // In a container the own group may be the root.
  write("/proc/self/cgroup", "0::/\n");
  write("/sys/fs/cgroup/memory.max", "8000\n");
  write("/sys/fs/cgroup/memory.current", "2500\n");
  EXPECT_EQ(available(), 5500u);
}

TEST_F(Machine, GroupOfVersionOne) {
  write("/proc/self/cgroup", "9:name=systemd:/\n4:memory:/job\n3:cpu:/else\n0::/\n");
  const std::string group = "/sys/fs/cgroup/memory/job";
  write(group + "/memory.limit_in_bytes", "30000\n");
  write(group + "/memory.usage_in_bytes", "25000\n");
  write(group + "/memory.stat", "inactive_file 7\ntotal_inactive_file 3000\n");
  EXPECT_EQ(available(), 8000u);
  write(group + "/memory.limit_in_bytes", "9223372036854771712\n");  // no limit
  EXPECT_EQ(available(), 50u * 1024);
}

TEST_F(Machine, TheEnvironmentOverridesTheSystem) {
  ASSERT_EQ(::setenv("MAJORANT_MEMORY_BYTES", "123456789012", 1), 0);
  EXPECT_EQ(available(), 123456789012u);
  ::unsetenv("MAJORANT_MEMORY_BYTES");
}

TEST(MachineMemory, OfThisMachineIsPlausible) {
  const auto bytes = available_memory();
  ASSERT_TRUE(bytes);
  EXPECT_GT(*bytes, std::size_t{1} << 20);
  EXPECT_LT(*bytes, std::size_t{1} << 50);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
