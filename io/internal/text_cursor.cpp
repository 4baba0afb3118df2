#include "majorant/io/internal/text_cursor.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <locale>
#include <sstream>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/io/files/input_file.h"

namespace majorant {
namespace {

constexpr std::uint8_t kSpace = 1, kTokenEnd = 2;  // kTokenEnd: may end a token

constexpr std::array<std::uint8_t, 256> kinds_of_characters() {
  std::array<std::uint8_t, 256> kinds{};
  for (const char c : {' ', '\t', '\r', '\v', '\f'})
    kinds[static_cast<unsigned char>(c)] = kSpace | kTokenEnd;
  for (const char c : {'\n', '\\'}) kinds[static_cast<unsigned char>(c)] = kTokenEnd;
  return kinds;
}
constexpr std::array<std::uint8_t, 256> kKinds = kinds_of_characters();

bool is_space(char c) { return (kKinds[static_cast<unsigned char>(c)] & kSpace) != 0; }
bool may_end_token(char c) { return (kKinds[static_cast<unsigned char>(c)] & kTokenEnd) != 0; }

bool has_comment(std::string_view line) {
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '#' && (i == 0 || is_space(line[i - 1]))) return true;
  }
  return false;
}

// from_chars does not distinguish overflow from underflow; a stream in the C locale does.
NumberStatus parse_extreme_number(std::string_view token, double& value) {
  std::istringstream stream{std::string(token)};
  stream.imbue(std::locale::classic());
  stream >> value;
  return std::abs(value) < 1.0 ? NumberStatus::Good : NumberStatus::NotFinite;
}

}  // namespace

NumberStatus parse_number(std::string_view token, double& value) {
  if (token.size() > 1 && token.front() == '+' && token[1] != '-') token.remove_prefix(1);
  const char* end = token.data() + token.size();
  const auto [stop, code] = std::from_chars(token.data(), end, value);
  if (stop != end || code == std::errc::invalid_argument) return NumberStatus::NotANumber;
  if (code == std::errc::result_out_of_range) return parse_extreme_number(token, value);
  return std::isfinite(value) ? NumberStatus::Good : NumberStatus::NotFinite;
}

std::string joined_line(std::string_view line) {
  std::string joined;
  for (std::size_t end = line.find('\n'); end != std::string_view::npos; end = line.find('\n')) {
    const std::string_view part = line.substr(0, end);
    joined += part.substr(0, part.rfind('\\'));
    joined.push_back(' ');
    line.remove_prefix(end + 1);
  }
  joined += line;
  return joined;
}

