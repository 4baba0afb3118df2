// The writers of cells and polygons of single formats, for the table (formats.h).
#pragma once

#include <string>
#include <vector>

#include "majorant/io/volume_files.h"
#include "majorant/mesh/polygon_mesh.h"

namespace majorant {

// A mesh as a file of gmsh, 4.1 as text unless the choice says otherwise. Throws Error(Unsupported)
// for nodes that are not those of a lattice, and tags that 2.2 cannot hold.
std::string gmsh_text(const VolumeMesh& mesh, const GmshChoice& choice);
// The file of gmsh's that a mesh was read from, with its points, in the version and encoding that
// are chosen. left_out: what these have no place for; may be null.
std::string gmsh_text_in_version(const VolumeMesh& mesh, const GmshChoice& choice,
                                 std::vector<std::string>* left_out);

// A mesh as a VTK XML UnstructuredGrid.
std::string vtk_text(const VolumeMesh& mesh, const GmshChoice& choice);

// Positions and polygons of at most 255 corners alone, binary.
std::string ply_text(const PolygonMesh& mesh);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
