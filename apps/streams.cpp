#include "apps/streams.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <mutex>

#include "majorant/io/files/waiting_output.h"

namespace majorant::app {
namespace {

int first_error = 0;  // first error of stdout

constexpr std::string_view kClearLine = "\r\x1b[K";
std::mutex writing;  // guards stderr
bool is_live = false;

void clear_live() noexcept {
  if (is_live) write_all(STDERR_FILENO, kClearLine);
  is_live = false;
}

}  // namespace

void open_standard_streams() noexcept {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) != -1 || errno != EBADF) continue;
    // open() returns the lowest free descriptor, which is this one.
    if (::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY) != stream) return;
  }
}

std::string one_line(std::string_view text) {
  const std::string_view end = text.ends_with('\n') ? "\n" : "";
  text.remove_suffix(end.size());
  std::string line;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const auto c = static_cast<unsigned char>(text[k]);
    // U+0080 to U+009F are control characters for some terminals. In UTF-8 they are 0xC2 followed
    // by that byte.
    const bool is_second =
        c >= 0x80 && c < 0xa0 && k > 0 && static_cast<unsigned char>(text[k - 1]) == 0xc2;
    if (is_second) line.pop_back();
    if (c < 0x20 || c == 0x7f || is_second)
      line += c == '\n' ? "\\n" : fmt::format("\\x{:02x}", c);
    else
      line += text[k];
  }
  return line += end;
}

void say_text(std::string_view text) noexcept {
  const std::lock_guard lock(writing);
  clear_live();
  write_all(STDERR_FILENO, text);
}

void show_live(std::string_view line) noexcept {
  const std::lock_guard lock(writing);
  clear_live();
  is_live = !line.empty();
  write_all(STDERR_FILENO, line);
}

void say_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) say("majorant: warning: {}\n", warning);
}

void print_text(std::string_view text) noexcept {
  show_live({});
  if (first_error == 0) first_error = write_all(STDOUT_FILENO, text);
}

void print_page(std::string_view text) noexcept {
  print_text(text);
  if (first_error == EPIPE) first_error = 0;
}

int data_error() noexcept {
  if (::close(STDOUT_FILENO) != 0 && first_error == 0) first_error = errno;
  return first_error;
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
