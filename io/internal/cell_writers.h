// Writers of cells and polygons in particular formats, for the table (formats.h).
#pragma once

#include <string>
#include <vector>

#include "majorant/io/volume_files.h"
#include "majorant/mesh/polygon_mesh.h"

namespace majorant {

// Returns a mesh as a gmsh file, 4.1 as text by default. Throws Error(Unsupported) for nodes that
// are not on a lattice, and for tags that 2.2 cannot hold.
std::string gmsh_text(const VolumeMesh& mesh, const GmshChoice& choice);
// Returns the gmsh file of a mesh with its current points, in the chosen version and encoding.
// left_out: the parts that these cannot hold; may be null.
std::string gmsh_text_in_version(const VolumeMesh& mesh, const GmshChoice& choice,
                                 std::vector<std::string>* left_out);

// Returns a mesh as a VTK XML UnstructuredGrid.
std::string vtk_text(const VolumeMesh& mesh, const GmshChoice& choice);

// Returns positions and polygons, in binary; polygons have at most 255 corners.
std::string ply_text(const PolygonMesh& mesh);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
