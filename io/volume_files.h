// Reads and writes meshes of volumes: gmsh's .msh 2.2 and 4.1, text and binary, MFEM's .mesh v1.0,
// Medit's .mesh, VTK's .vtu.
//
//   VolumeMesh mesh = read_volume_mesh("part.msh");
//   mesh.points.row(0) *= 2;
//   write_volume_mesh("moved.msh", mesh);     // the same file, but for that point
//
// In the format that was read, what is written is the file with the moved coordinates in their
// places, and a line that names majorant as its writer: version, encoding, numbers, order, tags and
// sections that nothing is known of are those of the input, and what nobody moved comes back bit by
// bit. A .msh may be written in another version or encoding; every mesh whose nodes the format has
// a place for as .msh and .vtu.
//
// Not for surfaces and their maps: io/io.h.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/volumes/check_volume_mesh.h"
#include "majorant/volumes/volume_mesh.h"

namespace majorant {

// The format is known by the extension, .gz aside, and by what the file begins with. Throws
// Error(Unreadable) with the place; Error(Unsupported) for pyramids, degrees above 4, cells,
// versions and node sets that are not known, by name; Stopped.
VolumeMesh read_volume_mesh(const std::string& path, const StopCheck& stop = {});

enum class GmshVersion { Old, New };  // 2.2, 4.1
enum class GmshEncoding { Text, Binary };
// Form of a .msh to be written; what is not given is as in the .msh that was read, else 4.1, text.
struct GmshChoice {
  std::optional<GmshVersion> version;
  std::optional<GmshEncoding> encoding;
};

// Throws Error(Usage) where the mesh cannot be written under that name: for other extensions than
// that of its file, .msh and .vtu, for a choice where it is no .msh, and for nodes that the format
// has no cells for.
void require_volume_format(const std::string& path, const VolumeMesh& mesh,
                           const GmshChoice& choice = {});

// Returns the bytes of the mesh in a file of that name. left_out: what its own file has beside it.
// Throws as require_volume_format(), and Error(Unsupported) where a file of the same format has no
// place for a coordinate, or holds it compressed, and for tags that MSH 2.2 cannot hold.
std::string volume_mesh_content(const std::string& path, const VolumeMesh& mesh,
                                const GmshChoice& choice = {},
                                std::vector<std::string>* left_out = nullptr);
// The same, atomically, once the file was read back with the same points; verify may judge what was
// read. Throws Error(Invalid) for other points.
void write_volume_mesh(const std::string& path, const VolumeMesh& mesh,
                       const GmshChoice& choice = {}, std::vector<std::string>* left_out = nullptr,
                       const std::function<void(const VolumeMesh& written)>& verify = {});

// These cells of a mesh as a .vtu: each with all of its points, which none shares, CellData number,
// region, min_det_low, min_det_high, scaled_jacobian. Nodes on a lattice make quadratic and
// Lagrange cells, control points Bezier ones; of Gauss-Lobatto nodes the control points are
// written.
void write_cells_vtu(const std::string& path, const VolumeMesh& mesh,
                     const std::vector<const CheckedCell*>& cells);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
