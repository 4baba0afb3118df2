#include "majorant/io/internal/token_cursor.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "majorant/framework/error.h"
#include "majorant/io/files/input_file.h"

namespace majorant {
namespace {

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

// Without a plus sign, which std::from_chars does not take.
std::string_view unsigned_word(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  return word;
}

template <class Number>
bool parse(std::string_view word, Number& value) {
  word = unsigned_word(word);
  const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
  return code == std::errc() && end == word.data() + word.size() && !word.empty();
}

}  // namespace

std::string_view TokenCursor::next() {
  stop_.poll_at(words_++);
  for (;;) {
    while (at_ < text_.size() && is_space(text_[at_])) ++at_;
    if (comment_ == 0 || at_ >= text_.size() || text_[at_] != comment_) break;
    at_ = std::min(text_.find('\n', at_), text_.size());
  }
  begin_ = at_;
  while (at_ < text_.size() && !is_space(text_[at_])) ++at_;
  return text_.substr(begin_, at_ - begin_);
}

std::string_view TokenCursor::rest_of_line() {
  const std::size_t end = std::min(text_.find('\n', at_), text_.size());
  std::string_view line = text_.substr(at_, end - at_);
  at_ = end;
  while (!line.empty() && is_space(line.front())) line.remove_prefix(1);
  while (!line.empty() && is_space(line.back())) line.remove_suffix(1);
  return line;
}

double TokenCursor::number(std::string_view what) {
  const std::string_view word = next();
  double value = 0;
  if (word.empty()) fail(fmt::format("{} is missing; the file is truncated", what));
  if (!parse(word, value) || !std::isfinite(value))
    fail(fmt::format("{} is {}, no finite number", what, in_quotes(word)));
  return value;
}

std::int64_t TokenCursor::integer(std::string_view what) {
  const std::string_view word = next();
  std::int64_t value = 0;
  if (word.empty()) fail(fmt::format("{} is missing; the file is truncated", what));
  if (!parse(word, value)) fail(fmt::format("{} is {}, no integer", what, in_quotes(word)));
  return value;
}

std::int64_t TokenCursor::count(std::string_view what) {
  const std::int64_t value = integer(what);
  if (value < 0 || static_cast<std::uint64_t>(value) > remaining())
    fail(fmt::format("{} is {}, more than the file has; it is damaged or truncated", what, value));
  return value;
}

void TokenCursor::fail(std::string_view problem) const {
  const auto end = text_.begin() + static_cast<std::ptrdiff_t>(std::min(begin_, text_.size()));
  throw Error(ErrorKind::Unreadable,
              fmt::format("{}:{}: {}", file_, 1 + std::count(text_.begin(), end, '\n'), problem));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
