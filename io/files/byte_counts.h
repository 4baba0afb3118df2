// Counts of the bytes that this process has read, parsed and written, for the display of progress.
//
//   const std::uint64_t before = byte_counts().read;
//   read_mesh(path);                                   // on another thread, say
//   std::cerr << bytes_text(byte_counts().read - before) << "\n";
//
// The counts are updated every few thousand bytes, when files are read (input_file.h), parsed
// (text_cursor.h and the binary readers) and written (atomic_file.h). They only grow, except for
// to_parse.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

namespace majorant {

struct ByteCounts {
  std::atomic<std::uint64_t> to_read{0};  // sizes of opened files; 0 for pipes
  std::atomic<std::uint64_t> read{0};
  std::atomic<std::uint64_t> to_parse{0};  // after decompression
  std::atomic<std::uint64_t> parsed{0};
  std::atomic<std::uint64_t> written{0};
};

// May be called from any thread.
ByteCounts& byte_counts() noexcept;

// Counts the parsing of text or bytes in memory. Texts below kLeast and copies of this object (for
// looking ahead) are not counted. The destructor subtracts the rest that was not parsed.
class ParsedBytes {
 public:
  static constexpr std::size_t kLeast = std::size_t{1} << 18;  // parsed in a few milliseconds

  explicit ParsedBytes(std::size_t size) : size_(size < kLeast ? 0 : size) {
    byte_counts().to_parse += size_;
  }
  ParsedBytes(const ParsedBytes&) {}
  ParsedBytes& operator=(const ParsedBytes&) { return *this; }
  ParsedBytes(ParsedBytes&& other) noexcept
      : size_(std::exchange(other.size_, 0)), done_(other.done_.exchange(0)) {}
  ParsedBytes& operator=(ParsedBytes&&) = delete;
  ~ParsedBytes() { byte_counts().to_parse -= size_ - done_; }

  // Reports that the first `position` bytes are parsed. Positions must not decrease.
  void reach(std::size_t position) { add(std::min(position, size_) - done_); }
  // Reports `count` more bytes. May be called from any thread.
  void add(std::size_t count) {
    if (size_ == 0) return;
    done_ += count;
    byte_counts().parsed += count;
  }

 private:
  std::size_t size_ = 0;
  std::atomic<std::size_t> done_{0};
};

// Formats a size: "512 bytes", "12.3 kB".
std::string bytes_text(std::uintmax_t bytes);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
