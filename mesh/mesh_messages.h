// Words of messages about a mesh: of one that was read from a file by its name, with numbers from
// 1, as those who have files need it; of one that a program made from arrays without a name, with
// numbers from 0.
//
//   const std::string text = message_prefix(*mesh) + std::to_string(user_vertex(*mesh, 7));
#pragma once

#include <string>

#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// "mesh.obj: ", or nothing.
inline std::string message_prefix(const std::string& file) {
  return file.empty() ? "" : file + ": ";
}
inline std::string message_prefix(const SurfaceMesh& mesh) { return message_prefix(mesh.file()); }

// A number of the input, counted from 0.
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