bool is_exact(std::string_view decimal, double nearest) {
  constexpr int kMaxDigits = 19, kMaxPower = 22;  // digits of a 64-bit integer; 10^22 is exact as
                                                  // a double
  if (!decimal.empty() && (decimal.front() == '-' || decimal.front() == '+'))
    decimal.remove_prefix(1);
  std::uint64_t digits = 0;
  int count = 0, power = 0;
  bool is_fraction = false;
  std::size_t k = 0;
  for (; k < decimal.size() && decimal[k] != 'e' && decimal[k] != 'E'; ++k) {
    if (decimal[k] == '.') {
      is_fraction = true;
      continue;
    }
    if (count > 0 || decimal[k] != '0') ++count;
    if (count > kMaxDigits) return false;
    digits = 10 * digits + static_cast<std::uint64_t>(decimal[k] - '0');
    power -= is_fraction;
  }
  if (digits == 0) return true;
  if (k < decimal.size()) {
    int exponent = 0;
    k += 1 + (k + 1 < decimal.size() && decimal[k + 1] == '+');
    const char* end = decimal.data() + decimal.size();
    if (std::from_chars(decimal.data() + k, end, exponent).ptr != end) return false;
    if (std::abs(exponent) > kMaxPower) return false;
    power += exponent;
  }
  for (; digits % 10 == 0; digits /= 10) ++power;
  const auto integer = static_cast<double>(digits);
  if (digits > (std::uint64_t{1} << 53) || std::abs(power) > kMaxPower) return false;
  constexpr std::array<double, kMaxPower + 1> kPowers = {
      1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
      1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
  const double scale = kPowers[std::abs(power)];
  // fma rounds once, so it is zero only if the products are equal.
  return power >= 0 ? std::fma(integer, scale, -std::abs(nearest)) == 0
                    : std::fma(std::abs(nearest), scale, -integer) == 0;
}

TextCursor::TextCursor(const std::string& file, std::string_view text, TextLines lines,
                       StopCheck stop, TextComments comments)
    : file_(file),
      text_begin_(text.data()),
      text_end_(text.data() + text.size()),
      line_begin_(text.data()),
      line_end_(nullptr),
      cursor_(text.data()),
      lines_(lines),
      comment_style_(comments),
      token_(text.data()),
      stop_(std::move(stop)),
      parsed_(text.size()) {}

void TextCursor::poll() {
  if (++steps_ % StopCheck::kPeriod != 0) return;
  stop_.poll();
  parsed_.reach(static_cast<std::size_t>(cursor_ - text_begin_));
}

// Returns whether a backslash precedes the end of the line or of the text.
bool TextCursor::is_continuation(const char* at) const {
  if (lines_ != TextLines::Continued || *at != '\\') return false;
  ++at;
  while (at != text_end_ && is_space(*at)) ++at;
  return at == text_end_ || *at == '\n';
}

// Returns the end of the line that begins here, with continuations, without '\n'. A backslash in a
// comment continues nothing: it may be part of a path.
const char* TextCursor::end_of_line(const char* begin) {
  const auto line_feed = [this](const char* from) {
    const void* found = std::memchr(from, '\n', static_cast<std::size_t>(text_end_ - from));
    return found != nullptr ? static_cast<const char*>(found) : text_end_;
  };
  const char* end = line_feed(begin);
  if (lines_ != TextLines::Continued) return end;
  while (end != text_end_) {
    const char* last = end;
    while (last != begin && is_space(last[-1])) --last;
    if (last == begin || last[-1] != '\\' || has_comment({begin, last})) break;
    begin = end + 1;
    end = line_feed(begin);
    ++next_line_;
  }
  return end;
}

bool TextCursor::next_line() {
  const char* begin = line_end_ == nullptr ? line_begin_ : line_end_;
  if (line_end_ != nullptr && begin != text_end_) ++begin;
  while (begin != text_end_) {
    poll();
    line_ = next_line_++;
    line_begin_ = cursor_ = begin;
    line_end_ = end_of_line(begin);
    if (!at_end_of_line()) return true;
    if (comments_ != nullptr && cursor_ != line_end_) comments_->push_back(whole_line());
    begin = line_end_ == text_end_ ? text_end_ : line_end_ + 1;
  }
  line_begin_ = line_end_ = cursor_ = text_end_;
  parsed_.reach(static_cast<std::size_t>(text_end_ - text_begin_));
  return false;
}

std::string_view TextCursor::ahead() const {
  const char* begin = line_end_ == nullptr ? line_begin_ : line_end_;
  if (line_end_ != nullptr && begin != text_end_) ++begin;
  return {begin, static_cast<std::size_t>(text_end_ - begin)};
}

void TextCursor::pass(std::size_t size, long lines) {
  if (lines == 0) return;
  next_line_ += lines;
  line_ = next_line_ - 1;
  const char* const end = ahead().data() + size;
  line_begin_ = line_end_ = cursor_ = end[-1] == '\n' ? end - 1 : end;  // end of the last line
}

std::string_view TextCursor::whole_line() const {
  const char* begin = line_begin_;
  const char* end = line_end_;
  while (begin != end && is_space(*begin)) ++begin;
  while (begin != end && is_space(end[-1])) --end;
  return {begin, static_cast<std::size_t>(end - begin)};
}

void TextCursor::skip_space() {
  while (cursor_ != line_end_ && (is_space(*cursor_) || *cursor_ == '\n' ||
                                  (*cursor_ == '\\' && is_continuation(cursor_)))) {
    ++cursor_;
  }
}

bool TextCursor::at_end_of_line() {
  skip_space();
  return cursor_ == line_end_ || (*cursor_ == '#' && comment_style_ == TextComments::Hash);
}

std::string_view TextCursor::next_token() {
  if (lines_ == TextLines::Space)
    while ((line_end_ == nullptr || at_end_of_line()) && next_line()) {
    }
  token_ = cursor_;
  if (at_end_of_line()) return {};
  poll();
  const char* const begin = token_ = cursor_;
  while (cursor_ != line_end_ &&
         (!may_end_token(*cursor_) || (*cursor_ == '\\' && !is_continuation(cursor_))))
    ++cursor_;
  return {begin, static_cast<std::size_t>(cursor_ - begin)};
}

std::string_view TextCursor::rest_of_line() {
  const char* begin = cursor_;
  const char* end = cursor_ = line_end_;
  while (begin != end && is_space(*begin)) ++begin;
  while (begin != end && is_space(end[-1])) --end;
  return {begin, static_cast<std::size_t>(end - begin)};
}

void TextCursor::go_to(std::size_t place) {
  has_jumped_ = true;
  line_begin_ = cursor_ = text_begin_ + place;
  line_end_ = end_of_line(cursor_);
}

bool TextCursor::try_number(double& value) {
  number_ = next_token();
  status_ = parse_number(number_, value_);
  value = value_;
  return status_ == NumberStatus::Good;
}

std::string TextCursor::number_problem(std::string_view what) const {
  if (number_.empty()) return fmt::format("{} is missing", what);
  return fmt::format("{} {} is not {}", what, in_quotes(number_),
                     status_ == NumberStatus::NotFinite ? "finite" : "a number");
}

double TextCursor::next_number(std::string_view what) {
  double value = 0;
  if (try_number(value)) return value;
  fail(number_problem(what) +
       (number_.empty() ? "; the file may be truncated" : "; correct the file"));
}

double decimal_rounding(std::string_view decimal, double nearest) {
  if (is_exact(decimal, nearest)) return 0;
  const double size = std::abs(nearest);
  return (std::nextafter(size, std::numeric_limits<double>::infinity()) - size) / 2;
}

long long TextCursor::next_integer(std::string_view what) {
  std::string_view token = next_token();
  if (token.empty()) fail(fmt::format("{} is missing; the file may be truncated", what));
  long long value = 0;
  const char* end = token.data() + token.size();
  const char* begin = token.data() + (token.size() > 1 && token[0] == '+' && token[1] != '-');
  const auto [stop, code] = std::from_chars(begin, end, value);
  if (code == std::errc::result_out_of_range) {
    fail(fmt::format("{} {} overflows 64 bits; correct the file", what, in_quotes(token)));
  }
  if (stop != end || code != std::errc()) {
    fail(fmt::format("{} {} is not an integer; correct the file", what, in_quotes(token)));
  }
  return value;
}

long long TextCursor::next_count(std::string_view what) {
  const long long value = next_integer(what);
  if (value < 0 || static_cast<unsigned long long>(value) > remaining())
    fail(fmt::format("{} is {}, more than the file has; it is damaged or truncated", what, value));
  return value;
}

void TextCursor::require_end_of_line() {
  if (at_end_of_line()) return;
  fail(fmt::format("{} is one entry too many on this line; correct the file",
                   in_quotes(next_token())));
}

void TextCursor::fail(std::string_view problem) const {
  if (line_ == 0 && !has_jumped_)
    throw Error(ErrorKind::Unreadable, fmt::format("{}: {}", file_, problem));
  const long line =
      has_jumped_ ? 1 + static_cast<long>(std::count(text_begin_, token_, '\n')) : line_;
  throw Error(ErrorKind::Unreadable, fmt::format("{}:{}: {}", file_, line, problem));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
