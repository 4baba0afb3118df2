// The processors that this process may use, and the control groups in which Linux limits it.
//
//   const int threads = available_processors();
//   for (const ControlGroup& group : control_groups("", "memory"))
//     std::cerr << group.folder << "\n";
//
// Containers set their limits by control groups, of version 1 or 2. The limits of a group also hold
// for the groups inside it, so the list goes from the group of the process up to the root. root:
// the folder that has /proc and /sys; tests pass another one.
#pragma once

#include <string>
#include <vector>

namespace majorant {

struct ControlGroup {
  std::string folder;  // of its files
  int version = 2;
};
// Returns the control group of this process that has the controller ("memory", "cpu"), then the
// groups around it.
std::vector<ControlGroup> control_groups(const std::string& root, const std::string& controller);

// Returns the smallest of three numbers, at least 1: the processors of the process's affinity, the
// CPU quota of its control groups, rounded up, and OMP_NUM_THREADS, which batch systems set.
int available_processors(const std::string& root = "");

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
