#include "majorant/io/files/inflate.h"

#include <limits>
#include <new>
#include <utility>

namespace majorant {
namespace {

constexpr int kGzip = 16 + MAX_WBITS;  // accept gzip headers only, windows of any size (zlib.h)
constexpr std::size_t kPiece = std::size_t{1} << 18;
// The largest number of bytes that one byte of a deflate stream can produce (zlib's technical
// details), plus the overhead of short streams.
constexpr std::size_t kLargestRatio = 1032, kOverhead = 64;

Bytef* bytes_of(const char* data) {  // zlib does not write to its input
  return reinterpret_cast<Bytef*>(const_cast<char*>(data));
}

}  // namespace

GunzipStream::GunzipStream(ReadingLimit limit) : limit_(std::move(limit)) {
  if (inflateInit2(&stream_, kGzip) != Z_OK) throw std::bad_alloc();
}

GunzipStream::~GunzipStream() { inflateEnd(&stream_); }

bool GunzipStream::append(std::string_view bytes, std::string& content) {
  constexpr std::size_t kMaximum = std::numeric_limits<uInt>::max();
  for (; bytes.size() > kMaximum; bytes.remove_prefix(kMaximum))
    if (!append(bytes.substr(0, kMaximum), content)) return false;
  compressed_ += bytes.size();
  stream_.next_in = bytes_of(bytes.data());
  stream_.avail_in = static_cast<uInt>(bytes.size());
  while (stream_.avail_in > 0) {
    if (!in_member_) {
      const bool is_padding = members_ > 0 && *stream_.next_in == 0;
      if (is_padding) {
        ++stream_.next_in;
        --stream_.avail_in;
        continue;
      }
      in_member_ = true;
    }
    if (!append_member(content)) return false;
  }
  return true;
}

// Requires memory for one more block. A growing string briefly holds its content twice.
void GunzipStream::require_room(const std::string& content) const {
  const std::size_t size = content.size() + kPiece;
  limit_.require_unpacked(unpacked_ + kPiece, compressed_);
  if (size > content.capacity()) limit_.require(size + content.size());
}

// Reads to the end of the input or of the member.
bool GunzipStream::append_member(std::string& content) {
  while (true) {
    const std::size_t size = content.size();
    require_room(content);
    content.resize(size + kPiece);
    stream_.next_out = bytes_of(content.data() + size);
    stream_.avail_out = kPiece;
    const int code = inflate(&stream_, Z_NO_FLUSH);
    content.resize(size + kPiece - stream_.avail_out);
    unpacked_ += kPiece - stream_.avail_out;
    if (code == Z_MEM_ERROR) throw std::bad_alloc();
    if (code == Z_STREAM_END) {
      in_member_ = false;
      ++members_;
      return inflateReset(&stream_) == Z_OK;
    }
    if (code == Z_BUF_ERROR || (code == Z_OK && stream_.avail_out > 0)) return true;
    if (code != Z_OK) return false;
  }
}

bool can_stand_for(std::string_view stream, std::size_t size) {
  return size <= kLargestRatio * stream.size() + kOverhead;
}

bool append_inflated(std::string_view stream, std::size_t size, std::string& content) {
  if (!can_stand_for(stream, size)) return false;
  const std::size_t before = content.size();
  content.resize(before + size);
  uLongf written = size;
  const int code = uncompress(bytes_of(content.data() + before), &written, bytes_of(stream.data()),
                              stream.size());
  if (code == Z_MEM_ERROR) throw std::bad_alloc();
  return code == Z_OK && written == size;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
