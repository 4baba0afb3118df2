// Limits the memory that a file may take to the free memory, and for compressed data to a multiple
// of their size. A few bytes can expand to millions, and the system kills a process that exceeds
// its memory without a message.
//
//   const ReadingLimit limit("mesh.obj.gz");
//   limit.require(text.size() + 65536);
//   limit.require_unpacked(text.size() + 65536, 1024);   // bytes, from 1024 compressed ones
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace majorant {

class ReadingLimit {
 public:
  // The largest number of bytes that one compressed byte may give, and an allowance on top. Deflate
  // reaches 1,032. Files of real programs stay below 100, except for arrays of zeros, which the
  // allowance covers.
  static constexpr std::size_t kMaxExpansion = 1000, kOnTop = std::size_t{64} << 20;

  // Takes the memory that is free now, or MAJORANT_READING_BYTES of the environment, for tests.
  explicit ReadingLimit(std::string file);

  // Both throw Error(Unsupported), which names the file. bytes: the total, with the bytes that are
  // already in memory.
  void require(std::size_t bytes) const;
  void require_unpacked(std::size_t bytes, std::size_t compressed) const;

 private:
  std::string file_;
  std::size_t free_;
};

// Returns the memory that files may take, as above; none if unknown.
std::optional<std::size_t> reading_memory();

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
