// The processors that this process may use, and the control groups in which Linux limits it.
//
//   const int threads = available_processors();
//   for (const ControlGroup& group : control_groups("", "memory"))
//     std::cerr << group.folder << "\n";
//
// Containers set their limits by control groups, of version 1 or 2. The limits of a group hold for
// those inside it, so the groups are listed from that of the process all the way up. root: the
// folder that has /proc and /sys, another one in tests.
#pragma once

#include <string>
#include <vector>

namespace majorant {

struct ControlGroup {
  std::string folder;  // of its files
  int version = 2;
};
// The control group of this process that has the controller ("memory", "cpu"), then those around
// it.
std::vector<ControlGroup> control_groups(const std::string& root, const std::string& controller);

// The least of the processors of its affinity, of the CPU quota of its control groups, rounded up,
// and of OMP_NUM_THREADS, which batch systems set; at least 1.
int available_processors(const std::string& root = "");

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
