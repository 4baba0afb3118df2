// The `mtllib` lines of an OBJ that is written into another folder than it was read from.
#pragma once

#include <string>
#include <vector>

namespace majorant {

// The files that what follows `mtllib` names, for an OBJ in this folder. Names may have blanks, and
// there may be several: a name is as long as files of the folder are called so, else up to a word
// that ends with .mtl.
std::vector<std::string> split_material_names(const std::string& names, const std::string& folder);

// `line`, an `mtllib` line of the OBJ file `from`, for the OBJ file `to`: relative names lead to
// the same files. Unchanged where both are in one folder. Names with blanks get a line of their
// own, since readers take the whole line for one name, or divide it.
std::string repoint_materials(const std::string& line, const std::string& from,
                              const std::string& to);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
