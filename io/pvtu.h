// A distributed map: a VTK XML PUnstructuredGrid (.pvtu) that names a file of write_vtu for each
// part of the surface. Runs on several processes write it, so that no process holds the whole map.
//
//     write_file_atomically("all.pvtu", pvtu_text(piece, {"all_0.vtu", "all_1.vtu"}));
//     const MapFile map = read_pvtu("all.pvtu");
//
// Pieces meet in points of the same vertices of the input mesh, with the same bits; nothing is
// welded by distance. Only for maps of uncut surfaces, where an input vertex is one point.
#pragma once

#include <string>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/maps/map_file.h"

namespace majorant {

// like: a map with the arrays of the pieces. pieces: relative to the folder of the file.
std::string pvtu_text(const MapFile& like, const std::vector<std::string>& pieces);

// Returns the pieces as the file names them. Throws Error(Unreadable).
std::vector<std::string> pvtu_pieces(const std::string& path, const StopCheck& stop = {});

// Reads the whole map: points piece by piece, cells in the order of their input_face, claims of the
// first piece with claims. Arrays that only some pieces have are left out. Throws the
// Error(Unreadable) of read_vtu() for missing and broken pieces, for pieces of different degrees,
// and if points of one node differ; Stopped.
MapFile read_pvtu(const std::string& path, const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
