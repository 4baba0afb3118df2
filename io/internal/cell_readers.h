// Readers of cells in particular formats, for the table (formats.h). content: the whole file,
// decompressed.
#pragma once

#include <string>

#include "majorant/framework/stop_check.h"
#include "majorant/volumes/volume_mesh.h"

namespace majorant {

VolumeMesh read_gmsh_mesh(const std::string& path, std::string content, const StopCheck& stop);
VolumeMesh read_mfem_mesh(const std::string& path, std::string content, const StopCheck& stop);
VolumeMesh read_medit_mesh(const std::string& path, std::string content, const StopCheck& stop);
// Chooses the reader by the first word.
VolumeMesh read_mfem_or_medit_mesh(const std::string& path, std::string content,
                                   const StopCheck& stop);
VolumeMesh read_vtk_mesh(const std::string& path, std::string content, const StopCheck& stop);

// Does the same as read_volume_mesh(), for a file with this content.
VolumeMesh read_volume_content(const std::string& path, std::string content, const StopCheck& stop);

// Throws Error(Unsupported, "file: what").
[[noreturn]] void refuse_mesh(const std::string& path, const std::string& what);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
