#include "majorant/io/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "majorant/framework/error.h"
#include "majorant/io/files/byte_counts.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/files/standard_stream.h"
#include "majorant/io/files/waiting_output.h"
#include "majorant/io/temporary_file.h"

namespace majorant {
namespace {

constexpr mode_t kNewFileMode = 0666;  // minus the umask
constexpr mode_t kPermissions = 07777;
constexpr mode_t kOwnerOnly = 0600;

[[noreturn]] void fail(const std::string& path, int code) {
  if (code == ETIMEDOUT)
    throw Error(ErrorKind::Usage,
                fmt::format("cannot write {}: nobody reads it, and the run is to end", path));
  throw Error(ErrorKind::Usage, fmt::format("cannot write {}: {}{}", path, std::strerror(code),
                                            code == EISDIR ? "; name a file in it" : ""));
}

// Returns the descriptor of a standard stream, by name; -1 for other paths. Opening the name again
// would write at the beginning of a file to which the shell appends.
int standard_stream(const std::string& path) {
  if (is_standard_output(path)) return 1;
  if (path == "/dev/stdout" || path == "/dev/fd/1" || path == "/proc/self/fd/1") return 1;
  if (path == "/dev/stderr" || path == "/dev/fd/2" || path == "/proc/self/fd/2") return 2;
  return -1;
}

std::string folder_of(const std::string& path) {
  return std::filesystem::path(path).parent_path().string();
}

std::string extension_of(const std::string& path) {
  return std::filesystem::path(path).extension().string();
}

// Returns the file that the last name of `path` leads to, even if it does not exist.
std::string follow_links(const std::string& path) {
  constexpr int kMaxLinks = 40;  // the kernel's limit
  std::filesystem::path target = path;
  std::error_code none;
  for (int links = 0; std::filesystem::is_symlink(target, none); ++links) {
    if (links == kMaxLinks) fail(path, ELOOP);
    const auto next = std::filesystem::read_symlink(target, none);
    if (none) fail(path, none.value());
    target = target.parent_path() / next;  // an absolute target replaces it
  }
  return target.string();
}

enum class TargetKind { Absent, Regular, Special };

struct Target {
  std::string path;  // after resolving links
  TargetKind kind;
  mode_t mode;
};

// Refuses targets that cannot be written.
Target find_target(const std::string& path) {
  if (path.find('\0') != std::string::npos)
    throw Error(ErrorKind::Usage,
                fmt::format("cannot write {}: no file name has a null character", in_quotes(path)));
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) {
    if (errno != ENOENT || path.empty()) fail(path, errno);
    return {follow_links(path), TargetKind::Absent, kNewFileMode};
  }
  if (S_ISDIR(status.st_mode)) fail(path, EISDIR);
  if (::access(path.c_str(), W_OK) != 0) fail(path, errno);  // a protected file is not replaced
  if (!S_ISREG(status.st_mode)) return {path, TargetKind::Special, 0};
  return {follow_links(path), TargetKind::Regular, status.st_mode & kPermissions};
}

void verify_elsewhere(const std::string& path, std::string_view content,
                      const FileVerification& verify) {
  const char* folder = std::getenv("TMPDIR");
  TemporaryFile file(folder && *folder ? folder : "/tmp", extension_of(path), kOwnerOnly);
  if (const int code = file.write_and_close(content); code != 0) fail(file.path(), code);
  verify(file.path());
}

void write_special(const std::string& path, std::string_view content) {
  const int descriptor = open_waiting(path);
  if (descriptor < 0) fail(path, errno);
  const int written = write_all(descriptor, content, &byte_counts().written);
  const int closed = ::close(descriptor) == 0 ? 0 : errno;
  if (written != 0 || closed != 0) fail(path, written != 0 ? written : closed);
}

}  // namespace

PendingFile::PendingFile(const std::string& path, std::string_view content,
                         const FileVerification& verify)
    : path_(path) {
  if (is_standard_output(path))
    throw Error(ErrorKind::Usage,
                fmt::format("cannot write {}: there are several files; give them a name", path));
  const Target target = find_target(path);
  if (target.kind == TargetKind::Special)
    throw Error(ErrorKind::Usage, fmt::format("cannot write {}: it is no regular file", path));
  target_ = target.path;
  try {
    file_ = std::make_unique<TemporaryFile>(folder_of(target_), extension_of(path), target.mode);
  } catch (const std::system_error& e) {
    fail(path, e.code().value());
  }
  if (target.kind == TargetKind::Regular)
    if (const int code = file_->set_exact_mode(target.mode); code != 0) fail(path, code);
  if (const int code = file_->write_and_close(content); code != 0) fail(path, code);
  if (verify) verify(file_->path());
}

PendingFile::~PendingFile() = default;

void PendingFile::take_place() {
  if (const int code = file_->rename_to(target_); code != 0) fail(path_, code);
}

void write_file_atomically(const std::string& path, std::string_view content,
                           const FileVerification& verify) {
  const int stream = standard_stream(path);
  if (stream < 0 && find_target(path).kind != TargetKind::Special)
    return PendingFile(path, content, verify).take_place();
  try {
    if (verify) verify_elsewhere(path, content, verify);
  } catch (const std::system_error& e) {
    fail(path, e.code().value());
  }
  if (stream < 0) return write_special(path, content);
  if (const int code = write_all(stream, content, &byte_counts().written); code != 0)
    fail(path, code);
}

void require_writable_file(const std::string& path) {
  if (standard_stream(path) >= 0) return;
  const Target target = find_target(path);
  if (target.kind == TargetKind::Special) return;
  std::error_code unknown;
  const std::string folder = folder_of(target.path);
  if (!folder.empty() && !std::filesystem::is_directory(folder, unknown))
    throw Error(ErrorKind::Usage,
                fmt::format("cannot write {}: the directory does not exist; create it", path));
  try {
    TemporaryFile(folder, extension_of(path), kOwnerOnly);
  } catch (const std::system_error& e) {
    fail(path, e.code().value());
  }
}

std::optional<FileIdentity> identify_file(const std::string& path) {
  if (is_standard_input(path) || is_standard_output(path)) return std::nullopt;
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0) return FileIdentity{status.st_dev, status.st_ino, ""};
  const std::filesystem::path target = follow_links(path);
  const std::filesystem::path folder = target.has_parent_path() ? target.parent_path() : ".";
  if (::stat(folder.c_str(), &status) != 0) return std::nullopt;
  return FileIdentity{status.st_dev, status.st_ino, target.filename().string()};
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
