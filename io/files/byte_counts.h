// The bytes that all files of this process have given and taken so far: what can be shown of
// reading and writing, which nobody else sees from outside.
//
//   const std::uint64_t before = byte_counts().read;
//   read_mesh(path);                                   // on another thread, say
//   std::cerr << bytes_text(byte_counts().read - before) << "\n";
//
// Counted where files are read (input_file.h), parsed (text_cursor.h and the binary readers) and
// written (atomic_file.h), an addition for thousands of bytes. They only grow, but to_parse.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

namespace majorant {

struct ByteCounts {
  std::atomic<std::uint64_t> to_read{0};  // sizes of the files that were opened; of a pipe, 0
  std::atomic<std::uint64_t> read{0};
  std::atomic<std::uint64_t> to_parse{0};  // decompressed
  std::atomic<std::uint64_t> parsed{0};
  std::atomic<std::uint64_t> written{0};
};

// From any thread.
ByteCounts& byte_counts() noexcept;

// Text or bytes in memory that somebody goes through. Small ones are not counted, copies of this
// (who looks ahead) neither; what is not gone through in the end is taken back.
class ParsedBytes {
 public:
  static constexpr std::size_t kLeast = std::size_t{1} << 18;  // a few milliseconds

  explicit ParsedBytes(std::size_t size) : size_(size < kLeast ? 0 : size) {
    byte_counts().to_parse += size_;
  }
  ParsedBytes(const ParsedBytes&) {}
  ParsedBytes& operator=(const ParsedBytes&) { return *this; }
  ParsedBytes(ParsedBytes&& other) noexcept
      : size_(std::exchange(other.size_, 0)), done_(other.done_.exchange(0)) {}
  ParsedBytes& operator=(ParsedBytes&&) = delete;
  ~ParsedBytes() { byte_counts().to_parse -= size_ - done_; }

  // This many of them are done: the more the later.
  void reach(std::size_t position) { add(std::min(position, size_) - done_); }
  // So many more are; from any thread.
  void add(std::size_t count) {
    if (size_ == 0) return;
    done_ += count;
    byte_counts().parsed += count;
  }

 private:
  std::size_t size_ = 0;
  std::atomic<std::size_t> done_{0};
};

// "512 bytes", "12.3 kB".
std::string bytes_text(std::uintmax_t bytes);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
