// The limit of what a file may bring into memory: the memory that is free, and for compressed data
// a multiple of their bytes. A few bytes can stand for millions, and what the system takes back by
// killing the process has no message.
//
//   const ReadingLimit limit("mesh.obj.gz");
//   limit.require(text.size() + 65536);
//   limit.require_unpacked(text.size() + 65536, 1024);   // bytes, of that many compressed ones
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace majorant {

class ReadingLimit {
 public:
  // The largest number of bytes that a compressed one may stand for, and those on top. Deflate
  // makes at most 1,032 of one; files that programs write stay below 100, arrays of zeros apart,
  // which fit into what is on top.
  static constexpr std::size_t kMostOfAByte = 1000, kOnTop = std::size_t{64} << 20;

  // Asks what is free now. The environment's MAJORANT_READING_BYTES, for tests, replaces it.
  explicit ReadingLimit(std::string file);

  // Both throw Error(Unsupported), which names the file. bytes: all that it takes, what is held
  // already among them.
  void require(std::size_t bytes) const;
  void require_unpacked(std::size_t bytes, std::size_t compressed) const;

 private:
  std::string file_;
  std::size_t free_;
};

// The memory that the process may take for files, as above; none where nobody says.
std::optional<std::size_t> reading_memory();

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
