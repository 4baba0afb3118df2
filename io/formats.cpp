#include "majorant/io/formats.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/io/claims.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/internal/cell_readers.h"
#include "majorant/io/internal/cell_writers.h"
#include "majorant/io/internal/mesh_readers.h"
#include "majorant/io/pvtu.h"

namespace majorant {
namespace {

using Materials = Format::Materials;
using Picture = Format::Picture;

// Adapts the readers and writers of a format to the signatures of the table.
template <auto read>
PolygonMesh strictly(const std::string& path, const StopCheck& stop, Strictness strictness) {
  return read(path, read_whole_file(path, stop), stop, strictness);
}
template <auto read>
PolygonMesh at_once(const std::string& path, const StopCheck& stop, Strictness /*everything*/) {
  return read(path, read_whole_file(path, stop), stop);
}
template <auto write>
void tessellated(const std::string& path, const MapFile& map, const PolygonMesh* input,
                 const MapFileOptions& options, const FileVerification& verify) {
  write(path, map, input, options.tessellation, verify);
}

PolygonMesh surface_of_vtu(const std::string& path, const StopCheck& stop, Strictness /*all*/) {
  return mesh_from_map(read_vtu(path, stop), path);
}
MapFile map_of_vtu(const std::string& path, const StopCheck& stop) {
  MapFile map = read_vtu(path, stop);
  map.is_complete = readable_claims(map.claims).complete.value_or(true);
  return map;
}
void map_to_vtu(const std::string& path, const MapFile& map, const PolygonMesh* /*input*/,
                const MapFileOptions& options, const FileVerification& verify) {
  write_vtu(path, map, options.vtu, verify);
}
void map_to_msh(const std::string& path, const MapFile& map, const PolygonMesh* /*input*/,
                const MapFileOptions& options, const FileVerification& verify) {
  write_msh(path, map, options.msh, verify);
}

Format gltf(const char* extension, const char* name) {
  return {.extension = extension,
          .name = name,
          .read_surface = &strictly<read_gltf>,
          .write_map = &tessellated<write_gltf>,
          .has_texcoords = true,
          .has_floats = true,
          .has_objects = true,
          .materials = Materials::Inside,
          .mark = MarkStyle::GltfGenerator};
}

std::vector<Format> rows() {
  return {{.extension = ".obj",
           .name = "Wavefront OBJ",
           .read_surface = &strictly<read_obj>,
           .write_map = &tessellated<write_obj>,
           .polygons_text = &obj_text,
           .has_texcoords = true,
           .has_polygons = true,
           .has_quads = true,
           .has_objects = true,
           .materials = Materials::InFilesBeside,
           .mark = MarkStyle::FirstLine},
          {.extension = ".off", .name = "OFF", .read_surface = &strictly<read_off>},
          {.extension = ".ply",
           .name = "PLY",
           .read_surface = &strictly<read_ply>,
           .write_map = &tessellated<write_ply>,
           .polygons_text = &ply_text,
           .has_texcoords = true,
           .has_polygons = true,
           .has_quads = true,
           .mark = MarkStyle::PlyComment},
          {.extension = ".stl", .name = "STL", .read_surface = &at_once<read_stl>},
          gltf(".glb", "glTF 2.0, binary"),
          gltf(".gltf", "glTF 2.0"),
          {.extension = ".vtu",
           .name = "VTK XML",
           .read_surface = &surface_of_vtu,
           .read_map = &map_of_vtu,
           .read_cells = &read_vtk_mesh,
           .write_map = &map_to_vtu,
           .cells_text = &vtk_text,
           .has_curves = true,
           .has_labels = true,
           .has_claims = true,
           .has_quads = true,
           .has_objects = true,
           .has_control_points = true,
           .mark = MarkStyle::XmlComment},
          {.extension = ".pvtu",
           .name = "VTK XML, in pieces",
           .read_map = &read_pvtu,
           .has_curves = true,
           .has_labels = true,
           .has_claims = true,
           .has_pieces = true,
           .mark = MarkStyle::XmlComment},
          {.extension = ".msh",
           .name = "Gmsh",
           .kinds = "2.2, 4.1",
           .read_surface = &at_once<read_gmsh_surface>,
           .read_map = &read_msh,
           .read_cells = &read_gmsh_mesh,
           .write_map = &map_to_msh,
           .cells_text = &gmsh_text,
           .cells_in_version = &gmsh_text_in_version,
           .has_curves = true,
           .has_labels = true,
           .has_image_of_map = true,
           .mark = MarkStyle::GmshSection},
          {.extension = ".mesh",
           .name = "MFEM v1.0 to v1.3, Medit",
           .kinds = "MFEM, Medit",
           .read_cells = &read_mfem_or_medit_mesh,
           .mark = MarkStyle::BelowVersion},
          {.extension = ".svg", .name = "SVG", .picture = Picture::Drawing},
          {.extension = ".png", .name = "PNG", .picture = Picture::Image},
          {.extension = ".html", .name = "page", .picture = Picture::Page}};
}

std::vector<Format>& table() {
  static std::vector<Format> all = rows();
  return all;
}

bool is_extension(std::string_view text) {
  return text.size() > 1 && text[0] == '.' &&
         std::all_of(text.begin() + 1, text.end(),
                     [](unsigned char c) { return std::islower(c) != 0 || std::isdigit(c) != 0; });
}

}  // namespace

const std::vector<Format>& formats() { return table(); }

const Format* find_format(std::string_view extension) {
  const std::vector<Format>& all = formats();
  const auto found = std::find_if(
      all.begin(), all.end(), [&](const Format& format) { return format.extension == extension; });
  return found == all.end() ? nullptr : &*found;
}

void add_format(Format format) {
  if (!is_extension(format.extension))
    throw InvalidArgument(fmt::format("'{}' is no extension; write it in lower case, with its dot",
                                      format.extension));
  if (find_format(format.extension) != nullptr)
    throw InvalidArgument(fmt::format("{} has a format already", format.extension));
  table().push_back(std::move(format));
}

bool serves(const Format& format, FormatUse use) {
  switch (use) {
    case FormatUse::ReadSurface:
      return format.read_surface != nullptr;
    case FormatUse::ReadMap:
      return format.read_map != nullptr;
    case FormatUse::ReadTexcoords:
      return format.read_map == nullptr && format.read_surface != nullptr && format.has_texcoords;
    case FormatUse::ReadCells:
      return format.read_cells != nullptr;
    case FormatUse::WriteMap:
      return format.write_map != nullptr;
    case FormatUse::WriteQuads:
      return format.has_quads;
    case FormatUse::WriteCells:
      return format.cells_text != nullptr;
    case FormatUse::WriteVersions:
      return format.cells_in_version != nullptr;
    case FormatUse::Show:
      return format.picture != Picture::None;
  }
  return false;
}

std::vector<std::string> extensions_for(FormatUse use) {
  std::vector<const Format*> rows;
  for (const Format& format : formats())
    if (serves(format, use)) rows.push_back(&format);
  const bool is_of_maps = use == FormatUse::WriteMap || use == FormatUse::ReadMap;
  if (is_of_maps || use == FormatUse::ReadCells || use == FormatUse::WriteCells)
    std::stable_partition(rows.begin(), rows.end(),
                          [&](const Format* f) { return f->has_claims == is_of_maps; });
  std::vector<std::string> out;
  for (const Format* format : rows) out.push_back(format->extension);
  return out;
}

bool is_for(FormatUse use, const std::string& path) {
  const Format* const format = find_format(format_of(path));
  return format != nullptr && serves(*format, use);
}

std::string in_words(const std::vector<std::string>& extensions, std::string_view last) {
  if (extensions.empty()) return {};
  const auto end = extensions.end() - 1;
  if (extensions.size() == 1) return *end;
  return fmt::format("{} {} {}", fmt::join(extensions.begin(), end, ", "), last, *end);
}

std::string formats_in_markdown() {
  std::string text =
      "| extension | format | read as | written from | limits |\n|---|---|---|---|---|\n";
  const auto list = [](const std::vector<std::pair<bool, const char*>>& facts) {
    std::vector<const char*> out;
    for (const auto& [holds, words] : facts)
      if (holds) out.push_back(words);
    return fmt::format("{}", fmt::join(out, ", "));
  };
  for (const Format& f : formats()) {
    const bool is_written = f.write_map != nullptr;
    text += fmt::format(
        "| `{}` | {} | {} | {} | {} |\n", f.extension, f.name,
        list({{f.read_surface != nullptr, "surface"},
              {f.read_map != nullptr, "map"},
              {serves(f, FormatUse::ReadTexcoords), "map of its texture coordinates"},
              {f.read_cells != nullptr, "cells"}}),
        list({{is_written, "map"},
              {f.has_quads, "quads"},
              {f.cells_text != nullptr, "cells"},
              {f.read_cells != nullptr && f.cells_text == nullptr, "cells of its own files"},
              {f.picture != Picture::None, "picture"}}),
        list({{is_written && !f.has_curves, "straight pieces of curves"},
              {is_written && !f.has_polygons, "triangles"},
              {is_written && f.has_floats, "floats"},
              {is_written && !f.has_claims, "no claims"},
              {f.has_image_of_map, "the image without its surface, or rounded values of curves"},
              {f.has_pieces, "names its pieces"}}));
  }
  return text;
}

void write_map_file(const std::string& path, const MapFile& map, const PolygonMesh* input,
                    const MapFileOptions& options, const FileVerification& verify) {
  const Format* const format = find_format(format_of(path));
  if (format == nullptr || format->write_map == nullptr)
    throw Error(ErrorKind::Usage, fmt::format("{}: maps are written as {}", path,
                                              in_words(extensions_for(FormatUse::WriteMap), "or")));
  format->write_map(path, map, input, options, verify);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
