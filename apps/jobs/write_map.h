// A map as a file of any format, which the extension names.
//
//   MapFormats formats;
//   formats.tessellation.refine = 2;
//   write_map("bunny.obj", file, &polygons, formats,
//             proof_of_file("bunny.obj", {}, file, formats));
#pragma once

#include <string>
#include <vector>

#include "majorant/certify/map_proof.h"
#include "majorant/io/formats.h"
#include "majorant/maps/map_file.h"
#include "majorant/mesh/polygon_mesh.h"
#include "majorant/pictures/pictures.h"

namespace majorant {

// Lower case, with the dot.
std::string extension(const std::string& path);

// The row of the table of formats that a file is written by; null: none.
const Format* written_format(const std::string& path);
// The formats that hold a map as data, and of these those without curves.
bool is_map_data(const std::string& path);
bool is_straight_map_data(const std::string& path);
bool is_gltf(const std::string& path);
bool is_shown_as(Format::Picture picture, const std::string& path);
// Returns whether materials are in files beside the mesh.
bool has_material_files(const std::string& path);

// Compared for formats that say which vertices and faces of the input their own are.
ProofRequest::FaceLabels labels_in(const std::string& path);

// The properties that data files made from a map must have when they are read back: maps of
// `surface`, as cut and as free of overlaps as this one is or claims to be. One that is cut
// elsewhere than it claims is torn: no file of it will do. Throws Error as parse_claims() and
// MapProof.
ProofRequest promise_of(const MapFile& map, const PolygonMesh& surface, const std::string& name);
// In formats without curves, a map that is injective as a whole stays so.
Overlap allowed_overlap(const ProofRequest& promise);

// Options of single formats.
struct MapFormats : MapFileOptions {
  SvgOptions svg;
  PngOptions png;
  bool view_is_chosen = false;  // of PNG: first_view()
  MapPage page;                 // but for its map
};

// certification() of what write_map() makes of the map. promise: of the map, on its surface.
FileVerification proof_of_file(const std::string& path, const ProofRequest& promise,
                               const MapFile& map, const MapFormats& formats);

// The parts of the geometry that a data file of that name does not hold: "the surface", "curves,
// but straight pieces of them", and what materials of the input (or null) lose.
std::vector<std::string> left_out(const std::string& path, const MapFile& map,
                                  const MapFormats& formats, const PolygonMesh* input);

// The faces of the input of more than three corners that some file of these names has pieces in
// place of: .obj and .ply keep polygons, other formats have none. input may be null.
std::vector<Index> split_faces(const std::vector<std::string>& paths, const MapFile& map,
                               const PolygonMesh* input, const MapFormats& formats);
// "2 faces of the input are triangles in .obj and .ply (faces 7, 9)", numbers from 1.
std::string split_in_words(const std::vector<Index>& faces);

// Writes a map in the format of the extension, which holds or shows maps; writes nothing for other
// extensions. input may be null. verify is called for formats that hold data, not for pictures.
// Throws as the writers do.
void write_map(const std::string& path, const MapFile& map, const PolygonMesh* input,
               const MapFormats& formats, const FileVerification& verify = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
