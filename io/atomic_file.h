// Writes output files that appear whole or not at all. Every writer of io/ uses this.
//
//   write_file_atomically("out.vtu", text, [&](const std::string& temporary) {
//     if (read_vtu(temporary).uv.rows() == 0) throw Error(ErrorKind::Invalid, "out.vtu: ...");
//   });
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "majorant/io/io.h"

namespace majorant {

class TemporaryFile;

// Writes `content` to a temporary file beside `path`, lets `verify` judge it, and renames it. A
// partial file is never visible, and a failure leaves an older file unchanged. A symbolic link
// stays: its target is written, and made if it does not exist. An older file's permissions are
// kept. A path that is no regular file (/dev/stdout, a FIFO, /dev/null) is written directly. Since
// it cannot be read back, `verify` first judges a file in $TMPDIR (or /tmp), which is then removed.
// Throws Error(Usage, "cannot write PATH: reason") and the errors of `verify`; no temporary file is
// left behind.
void write_file_atomically(const std::string& path, std::string_view content,
                           const FileVerification& verify = {});

// One of several files that appear together. The complete file waits under a temporary name until
// the others are complete, too.
//
//   PendingFile a("a.csv", "1,2"), b("b.csv", "3,4");   // throws: neither appears
//   a.take_place();
//   b.take_place();
//
// Throws the errors of write_file_atomically(), and Error(Usage) for a path that is no regular
// file.
class PendingFile {
 public:
  PendingFile(const std::string& path, std::string_view content,
              const FileVerification& verify = {});
  ~PendingFile();  // removes the file unless it has taken its place
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;

  void take_place();

 private:
  std::string path_, target_;  // the given path, and its target after links
  std::unique_ptr<TemporaryFile> file_;
};

// Tests before any work whether write_file_atomically(path, ...) can succeed, by making and
// removing a temporary file. Later only a full disk can prevent it. Throws Error(Usage) as above.
void require_writable_file(const std::string& path);

// An identity that all names of one file share: links, hard links, `./`.
struct FileIdentity {
  std::uint64_t device = 0, inode = 0;  // of the file, or of its folder if it does not exist yet
  std::string name;                     // in that folder; empty if the file exists

  bool operator==(const FileIdentity&) const = default;
};
// Returns nothing for a file in a folder that does not exist.
std::optional<FileIdentity> identify_file(const std::string& path);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
