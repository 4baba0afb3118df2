#include "majorant/io/files/waiting_output.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <climits>
#include <mutex>
#include <optional>
#include <utility>

namespace majorant {
namespace {

using Clock = std::chrono::steady_clock;

std::mutex changing;  // guards the variables below
StopCheck current;
std::optional<Clock::time_point> patient_from;  // time of the stop, or of the last piece that
                                                // was taken after it

// Returns whether to stop waiting.
bool is_given_up() {
  const std::lock_guard lock(changing);
  if (current() == Directive::Continue) return false;
  if (!patient_from) patient_from = Clock::now();
  return std::chrono::duration<double>(Clock::now() - *patient_from).count() > kOutputPatience;
}

void note_progress() {
  const std::lock_guard lock(changing);
  if (patient_from) patient_from = Clock::now();
}

bool is_regular(int descriptor) {
  struct stat status {};
  return ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
}

}  // namespace

void set_output_stop(StopCheck stop) {
  const std::lock_guard lock(changing);
  patient_from.reset();
  current = std::move(stop);
}

// A pipe that is ready takes at least PIPE_BUF bytes without blocking.
int write_all(int descriptor, std::string_view content,
              std::atomic<std::uint64_t>* written) noexcept {
  constexpr std::size_t kShown = std::size_t{1} << 24;  // bytes between two updates of the counts,
                                                        // about 10 ms
  const std::size_t piece = is_regular(descriptor) ? kShown : PIPE_BUF;
  while (!content.empty()) {
    pollfd ready{descriptor, POLLOUT, 0};
    if (piece == PIPE_BUF && ::poll(&ready, 1, kWaitMilliseconds) <= 0) {
      if (is_given_up()) return ETIMEDOUT;
      continue;
    }
    const ssize_t taken =
        ::write(descriptor, content.data(), std::min<std::size_t>(piece, content.size()));
    if (taken >= 0) {
      content.remove_prefix(static_cast<std::size_t>(taken));
      if (written) *written += static_cast<std::size_t>(taken);
      if (piece == PIPE_BUF) note_progress();
    } else if (errno != EINTR && errno != EAGAIN) {
      return errno;
    }
  }
  return 0;
}

int open_waiting(const std::string& path) noexcept {
  for (;;) {
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
    if (descriptor >= 0) return descriptor;
    struct stat status {};
    const int code = errno;
    const bool lacks_reader =
        code == ENXIO && ::stat(path.c_str(), &status) == 0 && S_ISFIFO(status.st_mode);
    if (!lacks_reader && code != EINTR) return errno = code, -1;
    if (is_given_up()) return errno = ETIMEDOUT, -1;
    ::poll(nullptr, 0, kWaitMilliseconds);
  }
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
