// Reads and writes meshes of volumes: gmsh's .msh 2.2 and 4.1, text and binary, MFEM's .mesh v1.0,
// Medit's .mesh, VTK's .vtu.
//
//   VolumeMesh mesh = read_volume_mesh("part.msh");
//   mesh.points.row(0) *= 2;
//   write_volume_mesh("moved.msh", mesh);     // the same file, but for that point
//
// What is written is the file that was read with the moved coordinates in their places, so version,
// encoding, numbers, order and tags are those of the input, and what nobody moved comes back bit by
// bit. A .msh may be written in another version or encoding; to write a mesh in another format is
// not for these functions.
#pragma once

#include <string>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/io/atomic_file.h"
#include "majorant/volumes/check_volume_mesh.h"
#include "majorant/volumes/volume_mesh.h"

namespace majorant {

// By the extension, .gz aside, and what the file begins with. Throws Error(Unreadable) with the
// place; Error(Unsupported) for pyramids, degrees above 4, cells, versions and node sets that are
// not known, by name; Stopped.
VolumeMesh read_volume_mesh(const std::string& path, const StopCheck& stop = {});

// The text or bytes of the mesh's file with its points; of a mesh that no file was read for, that
// of a .msh 4.1. Throws Error(Unsupported) where the file has no place for a coordinate, or holds
// it compressed.
std::string volume_mesh_content(const VolumeMesh& mesh);
// The same, atomically; verify judges the file before it takes its name.
void write_volume_mesh(const std::string& path, const VolumeMesh& mesh,
                       const FileVerification& verify = {});

enum class GmshVersion { Old, New };  // 2.2, 4.1
enum class GmshEncoding { Text, Binary };
struct GmshFormat {
  GmshVersion version;
  GmshEncoding encoding;
  bool operator==(const GmshFormat&) const = default;
};
// Of the mesh's file; 4.1, text where there is none. Throws Error(Unsupported) unless it is a .msh.
GmshFormat gmsh_format_of(const VolumeMesh& mesh);
// The mesh as a .msh of that version and encoding: nodes and elements in their order, with their
// tags, entities and physical groups. Where it is the format of the file, as volume_mesh_content().
// left_out: sections and groups that have no place there. Throws as gmsh_format_of(), and for
// meshes without a file whose nodes are not those of a lattice.
std::string gmsh_mesh_content(const VolumeMesh& mesh, const GmshFormat& format,
                              std::vector<std::string>* left_out = nullptr);

// These cells of a mesh as a .vtu: each with all of its points, which none shares, CellData number,
// region, min_det_low, min_det_high, scaled_jacobian. Nodes on a lattice make Lagrange cells,
// control points Bezier ones; of Gauss-Lobatto nodes the control points are written.
void write_cells_vtu(const std::string& path, const VolumeMesh& mesh,
                     const std::vector<const CheckedCell*>& cells);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
