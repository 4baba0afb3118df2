// Reads numbers of a gmsh file, as words or bytes, sequentially or on all threads.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "majorant/framework/error.h"
#include "majorant/framework/parallel.h"
#include "majorant/io/byte_cursor.h"
#include "majorant/io/internal/cell_readers.h"
#include "majorant/io/internal/text_cursor.h"

namespace majorant {

// The numbers of a section, as words or bytes. In a piece of a file, places are offset by its
// beginning.
class GmshNumbers {
 public:
  GmshNumbers(const std::string& file, std::string_view text, const StopCheck& stop,
              std::size_t offset = 0)
      : file_(file),
        words_(file, text, TextLines::Space, stop, TextComments::None),
        stop_(stop),
        offset_(offset) {}

  TextCursor& words() {
    if (reads_bytes_) words_.go_to(at_);
    reads_bytes_ = false;
    return words_;
  }
  bool is_binary() const { return is_binary_; }
  ByteOrder order() const { return order_; }
  void begin_binary(ByteOrder order) {
    is_binary_ = true;
    order_ = order;
  }
  // Binary numbers begin after the line with the section's name.
  void begin_section() {
    if (!is_binary_) return;
    const std::size_t line_end = words().text().find('\n', words_.place());
    at_ = line_end == std::string_view::npos ? words_.text().size() : line_end + 1;
    reads_bytes_ = true;
  }

  std::int64_t small(std::string_view what) {  // reads an int
    return is_binary_ ? bytes<std::int32_t>() : words_.next_integer(what);
  }
  std::int64_t large(std::string_view what) {  // reads a size_t
    return is_binary_ ? static_cast<std::int64_t>(bytes<std::uint64_t>())
                      : words_.next_integer(what);
  }
  double real(std::string_view what) {
    if (!is_binary_) return words_.next_number(what);
    const auto x = bytes<double>();
    if (!std::isfinite(x)) fail(fmt::format("{} is not finite", what));
    return x;
  }
  PlacedCoordinates::Place last_place() const {
    const std::size_t begin = is_binary_ ? last_ : words_.begin();
    const std::size_t end = is_binary_ ? at_ : words_.place();
    return {offset_ + begin, static_cast<std::uint32_t>(end - begin)};
  }
  // Returns a count of things with at least `size` bytes or characters each.
  Index count(std::int64_t value, std::size_t size, std::string_view what) {
    const std::size_t left = reads_bytes_ ? words_.text().size() - at_ : words_.remaining();
    if (value < 0 || static_cast<std::uint64_t>(value) > left / size)
      fail(fmt::format("{} {}, more than the file has; it is damaged or truncated", value, what));
    if (value > std::numeric_limits<Index>::max() / 4)
      refuse_mesh(file_, fmt::format("{} {} are too many", value, what));
    return static_cast<Index>(value);
  }
  [[noreturn]] void fail(std::string_view problem) const {
    if (!reads_bytes_) words_.fail(problem);
    throw Error(ErrorKind::Unreadable, fmt::format("{}: byte {}: {}", file_, last_, problem));
  }

  const std::string& file() const { return file_; }
  const StopCheck& stop() const { return stop_; }

 private:
  template <class T>
  T bytes() {
    stop_.poll_at(reads_++);
    last_ = at_;
    if (words_.text().size() - at_ < sizeof(T))
      fail("the binary data end too early; the file is truncated");
    at_ += sizeof(T);
    return load_bytes<T>(words_.text().data() + last_, order_);
  }

  const std::string& file_;
  TextCursor words_;
  const StopCheck& stop_;
  std::size_t offset_;
  bool is_binary_ = false, reads_bytes_ = false;
  ByteOrder order_ = ByteOrder::Little;
  std::size_t at_ = 0, last_ = 0, reads_ = 0;  // of bytes
};

// Reads lines on all threads. Returns false if there is not one entry a line, or if a line is
// broken; sequential reading then reports the error.
template <class Read>
bool read_entries_in_pieces(GmshNumbers& in, Index count, const Read& read) {
  constexpr Index kPiece = 4096;  // lines of a task, about 0.5 ms
  if (count <= kPiece || in.is_binary()) return false;
  const std::string_view text = in.words().text();
  std::size_t end = text.find_first_not_of(" \t\r", in.words().place());
  if (end == std::string_view::npos || text[end] != '\n') return false;
  std::vector<std::size_t> begin{++end};  // of the pieces, then the end
  for (Index k = 0; k < count; ++k) {
    const std::size_t found = text.find('\n', end);
    if (found == std::string_view::npos) return false;
    end = found + 1;
    if ((k + 1) % kPiece == 0 || k + 1 == count) begin.push_back(end);
  }
  std::atomic<bool> is_other = false;
  parallel_tasks(static_cast<Index>(begin.size()) - 1, [&](Index task, int) {
    if (is_other) return;
    const std::size_t first = begin[to_size(task)], last = begin[to_size(task) + 1];
    GmshNumbers numbers(in.file(), text.substr(first, last - first), in.stop(), first);
    try {
      for (Index k = task * kPiece; k < std::min(count, (task + 1) * kPiece) && !is_other; ++k)
        read(numbers, k);
      if (!numbers.words().next_token().empty()) is_other = true;
    } catch (const Error&) {
      is_other = true;
    }
  });
  if (!is_other) in.words().go_to(end - 1);  // end of the last line
  return !is_other;
}

// Calls read(numbers, k) for entries 0 to count - 1, which follow each other.
template <class Read>
void read_entries(GmshNumbers& in, Index count, const Read& read) {
  if (ThreadCount::current() > 1 && read_entries_in_pieces(in, count, read)) return;
  for (Index k = 0; k < count; ++k) read(in, k);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
