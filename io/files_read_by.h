// Lists the files that a mesh file refers to, which a run must not replace.
//
//   for (const std::string& file : files_read_by("cup.obj"))   // cup.mtl, textures/wood.png
//     if (identify_file(file) == identify_file("out.png")) ...
#pragma once

#include <string>
#include <vector>

#include "majorant/framework/stop_check.h"

namespace majorant {

// Returns the existing files, each once, by paths from the current directory: material libraries of
// an OBJ and their images, buffers and images of glTF, pieces of a .pvtu. Other formats have none.
// If readers could interpret a name differently (blanks, backslashes, comments), all candidates are
// listed. Libraries outside of the folder of the mesh, which readers refuse, are not opened.
//
// Searches an OBJ for `mtllib` without parsing it; reads only the JSON of glTF. Throws Stopped.
// Missing and damaged files are skipped, since their reader reports the error. A path that is no
// regular file (a FIFO) can be read only once and is skipped.
std::vector<std::string> files_read_by(const std::string& path, const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
