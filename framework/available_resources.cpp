#include "majorant/framework/available_resources.h"

#include <malloc.h>
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

constexpr std::size_t kNoLimit = std::numeric_limits<std::size_t>::max();

// The number after `name` in a file of lines "NAME NUMBER"; of one without names, the first.
std::optional<std::size_t> number(const std::string& path, const std::string& name = "") {
  std::ifstream file(path);
  std::string word;
  if (!name.empty())
    while (file >> word && word != name) file.ignore(kNoLimit >> 1, '\n');
  std::size_t value = 0;
  if (!(file >> value)) return {};  // "max", too
  return value;
}

// visit(folder, version) for the control group of the process that has this controller, and for
// those around it: limits of a group hold for those inside it.
template <class Visit>
void visit_groups(const std::string& root, const std::string& controller, const Visit& visit) {
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
      visit(mount + group, is_second ? 2 : 1);
      if (group.rfind('/') == std::string::npos) break;
    }
  }
}

// The names of files in a version of control groups.
struct MemoryFiles {
  const char *limit, *usage, *cache;
};
constexpr MemoryFiles kFirst{"/memory.limit_in_bytes", "/memory.usage_in_bytes",
                             "total_inactive_file"};
constexpr MemoryFiles kSecond{"/memory.max", "/memory.current", "inactive_file"};

std::size_t memory_left_in(const std::string& folder, const MemoryFiles& files) {
  const auto limit = number(folder + files.limit), usage = number(folder + files.usage);
  if (!limit || !usage) return kNoLimit;
  const std::size_t cache = number(folder + "/memory.stat", files.cache).value_or(0);
  const std::size_t taken = *usage - std::min(cache, *usage);
  return *limit - std::min(taken, *limit);
}

// Returns the quota in processors; infinity is none: "max 100000" of version 2, -1 of version 1.
double cpu_quota_of(const std::string& folder, int version) {
  double quota = -1, period = 0;  // microseconds
  if (version == 2) {
    std::ifstream(folder + "/cpu.max") >> quota >> period;
  } else {
    std::ifstream(folder + "/cpu.cfs_quota_us") >> quota;
    std::ifstream(folder + "/cpu.cfs_period_us") >> period;
  }
  return quota > 0 && period > 0 ? quota / period : std::numeric_limits<double>::infinity();
}

int processors_of_affinity() {
  cpu_set_t set;
  if (::sched_getaffinity(0, sizeof set, &set) == 0) return CPU_COUNT(&set);
  return static_cast<int>(std::thread::hardware_concurrency());  // more than cpu_set_t has
}

}  // namespace

void release_free_memory() {
#ifdef __GLIBC__
  ::malloc_trim(0);
#endif
}

std::optional<std::size_t> available_memory(const std::string& root) {
  if (const char* told = std::getenv("MAJORANT_MEMORY_BYTES"))
    return std::strtoull(told, nullptr, 10);
  return free_memory(root);
}

std::optional<std::size_t> free_memory(const std::string& root) {
  std::size_t least = kNoLimit;
  if (const auto kib = number(root + "/proc/meminfo", "MemAvailable:")) least = *kib * 1024;
  visit_groups(root, "memory", [&](const std::string& folder, int version) {
    least = std::min(least, memory_left_in(folder, version == 2 ? kSecond : kFirst));
  });
  if (least == kNoLimit) return {};
  return least;
}

int available_processors(const std::string& root) {
  double least = processors_of_affinity();
  visit_groups(root, "cpu", [&](const std::string& folder, int version) {
    least = std::min(least, std::ceil(cpu_quota_of(folder, version)));
  });
  if (const char* told = std::getenv("OMP_NUM_THREADS"))
    if (const int threads = std::atoi(told); threads > 0) least = std::min<double>(least, threads);
  return std::max(1, static_cast<int>(least));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
