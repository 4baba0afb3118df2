// The mark of mesh files that majorant writes. A later run replaces a file that has it without
// being asked; files of others are theirs.
//
//     # majorant 0.1.0                                OBJ, MTL: the first line;
//                                                     MFEM, Medit: below the version
//     comment majorant 0.1.0                          PLY: below the format
//     $Comments, majorant 0.1.0, $EndComments         MSH: the section behind $MeshFormat
//     <!-- majorant 0.1.0 -->                         VTU, PVTU: above the root element
//     "asset": {"generator": "majorant 0.1.0"}        glTF; {"extras": {"majorant": "0.1.0"}} where
//                                                     another program is the generator
//
// The claims of a map (claims.h) are the mark of a .vtu that has them.
//
//   std::string text = "ply\nformat ascii 1.0\n" + mark_text(mark_style(".ply"));
//   if (takes_mark("out.ply") && !has_mark("out.ply")) text.clear();
#pragma once

#include <string>
#include <string_view>

namespace majorant {

enum class MarkStyle;  // the place and the frame of the mark: formats.h

// "majorant 0.1.0".
std::string written_mark();
// "0.1.0".
std::string written_version();
// Returns whether a text is the mark of any version.
bool is_written_mark(std::string_view text);
// The same of the generator of a glTF, which was "majorant" alone before there were marks.
bool is_written_generator(std::string_view generator);

// The mark as a file has it, with the end of its line. Empty for None and for glTF.
std::string mark_text(MarkStyle style);

// Returns the content of a file with the mark in its place, instead of that of an earlier version.
// For content that was read from a file; other writers use mark_text().
std::string with_mark(MarkStyle style, std::string content);

// The style of an extension (format_of()): that of its row in formats.h, and of .mtl.
MarkStyle mark_style(std::string_view extension);

// Returns whether files of that name have a mark when majorant writes them: meshes and maps, by the
// extension.
bool takes_mark(const std::string& path);

// Returns whether majorant wrote the file at `path`. Reads its first 64 kB, of glTF at most 16 MB
// of its JSON. False for what is no regular file, is empty, or cannot be read.
bool has_mark(const std::string& path);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
