#include "majorant/io/internal/input_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "majorant/framework/error.h"
#include "majorant/io/internal/inflate.h"

namespace majorant {
namespace {

bool is_text_byte(char byte) {
  const unsigned char c = static_cast<unsigned char>(byte);
  return c >= 32 ? c != 127 : (c >= '\t' && c <= '\r');
}

std::string lower_extension(const std::filesystem::path& path) {
  std::string e = path.extension().string();
  std::transform(e.begin(), e.end(), e.begin(), [](unsigned char c) { return std::tolower(c); });
  return e;
}

std::size_t memory_bytes() {
  return static_cast<std::size_t>(::sysconf(_SC_PHYS_PAGES)) *
         static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

// Calls take(bytes) with the blocks of a file, in order.
template <class Take>
void for_each_block(const std::string& path, const StopCheck& stop, const Take& take) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    throw Error(ErrorKind::Unreadable, path + ": is a directory; name a file");
  }
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) {
    const char* reason = errno != 0 ? std::strerror(errno) : "cannot be opened";
    throw Error(ErrorKind::Unreadable, fmt::format("{}: {}; check the name", path, reason));
  }
  constexpr std::size_t kRead = std::size_t{1} << 16;
  std::string block(kRead, '\0');
  while (stream) {
    stop.poll();
    stream.read(block.data(), kRead);
    take(std::string_view(block).substr(0, static_cast<std::size_t>(stream.gcount())));
  }
  if (stream.bad()) {
    throw Error(ErrorKind::Unreadable, path + ": reading failed; check the disk");
  }
}

}  // namespace

bool is_compressed(const std::string& path) { return lower_extension(path) == ".gz"; }

std::string format_of(const std::string& path) {
  const std::filesystem::path name(path);
  return lower_extension(is_compressed(path) ? name.stem() : name);
}

std::string read_whole_file(const std::string& path, const StopCheck& stop) {
  std::string content;
  if (!is_compressed(path)) {
    std::error_code ignored;
    const auto size = std::filesystem::file_size(path, ignored);
    if (!ignored) content.reserve(size + 1);
    for_each_block(path, stop, [&](std::string_view block) { content += block; });
    return content;
  }
  GunzipStream stream(memory_bytes());
  for_each_block(path, stop, [&](std::string_view block) {
    if (!stream.append(block, content))
      throw Error(
          ErrorKind::Unreadable,
          path + ": damaged, or no gzip file; if it is not compressed, name it without .gz");
  });
  if (!stream.complete())
    throw Error(ErrorKind::Unreadable,
                path + ": the compressed data end too early; the file is truncated");
  return content;
}

void require_text(const std::string& path, std::string& content) {
  if (content.starts_with("\xEF\xBB\xBF")) content.erase(0, 3);
  const auto bad = std::find_if_not(content.begin(), content.end(), is_text_byte);
  if (bad != content.end()) {
    throw Error(ErrorKind::Unreadable,
                fmt::format("{}:{}: binary content (byte {}); this format is text, check that the "
                            "extension fits the file",
                            path, 1 + std::count(content.begin(), bad, '\n'),
                            static_cast<int>(static_cast<unsigned char>(*bad))));
  }
  char* data = content.data();
  const char* end = data + content.size();
  while ((data = static_cast<char*>(
              std::memchr(data, '\r', static_cast<std::size_t>(end - data)))) != nullptr) {
    if (data + 1 == end || data[1] != '\n') *data = '\n';
    ++data;
  }
}

std::string in_quotes(std::string_view piece) {
  constexpr std::size_t kLongest = 40;
  std::string result = "'";
  for (const char c : piece.substr(0, kLongest)) result += c >= 32 && c < 127 ? c : '?';
  result += piece.size() > kLongest ? "...'" : "'";
  return result;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
