// A map in pieces: a VTK XML PUnstructuredGrid (.pvtu) that names files of write_vtu, one for each
// part of the surface. What runs of several processes write, so that none of them holds the whole.
//
//     write_file_atomically("all.pvtu", pvtu_text(piece, {"all_0.vtu", "all_1.vtu"}));
//     const MapFile map = read_pvtu("all.pvtu");
//
// Pieces meet in points of the same vertices of the input mesh, with the same bits: nothing is
// welded by distance. Only maps of surfaces that are not cut: an input vertex is one point.
#pragma once

#include <string>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/maps/map_file.h"

namespace majorant {

// like: a map with the arrays that the pieces have. pieces: relative to the folder of the file.
std::string pvtu_text(const MapFile& like, const std::vector<std::string>& pieces);

// The pieces that a file names, as it names them. Throws Error(Unreadable).
std::vector<std::string> pvtu_pieces(const std::string& path, const StopCheck& stop = {});

// The whole map: points of the pieces one after the other, cells in the order of their input_face,
// claims of the first piece that has any; arrays that only some pieces have are left out. Throws
// Error(Unreadable) as read_vtu() for a piece that is missing or broken, for pieces of different
// degrees, and where points of one node differ; Stopped.
MapFile read_pvtu(const std::string& path, const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
