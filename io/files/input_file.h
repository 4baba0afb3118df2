// Whole input files in memory: what every reader starts from.
//
//   std::string text = read_whole_file(path);   // any bytes; of mesh.obj.gz the mesh
//   require_text(path, text);                   // refuses binary content
//
// Meshes are parsed from memory (no streaming): that is what makes a million faces a matter of a
// second, and every reader can check the counts a header announces against the size.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "majorant/framework/error.h"
#include "majorant/framework/stop_check.h"

namespace majorant {

// Returns whether the name says that a file is compressed by gzip: .gz, in either case.
bool is_compressed(const std::string& path);
// The format that the name says: the extension in lower case, with the dot; .obj for mesh.OBJ.gz.
std::string format_of(const std::string& path);

// Refuses what cannot be read by a reader that goes by the extension: a name that is empty, of no
// file or of a directory, with Error(Unreadable), and one without an extension, with Error(kind).
// Other extensions are for the reader to refuse. formats: what it reads, ".obj, .off or .ply".
void require_format_name(const std::string& path, std::string_view formats,
                         ErrorKind kind = ErrorKind::Unreadable);

// All bytes of `path`, decompressed if its name says so. Throws Error(Unreadable) if it does not
// exist, is a directory, cannot be read or is no complete gzip file; Error(Unsupported) for more
// than a ReadingLimit allows; Stopped, also while a FIFO has no writer.
std::string read_whole_file(const std::string& path, const StopCheck& stop = {});

// Calls take(bytes) with the bytes of `path` block by block, decompressed if its name says so,
// until it returns false. Throws as read_whole_file(); a file that is not read to its end may be
// truncated.
void read_blocks(const std::string& path, const std::function<bool(std::string_view)>& take,
                 const StopCheck& stop = {});

// Refuses control bytes other than tab, line ends, vertical tab and form feed (binary content,
// UTF-16), removes a UTF-8 byte order mark and turns lone carriage returns (old Mac line ends)
// into line feeds. Bytes above 127 stay: names and comments may hold them.
// Throws Error(Unreadable) with the line of the first bad byte.
void require_text(const std::string& path, std::string& content);

// A piece of a file for a one-line message: in quotes, at most 40 characters, printable.
std::string in_quotes(std::string_view piece);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
