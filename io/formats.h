// The table of file formats: what reads, writes, offers and refuses files by their extension, and
// the table of docs/files.md, come from its rows.
//
//   const Format* format = find_format(".msh");              // null: nobody's
//   if (format && format->read_map) const MapFile map = format->read_map("part.msh", {});
//   in_words(extensions_for(FormatUse::ReadCells), "and");   // ".msh, .mesh and .vtu"
//
// A program's own format is one row more, before the first file is read or written; read_mesh(),
// read_map(), write_map(), the command and Python then take it as any other:
//
//   add_format({.extension = ".tri",
//               .name = "lists of triangles",
//               .read_surface = [](const std::string& path, const StopCheck&, Strictness) {
//                 return read_mesh(path + ".obj");   // stands for a reader of one's own
//               }});
//
// Not for images as numbers, whose formats are in pictures/images/.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/io/io.h"
#include "majorant/io/volume_files.h"

namespace majorant {

// Options of single formats that hold maps.
struct MapFileOptions {
  TessellationOptions tessellation;  // of formats without curves
  VtuCells vtu = VtuCells::Bezier;
  MshContent msh = MshContent::Image;
};

// The place and the frame of the mark by which majorant knows files of its own.
enum class MarkStyle {
  None,
  FirstLine,      // after "# "
  BelowVersion,   // the same, below the version of MFEM and Medit
  PlyComment,     // below the format
  GmshSection,    // $Comments
  XmlComment,     // above the root element
  GltfGenerator,  // in the JSON: asset.generator
};

struct Format {
  std::string extension;   // lower case, with its dot
  std::string name;        // of the docs: "Gmsh"
  std::string kinds = {};  // of its files of cells, for help: "2.2, 4.1"

  // Readers of the file at `path`; null where the format holds no such thing. They throw as
  // read_mesh(), read_map() and read_volume_mesh() do. Without read_map, the texture coordinates of
  // a surface are its map.
  PolygonMesh (*read_surface)(const std::string& path, const StopCheck&, Strictness) = nullptr;
  MapFile (*read_map)(const std::string& path, const StopCheck&) = nullptr;
  VolumeMesh (*read_cells)(const std::string& path, std::string content,
                           const StopCheck&) = nullptr;

  // Writers. write_map writes atomically and lets `verify` judge the file first; input may be null.
  // The others return the bytes of a file; cells_in_version those of the mesh's own file in another
  // version or encoding.
  void (*write_map)(const std::string& path, const MapFile& map, const PolygonMesh* input,
                    const MapFileOptions&, const FileVerification& verify) = nullptr;
  std::string (*polygons_text)(const PolygonMesh&) = nullptr;
  std::string (*cells_text)(const VolumeMesh&, const GmshChoice&) = nullptr;
  std::string (*cells_in_version)(const VolumeMesh&, const GmshChoice&,
                                  std::vector<std::string>* left_out) = nullptr;

  // Limits.
  bool has_texcoords = false;       // of its surfaces
  bool has_curves = false;          // of its maps; else straight pieces of them are written
  bool has_labels = false;          // maps: the vertices and faces of the input that theirs are
  bool has_claims = false;          // maps: what they promise, and so all of a result
  bool has_polygons = false;        // faces of more than three corners stay whole
  bool has_floats = false;          // coordinates are rounded to floats
  bool has_image_of_map = false;    // MshContent::Image holds no surface
  bool has_quads = false;           // meshes of quads are written
  bool has_objects = false;         // layouts of several objects, which may lie on each other
  bool has_control_points = false;  // of curved cells
  bool has_pieces = false;          // names other files, whose pieces of a map it joins
  enum class Materials { None, InFilesBeside, Inside } materials = Materials::None;

  // Shows a map and holds none: pictures/ draws it.
  enum class Picture { None, Drawing, Image, Page } picture = Picture::None;

  MarkStyle mark = MarkStyle::None;
};

// All rows, in the order in which messages name them.
const std::vector<Format>& formats();

// The row of an extension, as format_of() has it; null: unknown.
const Format* find_format(std::string_view extension);

// Adds a row. Not while another thread reads or writes files. Throws InvalidArgument for an
// extension that has a row, or that is none in lower case with a dot.
void add_format(Format format);

enum class FormatUse {
  ReadSurface,
  ReadMap,        // formats of maps, not of surfaces whose texture coordinates are one
  ReadTexcoords,  // these
  ReadCells,
  WriteMap,  // as data
  WriteQuads,
  WriteCells,     // any mesh; each is written in the format of its own file, too
  WriteVersions,  // of these, formats with versions and encodings to choose from
  Show,           // pictures and pages
};
bool serves(const Format& format, FormatUse use);
// Returns extensions in the order of the rows; for maps those that keep claims come first.
std::vector<std::string> extensions_for(FormatUse use);
// Returns whether a file of that name, .gz aside, is of a format of this use.
bool is_for(FormatUse use, const std::string& path);

// ".msh, .mesh and .vtu"; last: "and", "or".
std::string in_words(const std::vector<std::string>& extensions, std::string_view last);

// Writes a map in the format of the extension. Throws as the writers of io.h do, and Error(Usage)
// for formats that hold no maps.
void write_map_file(const std::string& path, const MapFile& map, const PolygonMesh* input,
                    const MapFileOptions& options = {}, const FileVerification& verify = {});

// The table of the docs, in Markdown.
std::string formats_in_markdown();

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
