// Compressed files in the form of other programs.
#pragma once

#include <zlib.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "majorant/io/base64.h"

namespace majorant {

// Returns one gzip member.
inline std::string gzip_of(std::string_view content) {
  z_stream stream{};
  deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, 16 + MAX_WBITS, 9, Z_DEFAULT_STRATEGY);
  std::string out(deflateBound(&stream, content.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(content.data()));
  stream.avail_in = static_cast<uInt>(content.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

// Returns a file of write_vtu with its binary arrays compressed in blocks of `block` bytes, as by
// VTK.
inline std::string compressed_vtu(const std::string& text, std::size_t block) {
  std::string out = text;
  out.insert(out.find(" header_type"), " compressor=\"vtkZLibDataCompressor\"");
  const std::string mark = "format=\"binary\">\n";
  for (std::size_t at = out.find(mark); at != std::string::npos; at = out.find(mark, at)) {
    at += mark.size();
    const std::size_t end = out.find('\n', at);
    const std::string data = *decode_base64(out.substr(at, end - at));
    const std::string_view values = std::string_view(data).substr(8);
    std::vector<std::uint64_t> header = {0, block, values.size() % block};
    std::string blocks;
    for (std::size_t begin = 0; begin < values.size(); begin += block) {
      const std::string_view piece = values.substr(begin, block);
      uLongf size = compressBound(piece.size());
      std::string packed(size, '\0');
      compress(reinterpret_cast<Bytef*>(packed.data()), &size,
               reinterpret_cast<const Bytef*>(piece.data()), piece.size());
      header.push_back(size);
      blocks += packed.substr(0, size);
      ++header[0];
    }
    std::string encoded;
    append_base64({reinterpret_cast<const char*>(header.data()), 8 * header.size()}, encoded);
    append_base64(blocks, encoded);
    out.replace(at, end - at, encoded);
  }
  return out;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
