// Writes a map in the format that the extension of the file names.
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

// Returns the extension in lower case, with the dot.
std::string extension(const std::string& path);

// Returns the row in the table of formats for this file; null if there is none.
const Format* written_format(const std::string& path);
// Return whether a format holds a map as data, and whether it does so without curves.
bool is_map_data(const std::string& path);
bool is_straight_map_data(const std::string& path);
bool is_gltf(const std::string& path);
bool is_shown_as(Format::Picture picture, const std::string& path);
// Returns whether materials are in files beside the mesh.
bool has_material_files(const std::string& path);

// Labels are compared in formats that say which vertices and faces of the input their own are.
ProofRequest::FaceLabels labels_in(const std::string& path);

// Returns the properties that data files of a map must have when they are read back: they map
// `surface`, with the cuts and the freedom from overlaps that this map has or claims. A map with
// other cuts than it claims is torn, and no file of it passes. Throws the errors of parse_claims()
// and MapProof.
ProofRequest proof_request(const MapFile& map, const PolygonMesh& surface, const std::string& name);
// In formats without curves, a globally injective map must stay so.
Overlap allowed_overlap(const ProofRequest& request);

// Options of particular formats.
struct MapFormats : MapFileOptions {
  SvgOptions svg;
  PngOptions png;
  bool view_is_chosen = false;  // for PNG; see first_view()
  MapPage page;                 // without its map
};

// Returns the certification() of the file that write_map() makes. request: what must be proven.
FileVerification proof_of_file(const std::string& path, const ProofRequest& request,
                               const MapFile& map, const MapFormats& formats);

// Returns the parts of the geometry that a data file of that name does not hold: "the surface",
// "curves, but straight pieces of them", and what materials of the input (may be null) lose.
std::vector<std::string> left_out(const std::string& path, const MapFile& map,
                                  const MapFormats& formats, const PolygonMesh* input);

// Returns the faces of the input with more than three corners that one of these files replaces by
// pieces. Only .obj and .ply keep polygons at all. input may be null.
std::vector<Index> split_faces(const std::vector<std::string>& paths, const MapFile& map,
                               const PolygonMesh* input, const MapFormats& formats);
// Returns "2 faces of the input are triangles in .obj and .ply (faces 7, 9)", numbers from 1.
std::string split_in_words(const std::vector<Index>& faces);

// Writes a map in the format of the extension; writes nothing for unknown extensions. input may be
// null. verify is called for formats that hold data, not for pictures. Returns words about a page
// that is coarser than the map (write_page_or_coarser); empty for others. Throws the errors of the
// writers.
std::string write_map(const std::string& path, const MapFile& map, const PolygonMesh* input,
                      const MapFormats& formats, const FileVerification& verify = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
