// Walks over the words of a text file that is in memory, whatever their lines, and knows where each
// stood. For formats that are sequences of words: .msh, .mesh.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "majorant/framework/stop_check.h"

namespace majorant {

class TokenCursor {
 public:
  // comment: what begins one, up to the end of its line, or 0. `file`, `text` and `stop` must
  // outlive this.
  TokenCursor(const std::string& file, std::string_view text, char comment, const StopCheck& stop)
      : file_(file), text_(text), comment_(comment), stop_(stop) {}

  // The next word; empty at the end of the text.
  std::string_view next();
  // The rest of the line, without space around it.
  std::string_view rest_of_line();
  // What was read last begins here, and what comes next.
  std::size_t begin() const { return begin_; }
  std::size_t place() const { return at_; }
  void go_to(std::size_t place) { at_ = place; }
  std::size_t remaining() const { return text_.size() - at_; }
  std::string_view text() const { return text_; }

  // The next word as a finite number, an integer of 64 bits, a count of things that take a
  // character each at least. Throw Error(Unreadable).
  double number(std::string_view what);
  std::int64_t integer(std::string_view what);
  std::int64_t count(std::string_view what);

  // Throws Error(Unreadable, "file:line: problem"), the line of what was read last.
  [[noreturn]] void fail(std::string_view problem) const;

 private:
  const std::string& file_;
  std::string_view text_;
  char comment_;
  const StopCheck& stop_;
  std::size_t at_ = 0, begin_ = 0, words_ = 0;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
