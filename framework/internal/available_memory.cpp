#include "majorant/framework/internal/available_memory.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>

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

// What a version of control groups calls its files.
struct GroupFiles {
  const char *folder, *limit, *usage, *cache;
};
constexpr GroupFiles kFirst{"/sys/fs/cgroup/memory", "/memory.limit_in_bytes",
                            "/memory.usage_in_bytes", "total_inactive_file"};
constexpr GroupFiles kSecond{"/sys/fs/cgroup", "/memory.max", "/memory.current", "inactive_file"};

std::size_t left_in_group(const std::string& folder, const GroupFiles& files) {
  const auto limit = number(folder + files.limit), usage = number(folder + files.usage);
  if (!limit || !usage) return kNoLimit;
  const std::size_t cache = number(folder + "/memory.stat", files.cache).value_or(0);
  const std::size_t taken = *usage - std::min(cache, *usage);
  return *limit - std::min(taken, *limit);
}

// Limits of a group hold for those inside it: all the way up.
std::size_t left_in_groups(const std::string& root, std::string group, const GroupFiles& files) {
  std::size_t least = kNoLimit;
  for (;; group.resize(group.rfind('/'))) {
    while (!group.empty() && group.back() == '/') group.pop_back();
    least = std::min(least, left_in_group(root + files.folder + group, files));
    if (group.rfind('/') == std::string::npos) return least;
  }
}

}  // namespace

std::optional<std::size_t> available_memory(const std::string& root) {
  if (const char* told = std::getenv("MAJORANT_MEMORY_BYTES"))
    return std::strtoull(told, nullptr, 10);
  return free_memory(root);
}

std::optional<std::size_t> free_memory(const std::string& root) {
  std::size_t least = kNoLimit;
  if (const auto kib = number(root + "/proc/meminfo", "MemAvailable:")) least = *kib * 1024;
  std::ifstream groups(root + "/proc/self/cgroup");  // HIERARCHY:CONTROLLERS:GROUP
  for (std::string line; std::getline(groups, line);) {
    std::istringstream parts(line);
    std::string hierarchy, controllers, group;
    std::getline(parts, hierarchy, ':');
    std::getline(parts, controllers, ':');
    std::getline(parts, group);
    if (controllers == "memory") least = std::min(least, left_in_groups(root, group, kFirst));
    if (controllers.empty()) least = std::min(least, left_in_groups(root, group, kSecond));
  }
  if (least == kNoLimit) return {};
  return least;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
