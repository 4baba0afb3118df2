// A file that exists until it is complete: made beside its target, then renamed or removed.
//
//   TemporaryFile file("results", ".vtu", 0666);      // results/.majorant-PID-N.tmp.vtu, empty
//   if (int code = file.write_and_close(text)) ...    // 0 or errno
//   if (int code = file.rename_to("results/a.vtu")) ...   // else the destructor removes the file
//
// A program that a signal ends runs no destructors; its handler may call remove_temporary_files().
// Use write_file_atomically for files that outlive the process.
#pragma once

#include <sys/types.h>

#include <string>
#include <string_view>

namespace majorant {

class TemporaryFile {
 public:
  // Creates an empty file in `folder` (empty: the current one). The name has a fixed length, so
  // that it fits wherever a name does. It ends with `extension` (with the dot; left out if it is
  // longer than that of any format), because readers choose by it. mode: before the umask. Throws
  // std::system_error.
  TemporaryFile(const std::string& folder, const std::string& extension, mode_t mode);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::string& path() const { return path_; }
  // These return 0 or an error number. exact_mode: regardless of the umask.
  int set_exact_mode(mode_t exact_mode);
  int write_and_close(std::string_view content);
  int rename_to(const std::string& target);

 private:
  std::string path_;
  int descriptor_ = -1;  // -1: closed
  int slot_ = -1;        // in the registry of remove_temporary_files; -1: not registered
  bool exists_ = false;
};

// Removes all temporary files of this process. Async-signal-safe. Call it on the thread that makes
// the files; otherwise a file made meanwhile may stay.
void remove_temporary_files() noexcept;

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
