#include "majorant/io/temporary_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstring>
#include <system_error>

#include "majorant/io/files/byte_counts.h"
#include "majorant/io/files/waiting_output.h"

namespace majorant {
namespace {

enum SlotState { kFree, kFilling, kArmed };

// A record that a signal handler may read: no allocation, no lock.
struct Slot {
  std::atomic<int> state{kFree};
  char path[PATH_MAX];
};

constexpr int kSlots = 16;  // unfinished files at one time; further ones are not registered
std::array<Slot, kSlots> slots;
static_assert(std::atomic<int>::is_always_lock_free, "handlers must not wait for a lock");

// Returns -1 if the registry is full.
int arm_slot(const std::string& path) {
  if (path.size() >= PATH_MAX) return -1;
  for (int s = 0; s < kSlots; ++s) {
    Slot& slot = slots[static_cast<std::size_t>(s)];
    int expected = kFree;
    if (!slot.state.compare_exchange_strong(expected, kFilling)) continue;
    std::memcpy(slot.path, path.c_str(), path.size() + 1);
    slot.state.store(kArmed);
    return s;
  }
  return -1;
}

void free_slot(int s) {
  if (s >= 0) slots[static_cast<std::size_t>(s)].state.store(kFree);
}

std::string temporary_name(const std::string& folder, const std::string& extension) {
  static std::atomic<unsigned> counter = 0;
  constexpr std::size_t kLongestExtension = 16;
  const bool keeps = extension.size() <= kLongestExtension;
  return fmt::format("{}{}.majorant-{}-{}.tmp{}", folder,
                     folder.empty() || folder.ends_with('/') ? "" : "/", ::getpid(), counter++,
                     keeps ? extension : "");
}

}  // namespace

TemporaryFile::TemporaryFile(const std::string& folder, const std::string& extension, mode_t mode) {
  do {  // a killed process with the same number may have left a file
    free_slot(slot_);
    path_ = temporary_name(folder, extension);
    slot_ = arm_slot(path_);  // before the file exists, so that a signal cannot leave it behind
    descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
  } while (descriptor_ < 0 && (errno == EEXIST || errno == EINTR));
  if (descriptor_ < 0) {
    const int code = errno;
    free_slot(slot_);
    throw std::system_error(code, std::generic_category());
  }
  exists_ = true;
}

TemporaryFile::~TemporaryFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (exists_) ::unlink(path_.c_str());
  free_slot(slot_);
}

int TemporaryFile::set_exact_mode(mode_t exact_mode) {
  return ::fchmod(descriptor_, exact_mode) == 0 ? 0 : errno;
}

int TemporaryFile::write_and_close(std::string_view content) {
  const int written = write_all(descriptor_, content, &byte_counts().written);
  const int closed = ::close(descriptor_) == 0 ? 0 : errno;
  descriptor_ = -1;
  return written != 0 ? written : closed;
}

int TemporaryFile::rename_to(const std::string& target) {
  if (std::rename(path_.c_str(), target.c_str()) != 0) return errno;
  exists_ = false;
  return 0;
}

void remove_temporary_files() noexcept {
  const int saved = errno;
  for (Slot& slot : slots)
    if (slot.state.load() == kArmed) ::unlink(slot.path);
  errno = saved;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
