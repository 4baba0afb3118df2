// The full result as a VTK XML UnstructuredGrid, lossless: read_vtu(write_vtu(map)) gives the same
// doubles. One VTK_BEZIER_TRIANGLE (type 76) per cell for degree >= 2, VTK_TRIANGLE (5) for 1.
//
//     Points               #N by 3 Float64  control points of the flat surface triangles
//     PointData uv         #N by 2 Float64  control points of the map
//     PointData input_vertex   #N Int32     vertex of the input mesh, -1 for none
//     PointData cone           #N Int32     quarter turns at cones, every copy; 0 (if present)
//     PointData seam           #N Int32     chain + 1 on seams, else 0 (with seam_edges)
//     CellData  input_face     #F Int32     face of the input mesh
//     CellData  distortion     #F Float64   mean density (if present)
//     CellData  min_det        #F Float64   certified lower bound of det J (if present)
//     CellData  sigma_1, sigma_2, area_distortion, angle_distortion, stretch_l2, stretch_linf
//                              #F Float64   measure_distortion.h (if present, all or none)
//     CellData  chart          #F Int32     piece of an atlas, from 0 (if present)
//     CellData  seam_edges  #F by 3 Int32   edges 01, 12, 20: chain + 1, 0 for none (if present)
//     FieldData majorant_claims  UInt8      JSON, what the file promises (if present)
//
// VTK derives the degree of a triangle from its number of points, so no HigherOrderDegrees are
// written. Arrays are inline base64, uncompressed, little endian, 64-bit headers: any XML parser
// reads them and no bit is lost. Empty optional arrays of the map are left out. Cones and seams
// are there for maps of cut surfaces (mesh/seams.h); `seam` only repeats `seam_edges` for
// viewers, where chains meet the one with the smallest number, and is not read.
#pragma once

#include <string>

#include "majorant/framework/stop_check.h"
#include "majorant/io/certification.h"

namespace majorant {

// Reads files of write_vtu and of other programs: formats ascii, binary and appended (raw or
// base64), uncompressed or compressed by zlib, one piece, uv with 2 or 3 components (the third is
// dropped), RationalWeights (the array of that name, or the one that PointData's attribute names)
// all equal, HigherOrderDegrees (likewise, of CellData) those of the cells. Values of Lagrange
// cells (types 69 and 22) become control points, uv_rounding says how exactly. Arrays that the file
// lacks stay empty; uv is required. Throws Error(Unreadable) with the reason for anything else:
// other compression, mixed cell types or sizes, inconsistent array sizes, point numbers out of
// range, values that are not finite; Stopped.
MapFile read_vtu(const std::string& path, const StopCheck& stop = {});

// What stands for a curved triangle: uv and Points are its control points, or its values at the
// points (i, j, k) / n (VTK_LAGRANGE_TRIANGLE, type 69). The latter are what most programs know,
// and round the map: it reads back as another one, some units in the last place away.
enum class VtuCells { Bezier, Lagrange };

// Throws Error(Invalid) if the map is inconsistent or not finite, Error(Unsupported) for Lagrange
// cells of degrees beyond 10, Error(Usage) if the file cannot be written, and what verify throws.
// The file appears whole or not at all.
void write_vtu(const std::string& path, const MapFile& map, VtuCells cells,
               const FileVerification& verify = {});
// Bezier triangles: lossless.
void write_vtu(const std::string& path, const MapFile& map, const FileVerification& verify = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
