#include "majorant/io/internal/input_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "majorant/framework/error.h"

namespace majorant {
namespace {

bool is_text_byte(char byte) {
  const unsigned char c = static_cast<unsigned char>(byte);
  return c >= 32 ? c != 127 : (c >= '\t' && c <= '\r');
}

}  // namespace

std::string read_whole_file(const std::string& path, const StopCheck& stop) {
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
  std::string content;
  const auto size = std::filesystem::file_size(path, ignored);
  if (!ignored) content.reserve(size + 1);
  constexpr std::size_t kBlock = std::size_t{1} << 20;
  while (stream) {
    stop.poll();
    const std::size_t old_size = content.size();
    content.resize(old_size + kBlock);
    stream.read(content.data() + old_size, kBlock);
    content.resize(old_size + static_cast<std::size_t>(stream.gcount()));
  }
  if (stream.bad()) {
    throw Error(ErrorKind::Unreadable, path + ": reading failed; check the disk");
  }
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
