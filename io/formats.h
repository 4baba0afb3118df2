// The table of file formats. Reading, writing, help texts, refusals and the table of docs/files.md
// all use its rows.
//
//   const Format* format = find_format(".msh");              // null: unknown
//   if (format && format->read_map) const MapFile map = format->read_map("part.msh", {});
//   in_words(extensions_for(FormatUse::ReadCells), "and");   // ".msh, .mesh and .vtu"
//
// A program adds its own format as one more row, before it reads or writes files. read_mesh(),
// read_map(), write_map(), the command and Python then accept the format:
//
//   add_format({.extension = ".tri",
//               .name = "lists of triangles",
//               .read_surface = [](const std::string& path, const StopCheck&, Strictness) {
//                 return read_mesh(path + ".obj");   // stands for a reader of one's own
//               }});
//
// Not for images, whose formats are in pictures/images/.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/io/io.h"
#include "majorant/io/volume_files.h"

namespace majorant {

// Options of particular map formats.
struct MapFileOptions {
  TessellationOptions tessellation;  // for formats without curves
  VtuCells vtu = VtuCells::Bezier;
  MshContent msh = MshContent::Image;
};

// The place and the frame of the mark that identifies files written by majorant.
enum class MarkStyle {
  None,
  FirstLine,      // after "# "
  BelowVersion,   // in line 2, below the version of MFEM and Medit
  PlyComment,     // below the format line
  GmshSection,    // $Comments
  XmlComment,     // above the root element
  GltfGenerator,  // asset.generator in the JSON
};

struct Format {
  std::string extension;   // lower case, with its dot
  std::string name;        // for the docs: "Gmsh"
  std::string kinds = {};  // versions of files with cells, for help texts: "2.2, 4.1"

  // Readers of the file at `path`; null if the format cannot hold this. They throw the errors of
  // read_mesh(), read_map() and read_volume_mesh(). Without read_map, the texture coordinates of a
  // surface are its map.
  PolygonMesh (*read_surface)(const std::string& path, const StopCheck&, Strictness) = nullptr;
  MapFile (*read_map)(const std::string& path, const StopCheck&) = nullptr;
  VolumeMesh (*read_cells)(const std::string& path, std::string content,
                           const StopCheck&) = nullptr;

  // Writers. write_map writes atomically and lets `verify` judge the file first; input may be null.
  // The others return the bytes of a file. cells_in_version returns the mesh's own file in another
  // version or encoding.
  void (*write_map)(const std::string& path, const MapFile& map, const PolygonMesh* input,
                    const MapFileOptions&, const FileVerification& verify) = nullptr;
  std::string (*polygons_text)(const PolygonMesh&) = nullptr;
  std::string (*cells_text)(const VolumeMesh&, const GmshChoice&) = nullptr;
  std::string (*cells_in_version)(const VolumeMesh&, const GmshChoice&,
                                  std::vector<std::string>* left_out) = nullptr;

  // Properties of the format.
  bool has_texcoords = false;       // surfaces have texture coordinates
  bool has_curves = false;          // maps keep curves; otherwise straight pieces are written
  bool has_labels = false;          // maps name the vertices and faces of their input
  bool has_claims = false;          // maps hold their claims, and so all of a result
  bool has_polygons = false;        // faces with more than three corners stay whole
  bool has_floats = false;          // coordinates are rounded to floats
  bool has_image_of_map = false;    // MshContent::Image holds no surface
  bool has_quads = false;           // meshes of quads are written
  bool has_objects = false;         // holds layouts of several objects, which may overlap
  bool has_control_points = false;  // curved cells are stored by control points
  bool has_pieces = false;          // names other files, whose pieces of a map are joined
  enum class Materials { None, InFilesBeside, Inside } materials = Materials::None;

  // A format that shows a map but does not hold it: pictures/ draws it.
  enum class Picture { None, Drawing, Image, Page } picture = Picture::None;

  MarkStyle mark = MarkStyle::None;
};

// Returns all rows, in the order of messages.
const std::vector<Format>& formats();

// Returns the row of an extension in the form of format_of(); null if it is unknown.
const Format* find_format(std::string_view extension);

// Adds a row. No other thread may read or write files meanwhile. Throws InvalidArgument for an
// extension that has a row, or is not in lower case with a dot.
void add_format(Format format);

enum class FormatUse {
  ReadSurface,
  ReadMap,        // map formats, without surfaces that have texture coordinates
  ReadTexcoords,  // surfaces that have texture coordinates
  ReadCells,
  WriteMap,  // as data
  WriteQuads,
  WriteCells,     // for any mesh; a mesh can also be written in the format of its own file
  WriteVersions,  // of these, formats with several versions and encodings
  Show,           // pictures and pages
};
bool serves(const Format& format, FormatUse use);
// Returns extensions in the order of the rows; map formats with claims come first.
std::vector<std::string> extensions_for(FormatUse use);
// Returns whether the format of a file name, without .gz, has this use.
bool is_for(FormatUse use, const std::string& path);

// Lists extensions: ".msh, .mesh and .vtu"; last: "and", "or".
std::string in_words(const std::vector<std::string>& extensions, std::string_view last);

// Writes a map in the format of the extension. Throws the errors of the writers in io.h, and
// Error(Usage) for formats that hold no maps.
void write_map_file(const std::string& path, const MapFile& map, const PolygonMesh* input,
                    const MapFileOptions& options = {}, const FileVerification& verify = {});

// Returns the table of the docs in Markdown.
std::string formats_in_markdown();

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
