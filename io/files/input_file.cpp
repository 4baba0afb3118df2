#include "majorant/io/files/input_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>

#include "majorant/framework/error.h"
#include "majorant/io/files/byte_counts.h"
#include "majorant/io/files/inflate.h"
#include "majorant/io/files/reading_limit.h"
#include "majorant/io/files/standard_stream.h"
#include "majorant/io/files/waiting_output.h"

namespace majorant {
namespace {

bool is_text_byte(char byte) {
  const unsigned char c = static_cast<unsigned char>(byte);
  return (c >= 32 && c != 127) || (c >= '\t' && c <= '\r');
}

// Returns the position of the first binary byte, or the size of the text. Blocks without branches
// are fast.
std::size_t first_binary_byte(std::string_view text) {
  constexpr std::size_t kBlock = 1024;
  for (std::size_t first = 0; first < text.size(); first += kBlock) {
    const std::string_view block = text.substr(first, kBlock);
    std::uint8_t is_bad = 0;
    for (const char c : block) is_bad |= static_cast<std::uint8_t>(!is_text_byte(c));
    if (is_bad != 0)
      return first +
             static_cast<std::size_t>(std::find_if_not(block.begin(), block.end(), is_text_byte) -
                                      block.begin());
  }
  return text.size();
}

std::string lower_extension(const std::filesystem::path& path) {
  std::string e = path.extension().string();
  std::transform(e.begin(), e.end(), e.begin(), [](unsigned char c) { return std::tolower(c); });
  return e;
}

[[noreturn]] void refuse_input(const std::string& path, const std::string& what,
                               ErrorKind kind = ErrorKind::Unreadable) {
  throw Error(kind, fmt::format("{}: {}", path, what));
}

[[noreturn]] void refuse_by_errno(const std::string& path, const char* remedy) {
  refuse_input(path, fmt::format("{}; {}", std::strerror(errno), remedy));
}

void require_possible_name(const std::string& path) {
  if (path.empty()) refuse_input("''", "no file has an empty name; name a file");
  if (path.find('\0') != std::string::npos)
    refuse_input(in_quotes(path), "no file name has a null character");
}

void require_no_directory(const std::string& path, const struct stat& status) {
  if (S_ISDIR(status.st_mode)) refuse_input(path, "is a directory; name a file");
}

constexpr const char* kOtherName = "check the name";  // the remedy for a missing file

// A file opened for reading.
class InputFile {
 public:
  explicit InputFile(const std::string& path) : path_(path) {
    require_possible_name(path);
    // O_NONBLOCK: a FIFO may never get a writer.
    descriptor_ = is_standard_input(path)
                      ? ::fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 0)
                      : ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
    struct stat status {};
    if (descriptor_ < 0 || ::fstat(descriptor_, &status) != 0) refuse_by_errno(path, kOtherName);
    require_no_directory(path, status);
    may_wait_ = !S_ISREG(status.st_mode);
    if (!may_wait_) size_ = static_cast<std::size_t>(status.st_size);
    byte_counts().to_read += size_;
  }
  ~InputFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  std::size_t size() const { return size_; }  // 0: unknown

  // Calls take(bytes) with the blocks of the file, in order, until it returns false. Returns true
  // if take() accepted all blocks.
  template <class Take>
  bool for_each_block(const StopCheck& stop, const Take& take) const {
    constexpr std::size_t kRead = std::size_t{1} << 16;
    std::string block(kRead, '\0');
    for (;;) {
      stop.poll();
      pollfd ready{descriptor_, POLLIN, 0};
      if (may_wait_ && ::poll(&ready, 1, kWaitMilliseconds) <= 0) continue;
      const ssize_t count = ::read(descriptor_, block.data(), block.size());
      if (count == 0) return true;
      if (count > 0) byte_counts().read += static_cast<std::size_t>(count);
      if (count > 0 && !take(std::string_view(block).substr(0, static_cast<std::size_t>(count))))
        return false;
      if (count < 0 && errno != EINTR && errno != EAGAIN) refuse_by_errno(path_, "check the disk");
    }
  }

 private:
  const std::string& path_;
  int descriptor_ = -1;
  bool may_wait_ = false;
  std::size_t size_ = 0;
};

// Appends the decompressed blocks of a gzip file to `content`, and calls added() after each until
// it returns false.
template <class Added>
void inflate_blocks(const std::string& path, const InputFile& file, const ReadingLimit& limit,
                    const StopCheck& stop, std::string& content, const Added& added) {
  constexpr std::size_t kCompressedPiece =
      1024;  // compressed bytes, each of which gives at most about 1,000 bytes
  GunzipStream stream(limit);
  const bool is_whole = file.for_each_block(stop, [&](std::string_view block) {
    for (; !block.empty(); block.remove_prefix(std::min(kCompressedPiece, block.size()))) {
      if (!stream.append(block.substr(0, kCompressedPiece), content))
        throw Error(
            ErrorKind::Unreadable,
            path + ": damaged, or no gzip file; if it is not compressed, name it without .gz");
      if (!added()) return false;
    }
    return true;
  });
  if (is_whole && !stream.complete())
    throw Error(ErrorKind::Unreadable,
                path + ": the compressed data end too early; the file is truncated");
}

}  // namespace

bool is_compressed(const std::string& path) { return lower_extension(path) == ".gz"; }

std::string format_of(const std::string& path) {
  const std::filesystem::path name(path);
  return lower_extension(is_compressed(path) ? name.stem() : name);
}

void require_format_name(const std::string& path, std::string_view formats, ErrorKind kind) {
  require_possible_name(path);
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) refuse_by_errno(path, kOtherName);
  require_no_directory(path, status);
  if (!format_of(path).empty()) return;
  refuse_input(
      path,
      fmt::format("the name has no extension{}, which says the format; rename the file to end "
                  "in {}",
                  is_compressed(path) ? " before .gz" : "", formats),
      kind);
}

std::string read_whole_file(const std::string& path, const StopCheck& stop) {
  std::string content;
  const InputFile file(path);
  const ReadingLimit limit(path);
  if (is_compressed(path)) {
    inflate_blocks(path, file, limit, stop, content, [] { return true; });
    return content;
  }
  limit.require(file.size());
  content.reserve(file.size() + 1);
  file.for_each_block(stop, [&](std::string_view block) {
    const std::size_t size = content.size() + block.size();
    // A growing string briefly holds its content twice.
    if (size > content.capacity()) limit.require(size + content.size());
    content += block;
    return true;
  });
  return content;
}

void read_blocks(const std::string& path, const std::function<bool(std::string_view)>& take,
                 const StopCheck& stop) {
  const InputFile file(path);
  if (!is_compressed(path)) {
    file.for_each_block(stop, take);
    return;
  }
  std::string content;
  inflate_blocks(path, file, ReadingLimit(path), stop, content, [&] {
    const bool goes_on = take(content);
    content.clear();
    return goes_on;
  });
}

void require_text(const std::string& path, std::string& content) {
  if (content.starts_with("\xEF\xBB\xBF")) content.erase(0, 3);
  if (const std::size_t place = first_binary_byte(content); place < content.size()) {
    const auto bad = content.begin() + static_cast<std::ptrdiff_t>(place);
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
