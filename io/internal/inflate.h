// Decompression by zlib: gzip files block by block, zlib streams of known size.
//
//   std::string content;
//   GunzipStream stream(std::size_t{1} << 20);
//   bool is_sound = stream.append("bytes of a .gz file", content);   // once for each block
//   is_sound = is_sound && stream.complete();
//
// Not for writing: outputs are not compressed.
#pragma once

#include <zlib.h>

#include <cstddef>
#include <string>
#include <string_view>

namespace majorant {

// What a gzip file says, as it comes in. Several members make one content, and zeros at the end are
// padding, as for gunzip; checksums are compared.
class GunzipStream {
 public:
  // most: bytes of content beyond which append throws std::bad_alloc: a few bytes may stand for
  // millions.
  explicit GunzipStream(std::size_t most);
  GunzipStream(const GunzipStream&) = delete;
  GunzipStream& operator=(const GunzipStream&) = delete;
  ~GunzipStream();

  // Appends what the next bytes of the file stand for; false if they are damaged or no gzip.
  bool append(std::string_view bytes, std::string& content);
  // Whether the file may end here: after a member.
  bool complete() const { return members_ > 0 && !in_member_; }

 private:
  bool append_member(std::string& content);

  z_stream stream_{};
  std::size_t most_;
  std::size_t members_ = 0;  // that have ended
  bool in_member_ = false;
};

// Appends the `size` bytes that a zlib stream stands for; false if it is damaged or of another
// size.
bool append_inflated(std::string_view stream, std::size_t size, std::string& content);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
