#include "majorant/io/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "majorant/framework/error.h"

namespace majorant {
namespace {

[[noreturn]] void fail(const std::string& path, int code) {
  throw Error(ErrorKind::Usage, fmt::format("cannot write {}: {}", path, std::strerror(code)));
}

// 0 or an error code.
int write_all(int descriptor, std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = ::write(descriptor, content.data(), content.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      return errno;
    }
    content.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

int write_and_close(int descriptor, std::string_view content) {
  if (descriptor < 0) return errno;
  const int written = write_all(descriptor, content);
  const int closed = ::close(descriptor) == 0 ? 0 : errno;
  return written != 0 ? written : closed;
}

// The standard streams by name: opening the name again would start at the beginning of a file that
// the shell appends to. -1 for other paths.
int standard_stream(const std::string& path) {
  if (path == "/dev/stdout" || path == "/dev/fd/1" || path == "/proc/self/fd/1") return 1;
  if (path == "/dev/stderr" || path == "/dev/fd/2" || path == "/proc/self/fd/2") return 2;
  return -1;
}

void replace_file(const std::string& path, const std::string& target, mode_t mode,
                  std::string_view content) {
  static std::atomic<unsigned> counter = 0;
  const std::string temporary = fmt::format("{}.{}.{}.tmp", target, ::getpid(), counter++);
  const int descriptor = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
  if (descriptor < 0) fail(path, errno);
  int code = write_and_close(descriptor, content);
  if (code == 0 && std::rename(temporary.c_str(), target.c_str()) != 0) code = errno;
  if (code == 0) return;
  ::unlink(temporary.c_str());
  fail(path, code);
}

}  // namespace

void write_file_atomically(const std::string& path, std::string_view content) {
  if (const int stream = standard_stream(path); stream >= 0) {
    if (const int code = write_all(stream, content); code != 0) fail(path, code);
    return;
  }
  struct stat status {};
  constexpr mode_t kNewFileMode = 0666;  // the umask takes its share
  if (::stat(path.c_str(), &status) != 0) {
    if (errno != ENOENT) fail(path, errno);
    replace_file(path, path, kNewFileMode, content);
    return;
  }
  if (!S_ISREG(status.st_mode)) {
    const int code = write_and_close(::open(path.c_str(), O_WRONLY | O_CLOEXEC), content);
    if (code != 0) fail(path, code);
    return;
  }
  if (::access(path.c_str(), W_OK) != 0) fail(path, errno);  // a protected file stays
  std::error_code unresolved;
  const std::string target = std::filesystem::canonical(path, unresolved).string();
  if (unresolved) fail(path, unresolved.value());
  replace_file(path, target, status.st_mode & 07777, content);
}

}  // namespace majorant
