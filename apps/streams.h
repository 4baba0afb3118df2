// The output streams of the command: messages and progress on stderr, data on stdout. No other file
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

// Opens closed descriptors 0, 1 and 2 as /dev/null in the wrong direction, so that their use fails.
// Otherwise the next opened file would get such a number and receive messages.
void open_standard_streams() noexcept;

// Returns the text with control characters escaped (\x1b), except a final line end. File names may
// contain such characters, which would act on a terminal.
std::string one_line(std::string_view text);

void say_text(std::string_view text) noexcept;
// Shows the last line of a terminal, which each call replaces until something else is printed;
// empty: removes it. May be called from any thread.
void show_live(std::string_view line) noexcept;
void print_text(std::string_view text) noexcept;
// Prints help and similar pages. It is no error if the reader leaves early, as `| head` does.
void print_page(std::string_view text) noexcept;

// Prints "majorant: warning: ..." for each warning.
void say_warnings(const std::vector<std::string>& warnings);

// Prints one line on stderr.
template <class... Args>
void say(fmt::format_string<Args...> format, Args&&... args) {
  say_text(one_line(fmt::format(format, std::forward<Args>(args)...)));
}
template <class... Args>
void print_data(fmt::format_string<Args...> format, Args&&... args) {
  print_text(fmt::format(format, std::forward<Args>(args)...));
}

// Closes stdout and returns the error number of the first failed print_text() or of closing. 0 if
// all data were written. Call it at the end of the process.
int data_error() noexcept;

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
