// The files that reading a mesh reads, or refers to, besides the mesh itself: what a run must not
// replace.
//
//   for (const std::string& file : files_read_by("cup.obj"))   // cup.mtl, textures/wood.png
//     if (identify_file(file) == identify_file("out.png")) ...
#pragma once

#include <string>
#include <vector>

#include "majorant/framework/stop_check.h"

namespace majorant {

// Returns those that exist, each once, as they can be opened from the current directory: of an OBJ
// its material libraries and the images that these name, of glTF buffers and images, of a .pvtu its
// pieces; none of other formats. Where readers take a name in different ways (blanks, backslashes,
// comments), every file that it can stand for. Libraries outside of the folder of the mesh, which
// readers refuse, are not opened.
//
// An OBJ is searched for `mtllib` without being parsed, of glTF the JSON alone is read. Throws
// Stopped; nothing for files that are missing or broken, of which the reader says so. What is no
// regular file (a FIFO) can be read but once, and is not.
std::vector<std::string> files_read_by(const std::string& path, const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
