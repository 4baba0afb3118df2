// Decompression by zlib: gzip files block by block, zlib streams of known size.
//
//   std::string content;
//   GunzipStream stream(ReadingLimit("mesh.obj.gz"));
//   bool is_sound = stream.append("bytes of a .gz file", content);   // once for each block
//   is_sound = is_sound && stream.complete();
//
// Not for writing: outputs are not compressed.
#pragma once

#include <zlib.h>

#include <cstddef>
#include <string>
#include <string_view>

#include "majorant/io/files/reading_limit.h"

namespace majorant {

// The content of a gzip file, as it comes in. Several members make one content, and zeros at the
// end are padding, as for gunzip; checksums are compared.
class GunzipStream {
 public:
  // limit: of content, what append throws beyond it.
  explicit GunzipStream(ReadingLimit limit);
  GunzipStream(const GunzipStream&) = delete;
  GunzipStream& operator=(const GunzipStream&) = delete;
  ~GunzipStream();

  // Appends what the next bytes of the file stand for; false if they are damaged or no gzip.
  bool append(std::string_view bytes, std::string& content);
  // Returns whether the file may end here: after a member.
  bool complete() const { return members_ > 0 && !in_member_; }

 private:
  bool append_member(std::string& content);
  void require_room(const std::string& content) const;

  z_stream stream_{};
  ReadingLimit limit_;
  std::size_t compressed_ = 0, unpacked_ = 0;  // bytes until now
  std::size_t members_ = 0;                    // that have ended
  bool in_member_ = false;
};

// Returns whether a zlib stream may be that of so many bytes: by its length alone.
bool can_stand_for(std::string_view stream, std::size_t size);
// Appends the `size` bytes that a zlib stream stands for; false if it is damaged or of another
// size.
bool append_inflated(std::string_view stream, std::size_t size, std::string& content);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
