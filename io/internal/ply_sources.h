// The numbers of a PLY file behind its header, one after the other: from text or from bytes. Both
// have the same members, for read_ply. All throw Error(Unreadable) naming the place.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

#include "majorant/framework/error.h"
#include "majorant/io/byte_cursor.h"
#include "majorant/io/internal/dropped_parts.h"
#include "majorant/io/internal/line_cursor.h"
#include "majorant/io/internal/ply_header.h"

namespace majorant {

// Numbers from a text line; a record is a line.
class AsciiPlySource {
 public:
  AsciiPlySource(const std::string& path, std::string_view text, long first_line)
      : cursor_(path, text, Continuation::None), first_line_(first_line), path_(path) {}

  void begin_record() {
    if (!cursor_.next_line()) fail("a record is missing; the file is truncated");
  }
  void end_record() {
    if (!cursor_.at_end_of_line()) fail("more numbers than the header declares; correct the file");
  }
  // NaN for what is no finite number.
  double next(PlyType) {
    if (cursor_.at_end_of_line()) fail("a number is missing; the file may be truncated");
    double value = 0.0;
    return cursor_.try_number(value) ? value : std::numeric_limits<double>::quiet_NaN();
  }
  void require_count(long long, std::size_t) {}  // a list ends with its line
  // One line more than the header announces is dropped.
  void finish(DroppedParts& dropped) {
    if (!cursor_.next_line()) return;
    LineCursor ahead = cursor_;
    if (ahead.next_line()) fail("content after the last record; correct the header's counts");
    dropped.add(DroppedPart::Line, [this] {
      return where("", place(0)) + ": one line more than the header announces";
    });
  }
  long place(long long) const { return first_line_ + cursor_.line(); }
  // A place of a record of this element, for messages.
  std::string where(std::string_view, long place) const {
    return fmt::format("{}:{}", path_, place);
  }
  [[noreturn]] void fail(std::string_view problem) const {
    throw Error(ErrorKind::Unreadable,
                fmt::format("{}:{}: {}", path_, first_line_ + cursor_.line(), problem));
  }

 private:
  LineCursor cursor_;
  long first_line_;
  const std::string& path_;
};

class BinaryPlySource {
 public:
  BinaryPlySource(const std::string& path, std::string_view bytes, ByteOrder order)
      : cursor_(path, bytes, order), path_(path) {}

  void begin_record() {}
  void end_record() {}
  double next(PlyType type) {
    switch (type) {
      case PlyType::Int8:
        return cursor_.next<signed char>();
      case PlyType::UInt8:
        return cursor_.next<unsigned char>();
      case PlyType::Int16:
        return cursor_.next<std::int16_t>();
      case PlyType::UInt16:
        return cursor_.next<std::uint16_t>();
      case PlyType::Int32:
        return cursor_.next<std::int32_t>();
      case PlyType::UInt32:
        return cursor_.next<std::uint32_t>();
      case PlyType::Float32:
        return static_cast<double>(cursor_.next<float>());
      case PlyType::Float64:
        break;
    }
    return cursor_.next<double>();
  }
  // That `count` pieces of at least `size` bytes can still follow.
  void require_count(long long count, std::size_t size) {
    if (static_cast<std::size_t>(count) > cursor_.remaining() / size) {
      fail(fmt::format("{} entries announced, {} bytes left; truncated", count,
                       cursor_.remaining()));
    }
  }
  void finish(DroppedParts&) {}  // padding after the last record is harmless
  long place(long long record) const { return static_cast<long>(record) + 1; }
  std::string where(std::string_view element, long place) const {
    return fmt::format("{}: {} {}", path_, element, place);
  }
  [[noreturn]] void fail(std::string_view problem) const {
    throw Error(ErrorKind::Unreadable, fmt::format("{}: {}", path_, problem));
  }

 private:
  ByteCursor cursor_;
  const std::string& path_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
