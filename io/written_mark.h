// The mark of mesh files that majorant writes. A later run replaces marked files without --force,
// and protects all others.
//
//     # majorant 0.1.0                                OBJ, MTL: the first line;
//                                                     MFEM, Medit: below the version
//     comment majorant 0.1.0                          PLY: below the format
//     $Comments, majorant 0.1.0, $EndComments         MSH: the section behind $MeshFormat
//     <!-- majorant 0.1.0 -->                         VTU, PVTU: above the root element
//     "asset": {"generator": "majorant 0.1.0"}        glTF; {"extras": {"majorant": "0.1.0"}} if
//                                                     another program is the generator
//
// A .vtu with the claims of a map (claims.h) needs no other mark.
//
//   std::string text = "ply\nformat ascii 1.0\n" + mark_text(mark_style(".ply"));
//   if (takes_mark("out.ply") && !has_mark("out.ply")) text.clear();
#pragma once

#include <string>
#include <string_view>

namespace majorant {

enum class MarkStyle;  // place and frame of the mark, see formats.h

// Returns "majorant 0.1.0".
std::string written_mark();
// Returns "0.1.0".
std::string written_version();
// Returns whether a text is the mark of any version.
bool is_written_mark(std::string_view text);
// Returns whether a text is the generator of a glTF by majorant; files without marks have
// "majorant".
bool is_written_generator(std::string_view generator);

// Returns the mark as it stands in a file, with the end of its line. Empty for None and for glTF.
std::string mark_text(MarkStyle style);

// Returns the content of a file with the mark in its place, replacing the mark of an earlier
// version. For content that was read from a file; other writers use mark_text().
std::string with_mark(MarkStyle style, std::string content);

// Returns the style of an extension (format_of()): that of its row in formats.h, or of .mtl.
MarkStyle mark_style(std::string_view extension);

// Returns whether majorant marks files of that name: meshes and maps, by the extension.
bool takes_mark(const std::string& path);

// Returns whether majorant wrote the file at `path`. Reads its first 64 kB, for glTF at most 16 MB
// of its JSON. False if it is no regular file, empty, or unreadable.
bool has_mark(const std::string& path);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
