// The output streams of the command: messages and progress on stderr, data on stdout. Nothing else
// in apps/ prints.
//
//   const int count = 12;
//   say("{}: valid\n", path);           // never fails: that nobody can read it changes nothing
//   print_data("faces: {}\n", count);   // what is lost here is an error, see data_error()
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace majorant::app {

// Descriptors 0, 1 and 2 that are closed become /dev/null, opened so that using them fails: else
// the next file that is opened would get the number, and messages would be written into it.
void open_standard_streams() noexcept;

// The text without control characters, as \\x1b, but for a line end at its end: names of files may
// hold them, and what they would do to a terminal is not for a file to say.
std::string one_line(std::string_view text);

void say_text(std::string_view text) noexcept;
// The last line of a terminal, shown anew by every call until something else is said; empty: none.
// From any thread.
void show_live(std::string_view line) noexcept;
void print_text(std::string_view text) noexcept;
// Prints help and the like, whose reader may leave before the end, as `| head` does: that is no
// error then.
void print_page(std::string_view text) noexcept;

// "majorant: warning: ..." for each.
void say_warnings(const std::vector<std::string>& warnings);

// One line.
template <class... Args>
void say(fmt::format_string<Args...> format, Args&&... args) {
  say_text(one_line(fmt::format(format, std::forward<Args>(args)...)));
}
template <class... Args>
void print_data(fmt::format_string<Args...> format, Args&&... args) {
  print_text(fmt::format(format, std::forward<Args>(args)...));
}

// The error number of the first print_text that failed, or of closing stdout, which this does: for
// the end of the process. 0: everything arrived.
int data_error() noexcept;

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
