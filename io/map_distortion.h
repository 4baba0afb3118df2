// Distortion of the map that a file holds, and as a table.
//
//   MapFile file = read_map("bunny.vtu");
//   const MapDistortion measured = measure_distortion(file);
//   write_distortion("bunny_distortion.csv", file, measured.faces);
//
// What arrays of the file say of it is not looked at.
#pragma once

#include <string>

#include "majorant/parametrization/maps/map_file.h"

namespace majorant {

// In units of the surface (layout_scale()): of its cells on the flat triangles of their corners,
// whether they fit together or not. Throws Error(Unreadable) as layout_scale() does.
MapDistortion measure_distortion(const MapFile& file);

// The same where all numbers are finite, else none: what arrays of a .vtu can hold.
FaceDistortion finite_or_none(const FaceDistortion& faces);

// A line a cell, in the order of the file:
//     input_face,face,chart,sigma_1,sigma_2,area_distortion,angle_distortion,
//         stretch_l2,stretch_linf
// Numbers of faces and charts from 0; input_face is the polygon of the mesh (the cell itself where
// the file does not say), face the cell; chart is 0 where there are none. 17 digits, inf and nan
// where there is no number. faces: #F by 6. Throws Error(Usage) where it cannot be written.
void write_distortion(const std::string& path, const MapFile& file, const FaceDistortion& faces);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
