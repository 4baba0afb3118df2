// Reads and writes volume meshes: gmsh's .msh 2.2 and 4.1, text and binary, MFEM's .mesh v1.0,
// Medit's .mesh, VTK's .vtu.
//
//   VolumeMesh mesh = read_volume_mesh("part.msh");
//   mesh.points.row(0) *= 2;
//   write_volume_mesh("moved.msh", mesh);     // the same file except for that point
//
// In its own format, a mesh is written as the file that was read, with new coordinates of moved
// points and a line that names majorant. Version, encoding, numbers, order, tags and unknown
// sections are those of the input, and points that did not move are identical. A .msh may be
// written in another version or encoding. Every mesh can be written as .msh and .vtu if the format
// has its nodes.
//
// Not for surfaces and their maps: see io/io.h.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/volumes/check_volume_mesh.h"
#include "majorant/volumes/volume_mesh.h"

namespace majorant {

// Reads a mesh whose format is known by the extension, without .gz, and by the beginning of the
// file. Throws Error(Unreadable) with the place; Error(Unsupported) for pyramids, degrees above 4,
// and unknown cells, versions and node sets, by name; Stopped.
VolumeMesh read_volume_mesh(const std::string& path, const StopCheck& stop = {});

enum class GmshVersion { Old, New };  // 2.2, 4.1
enum class GmshEncoding { Text, Binary };
// The form of a written .msh. Choices that are not given are those of the .msh that was read, else
// 4.1, text.
struct GmshChoice {
  std::optional<GmshVersion> version;
  std::optional<GmshEncoding> encoding;
};

// Throws Error(Usage) if the mesh cannot be written under that name: for extensions other than that
// of its file, .msh and .vtu, for a choice if it is no .msh, and for nodes that the format lacks.
void require_volume_format(const std::string& path, const VolumeMesh& mesh,
                           const GmshChoice& choice = {});

// Returns the bytes of the mesh in a file of that name. left_out: further contents of its own file.
// Throws the errors of require_volume_format(), and Error(Unsupported) if a file of the same format
// has no place for a coordinate or holds it compressed, and for tags that MSH 2.2 cannot hold.
std::string volume_mesh_content(const std::string& path, const VolumeMesh& mesh,
                                const GmshChoice& choice = {},
                                std::vector<std::string>* left_out = nullptr);
// Writes these bytes atomically, after the file was read back with the same points; verify may
// judge it. Throws Error(Invalid) for other points.
void write_volume_mesh(const std::string& path, const VolumeMesh& mesh,
                       const GmshChoice& choice = {}, std::vector<std::string>* left_out = nullptr,
                       const std::function<void(const VolumeMesh& written)>& verify = {});

// Writes these cells of a mesh as a .vtu. Each has its own points, and CellData number, region,
// min_det_low, min_det_high, scaled_jacobian. Lattice nodes make quadratic and Lagrange cells,
// control points Bezier cells; Gauss-Lobatto nodes are converted to control points.
void write_cells_vtu(const std::string& path, const VolumeMesh& mesh,
                     const std::vector<const CheckedCell*>& cells);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
