// Walks over the lines, words and numbers of a text that is in memory: the tokenizer of all text
// formats, and of XML's arrays.
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
// Blank lines and everything from a `#` that starts a token are skipped. Never reads outside the
// text. Not for binary sections (see byte_cursor.h).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/io/files/byte_counts.h"

namespace majorant {

// The meaning of the end of a line.
enum class TextLines {
  Plain,      // the end of its tokens
  Continued,  // the same, but behind a backslash (OBJ)
  Space,      // space between words
};
enum class TextComments { Hash, None };

enum class NumberStatus { Good, NotANumber, NotFinite };

// How far decimals may be from their double: half a unit of its last place, 0 where they are found
// to be the same number.
double decimal_rounding(std::string_view decimal, double nearest);

class TextCursor {
 public:
  // `file` is for messages. `text` (see require_text) must outlive the cursor. Every function that
  // moves on may throw Stopped.
  TextCursor(const std::string& file, std::string_view text, TextLines lines, StopCheck stop = {},
             TextComments comments = TextComments::Hash);

  bool next_line();  // to the next line that holds a token; false at the end of the text
  // From now on next_line() appends the comments that have a line of their own, from `#` on.
  void collect_comments(std::vector<std::string_view>& comments) { comments_ = &comments; }
  long line() const { return line_; }                 // number of the current line, 1-based
  long lines_read() const { return next_line_ - 1; }  // continuations and skipped ones included
  std::string_view whole_line() const;                // the current line without surrounding space
  std::string_view ahead() const;                     // the lines behind the current one
  // Goes on so many characters of these, which are whole lines: the last of them is the current
  // one.
  void pass(std::size_t size, long lines);
  bool at_end_of_line();  // no token is left on the current line

  // The next token of the current line, empty at its end; where lines are space, of the text.
  std::string_view next_token();
  // What is left of the current line, without space around it.
  std::string_view rest_of_line();

  // Places in the text: of the token that was read last, and behind it. After go_to() the current
  // line begins there.
  std::string_view text() const {
    return {text_begin_, static_cast<std::size_t>(text_end_ - text_begin_)};
  }
  std::size_t begin() const { return static_cast<std::size_t>(token_ - text_begin_); }
  std::size_t place() const { return static_cast<std::size_t>(cursor_ - text_begin_); }
  std::size_t remaining() const { return static_cast<std::size_t>(text_end_ - cursor_); }
  void go_to(std::size_t place);

  // The next token as a finite number, an integer. `what` names it in messages.
  // Throw Error(Unreadable) if it is missing, not a number, not finite or (integers) over 64 bits.
  double next_number(std::string_view what);
  long long next_integer(std::string_view what);
  // The number of things that take a character each at least: no more than the text can hold.
  long long next_count(std::string_view what);
  // The same for what a file can do without: false where next_number would throw, and
  // number_problem() says why, without a remedy.
  bool try_number(double& value);
  std::string number_problem(std::string_view what) const;
  // decimal_rounding() of the number that was read last.
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
  const char* token_;        // begin of the last one
  bool has_jumped_ = false;  // lines are counted anew where they are asked for
  StopCheck stop_;
  ParsedBytes parsed_;
  std::vector<std::string_view>* comments_ = nullptr;
  std::string_view number_;  // the token of the last number
  NumberStatus status_ = NumberStatus::Good;
  double value_ = 0;
  std::size_t steps_ = 0;  // lines and tokens, for polling
};

// A line of an OBJ as one: where it is continued, backslash, what follows it and the line end are a
// space.
std::string joined_line(std::string_view line);

// Returns whether a decimal is exactly this double, its nearest. Says false for decimals of more
// than 19 digits, or powers of ten beyond 22, that it does not look into.
bool is_exact(std::string_view decimal, double nearest);

// The whole token as a double, independent of the locale. "nan", "inf" and overflow are NotFinite;
// underflow gives the nearest double (zero or a denormal).
NumberStatus parse_number(std::string_view token, double& value);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
