// Output files appear whole or not at all. Every writer of io/ ends here.
#pragma once

#include <string>
#include <string_view>

namespace majorant {

// Writes `content` to a temporary file beside `path` and renames it, so that nobody sees half a
// file and a failure leaves an older file as it was. A symbolic link stays: its target is replaced.
// What is no regular file (/dev/stdout, a FIFO, /dev/null) is written directly.
// Throws Error(Usage, "cannot write PATH: reason"); no temporary file is left behind.
void write_file_atomically(const std::string& path, std::string_view content);

}  // namespace majorant
