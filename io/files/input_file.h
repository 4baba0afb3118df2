// Reads whole input files into memory, for all readers.
//
//   std::string text = read_whole_file(path);   // any bytes; of mesh.obj.gz the mesh
//   require_text(path, text);                   // refuses binary content
//
// Meshes are parsed from memory, not streamed. This is fast, and readers can compare the counts of
// a header with the size of the file.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "majorant/framework/error.h"
#include "majorant/framework/stop_check.h"

namespace majorant {

// Returns whether the name ends in .gz, in either case.
bool is_compressed(const std::string& path);
// Returns the format by the name: the extension in lower case, with the dot; .obj for mesh.OBJ.gz.
std::string format_of(const std::string& path);

// Refuses names that give no format. Throws Error(Unreadable) for an empty name, a missing file and
// a directory, and Error(kind) for a name without an extension. Readers refuse unknown extensions
// themselves. formats: the extensions of the reader, ".obj, .off or .ply".
void require_format_name(const std::string& path, std::string_view formats,
                         ErrorKind kind = ErrorKind::Unreadable);

// Returns all bytes of `path`, decompressed if its name ends in .gz. Throws Error(Unreadable) if it
// does not exist, is a directory, cannot be read or is no complete gzip file; Error(Unsupported)
// for more than a ReadingLimit allows; Stopped, also while a FIFO has no writer.
std::string read_whole_file(const std::string& path, const StopCheck& stop = {});

// Calls take(bytes) with the blocks of `path`, decompressed if it ends in .gz, until it returns
// false. Throws the errors of read_whole_file(). If take stops early, truncation of the file is not
// detected.
void read_blocks(const std::string& path, const std::function<bool(std::string_view)>& take,
                 const StopCheck& stop = {});

// Refuses control bytes other than tab, line ends, vertical tab and form feed (binary content,
// UTF-16). Removes a UTF-8 byte order mark and replaces lone carriage returns (old Mac line ends)
// by line feeds. Bytes above 127 stay, for names and comments. Throws Error(Unreadable) with the
// line of the first bad byte.
void require_text(const std::string& path, std::string& content);

// Quotes a piece of a file for a message: at most 40 printable characters.
std::string in_quotes(std::string_view piece);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
