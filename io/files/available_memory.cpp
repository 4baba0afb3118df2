#include "majorant/io/files/available_memory.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <limits>

#include "majorant/framework/processors.h"

namespace majorant {
namespace {

constexpr std::size_t kNoLimit = std::numeric_limits<std::size_t>::max();

// Returns the number after `name` in a file of lines "NAME NUMBER"; without a name, the first
// number.
std::optional<std::size_t> number(const std::string& path, const std::string& name = "") {
  std::ifstream file(path);
  std::string word;
  if (!name.empty())
    while (file >> word && word != name) file.ignore(kNoLimit >> 1, '\n');
  std::size_t value = 0;
  if (!(file >> value)) return {};  // also for "max"
  return value;
}

// File names of a version of control groups.
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

}  // namespace

std::optional<std::size_t> available_memory(const std::string& root) {
  if (const char* text = std::getenv("MAJORANT_MEMORY_BYTES"))
    return std::strtoull(text, nullptr, 10);
  return free_memory(root);
}

std::optional<std::size_t> free_memory(const std::string& root) {
  std::size_t least = kNoLimit;
  if (const auto kib = number(root + "/proc/meminfo", "MemAvailable:")) least = *kib * 1024;
  for (const auto& [folder, version] : control_groups(root, "memory"))
    least = std::min(least, memory_left_in(folder, version == 2 ? kSecond : kFirst));
  if (least == kNoLimit) return {};
  return least;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
