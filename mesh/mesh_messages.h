// Parts of messages about a mesh. A mesh read from a file is named by the file, with numbers from
// 1; a mesh that a program made from arrays has no name, and numbers from 0.
//
//   const std::string text = message_prefix(*mesh) + std::to_string(user_vertex(*mesh, 7));
#pragma once

#include <string>

#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// Returns "mesh.obj: ", or "" without a file.
inline std::string message_prefix(const std::string& file) {
  return file.empty() ? "" : file + ": ";
}
inline std::string message_prefix(const SurfaceMesh& mesh) { return message_prefix(mesh.file()); }

// Returns a number of the input, given from 0, as messages show it.
inline Index shown_number(const std::string& file, Index number) {
  return file.empty() ? number : number + 1;
}
inline Index user_vertex(const SurfaceMesh& mesh, Index v) {
  return shown_number(mesh.file(), mesh.input_vertex(v));
}
inline Index user_face(const SurfaceMesh& mesh, Index f) {
  return shown_number(mesh.file(), mesh.input_face(f));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
