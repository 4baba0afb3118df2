// Decompression by zlib: gzip files in blocks, and zlib streams of known size.
//
//   std::string content;
//   GunzipStream stream(ReadingLimit("mesh.obj.gz"));
//   bool is_sound = stream.append("bytes of a .gz file", content);   // once for each block
//   is_sound = is_sound && stream.complete();
//
// Not for writing: outputs are never compressed.
#pragma once

#include <zlib.h>

#include <cstddef>
#include <string>
#include <string_view>

#include "majorant/io/files/reading_limit.h"

namespace majorant {

// Decompresses a gzip file as its bytes arrive. As in gunzip, several members are concatenated,
// zeros at the end are padding, and checksums are verified.
class GunzipStream {
 public:
  // limit: for the content; append() throws beyond it.
  explicit GunzipStream(ReadingLimit limit);
  GunzipStream(const GunzipStream&) = delete;
  GunzipStream& operator=(const GunzipStream&) = delete;
  ~GunzipStream();

  // Decompresses the next bytes of the file. Returns false if they are damaged or not gzip.
  bool append(std::string_view bytes, std::string& content);
  // Returns whether the file may end here, after a member.
  bool complete() const { return members_ > 0 && !in_member_; }

 private:
  bool append_member(std::string& content);
  void require_room(const std::string& content) const;

  z_stream stream_{};
  ReadingLimit limit_;
  std::size_t compressed_ = 0, unpacked_ = 0;  // bytes so far
  std::size_t members_ = 0;                    // completed members
  bool in_member_ = false;
};

// Returns whether the length of a zlib stream allows for `size` bytes.
bool can_stand_for(std::string_view stream, std::size_t size);
// Appends the `size` bytes of a zlib stream. Returns false if it is damaged or has another size.
bool append_inflated(std::string_view stream, std::size_t size, std::string& content);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
