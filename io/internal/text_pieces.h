// Text of many lines, made in pieces on all threads and joined in order.
//
//   const std::vector<Vector2> points(100, Vector2(1, 2));
//   TextPieces pieces;
//   pieces.add("# points\n");
//   pieces.add_lines(100, [&](Index p, fmt::appender out) {
//     fmt::format_to(out, FMT_COMPILE("v {} {}\n"), points[p].x(), points[p].y());
//   });
//   write_file_atomically(path, pieces.take());
#pragma once

#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "majorant/framework/parallel.h"
#include "majorant/framework/types.h"

namespace majorant {

class TextPieces {
 public:
  void add(std::string_view text) { pieces_.emplace_back(text); }

  // Calls write(i, out), which appends the text of item i, for i = 0 to count - 1.
  template <class Write>
  void add_lines(Index count, const Write& write) {
    if (count == 0) return;
    const Index tasks = (count - 1) / kPiece + 1;
    const std::size_t before = pieces_.size();
    pieces_.resize(before + to_size(tasks));
    parallel_tasks(tasks, [&](Index task, int) {
      fmt::memory_buffer text;
      const Index last = task + 1 < tasks ? (task + 1) * kPiece : count;
      for (Index i = task * kPiece; i < last; ++i) write(i, fmt::appender(text));
      pieces_[before + to_size(task)].assign(text.data(), text.size());
    });
  }

  // Returns the whole text. Pieces are freed one by one, so that little of it is held twice.
  std::string take() {
    std::size_t size = 0;
    for (const std::string& piece : pieces_) size += piece.size();
    std::string text;
    text.reserve(size);
    for (std::string& piece : pieces_) text += std::exchange(piece, {});
    pieces_.clear();
    return text;
  }

 private:
  static constexpr Index kPiece = 2048;  // lines of a task, about 0.2 ms

  std::vector<std::string> pieces_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
