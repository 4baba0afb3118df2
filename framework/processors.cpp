#include "majorant/framework/processors.h"

#include <sched.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>
#include <thread>

namespace majorant {
namespace {

// Returns the quota in processors; infinity for none: "max 100000" of version 2, -1 of version 1.
double cpu_quota_of(const ControlGroup& group) {
  double quota = -1, period = 0;  // microseconds
  if (group.version == 2) {
    std::ifstream(group.folder + "/cpu.max") >> quota >> period;
  } else {
    std::ifstream(group.folder + "/cpu.cfs_quota_us") >> quota;
    std::ifstream(group.folder + "/cpu.cfs_period_us") >> period;
  }
  return quota > 0 && period > 0 ? quota / period : std::numeric_limits<double>::infinity();
}

int processors_of_affinity() {
  cpu_set_t set;
  if (::sched_getaffinity(0, sizeof set, &set) == 0) return CPU_COUNT(&set);
  return static_cast<int>(std::thread::hardware_concurrency());  // more processors than cpu_set_t
                                                                 // holds
}

}  // namespace

std::vector<ControlGroup> control_groups(const std::string& root, const std::string& controller) {
  std::vector<ControlGroup> found;
  std::ifstream groups(root + "/proc/self/cgroup");  // HIERARCHY:CONTROLLERS:GROUP
  for (std::string line; std::getline(groups, line);) {
    std::istringstream parts(line);
    std::string hierarchy, controllers, group;
    std::getline(parts, hierarchy, ':');
    std::getline(parts, controllers, ':');
    std::getline(parts, group);
    const bool is_second = controllers.empty();
    if (!is_second && ("," + controllers + ",").find("," + controller + ",") == std::string::npos)
      continue;
    const std::string mount = root + "/sys/fs/cgroup" + (is_second ? "" : "/" + controllers);
    for (;; group.resize(group.rfind('/'))) {
      while (!group.empty() && group.back() == '/') group.pop_back();
      found.push_back({mount + group, is_second ? 2 : 1});
      if (group.rfind('/') == std::string::npos) break;
    }
  }
  return found;
}

int available_processors(const std::string& root) {
  double least = processors_of_affinity();
  for (const ControlGroup& group : control_groups(root, "cpu"))
    least = std::min(least, std::ceil(cpu_quota_of(group)));
  if (const char* text = std::getenv("OMP_NUM_THREADS"))
    if (const int threads = std::atoi(text); threads > 0) least = std::min<double>(least, threads);
  return std::max(1, static_cast<int>(least));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
