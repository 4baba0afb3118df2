// Weights of faces from a text file: numbers separated by space or line ends, `#` starts a comment.
#pragma once

#include <string>

#include "majorant/framework/types.h"

namespace majorant {

// face_count positive numbers, in the order of the mesh file's faces, each a usable weight
// (map_problem.h). Throws Error(Unreadable), naming the file and the line, for anything else.
Vec read_face_weights(const std::string& path, Index face_count);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
