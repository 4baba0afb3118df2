// Walks over the lines, words and numbers of a text in memory. All text formats and the arrays of
// XML use it.
//
//   TextCursor cursor(path, text, TextLines::Continued);
//   while (cursor.next_line()) {
//     if (cursor.next_token() == "v") const double x = cursor.next_number("x coordinate");
//   }
//
//   TextCursor words(path, text, TextLines::Space);   // of formats that are a row of words
//   while (words.next_token() != "$Nodes") {
//   }
//   const long long nodes = words.next_count("the number of nodes");
//
// Skips blank lines and everything from a `#` that begins a token. Never reads outside of the text.
// Not for binary sections (see byte_cursor.h).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/io/files/byte_counts.h"

namespace majorant {

// The meaning of the end of a line.
enum class TextLines {
  Plain,      // ends the tokens of a line
  Continued,  // the same, unless a backslash precedes it (OBJ)
  Space,      // is space between words
};
enum class TextComments { Hash, None };

enum class NumberStatus { Good, NotANumber, NotFinite };

// Returns a bound on the distance of a decimal from its double: half a unit in the last place, or 0
// if they are found to be equal.
double decimal_rounding(std::string_view decimal, double nearest);

class TextCursor {
 public:
  // `file` is for messages. `text` (see require_text) must outlive the cursor. Functions that move
  // the cursor may throw Stopped.
  TextCursor(const std::string& file, std::string_view text, TextLines lines, StopCheck stop = {},
             TextComments comments = TextComments::Hash);

  bool next_line();  // moves to the next line with a token; false at the end of the text
  // After this, next_line() appends comments on lines of their own, from `#` on.
  void collect_comments(std::vector<std::string_view>& comments) { comments_ = &comments; }
  long line() const { return line_; }                 // number of the current line, 1-based
  long lines_read() const { return next_line_ - 1; }  // including continuations and skipped lines
  std::string_view whole_line() const;  // returns the current line without surrounding space
  std::string_view ahead() const;       // returns the lines after the current one
  // Moves on by `size` characters, which must be whole lines; the last of them becomes the current
  // line.
  void pass(std::size_t size, long lines);
  bool at_end_of_line();  // returns whether the current line has no more tokens

  // Returns the next token of the current line, empty at its end. If line ends are space, of the
  // text.
  std::string_view next_token();
  // Returns the rest of the current line without surrounding space.
  std::string_view rest_of_line();

  // Positions in the text of the last token and of its end. After go_to() the current line begins
  // at this position.
  std::string_view text() const {
    return {text_begin_, static_cast<std::size_t>(text_end_ - text_begin_)};
  }
  std::size_t begin() const { return static_cast<std::size_t>(token_ - text_begin_); }
  std::size_t place() const { return static_cast<std::size_t>(cursor_ - text_begin_); }
  std::size_t remaining() const { return static_cast<std::size_t>(text_end_ - cursor_); }
  void go_to(std::size_t place);

  // These return the next token as a finite number, or as an integer. `what` names it in messages.
  // They throw Error(Unreadable) if it is missing, not a number, not finite or (integers) over 64
  // bits.
  double next_number(std::string_view what);
  long long next_integer(std::string_view what);
  // Returns a number of things that take at least a character each, at most as many as the text can
  // hold.
  long long next_count(std::string_view what);
  // Reads an optional number. Returns false if next_number() would throw; number_problem() then
  // gives the reason without a remedy.
  bool try_number(double& value);
  std::string number_problem(std::string_view what) const;
  // Returns decimal_rounding() of the last number.
  double rounding() const { return decimal_rounding(number_, value_); }

  // Throws Error(Unreadable) if a token is left on the current line.
  void require_end_of_line();

  // Throws Error(Unreadable, "file:line: problem").
  [[noreturn]] void fail(std::string_view problem) const;

 private:
  void poll();
  void skip_space();
  bool is_continuation(const char* at) const;
  const char* end_of_line(const char* begin);

  const std::string& file_;
  const char* text_begin_;
  const char* text_end_;
  const char* line_begin_;
  const char* line_end_;
  const char* cursor_;
  long line_ = 0;
  long next_line_ = 1;  // number of the line that begins after line_end_
  TextLines lines_;
  TextComments comment_style_;
  const char* token_;        // begin of the last token
  bool has_jumped_ = false;  // lines are counted again when the number is needed
  StopCheck stop_;
  ParsedBytes parsed_;
  std::vector<std::string_view>* comments_ = nullptr;
  std::string_view number_;  // token of the last number
  NumberStatus status_ = NumberStatus::Good;
  double value_ = 0;
  std::size_t steps_ = 0;  // lines and tokens, between two polls
};

// Joins a continued line of an OBJ: backslash, the rest of its line and the line end become a
// space.
std::string joined_line(std::string_view line);

// Returns whether a decimal equals this double, its nearest. Returns false for decimals of more
// than 19 digits or powers of ten beyond 22, which are not examined.
bool is_exact(std::string_view decimal, double nearest);

// Parses the whole token as a double, independent of the locale. "nan", "inf" and overflow are
// NotFinite; underflow gives the nearest double (zero or a denormal).
NumberStatus parse_number(std::string_view token, double& value);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
