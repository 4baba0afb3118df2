#include "majorant/io/read_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/internal/mesh_readers.h"
#include "majorant/io/internal/msh_content.h"
#include "majorant/io/io.h"

namespace majorant {

void require_complete(const PolygonMesh& mesh) {
  const auto refuse = [&mesh](const char* problem) {
    throw Error(ErrorKind::Unreadable, fmt::format("{}: {}", mesh.file, problem));
  };
  constexpr std::size_t kMost = std::numeric_limits<Index>::max();
  if (mesh.positions.empty()) refuse("no vertices; not a mesh, or truncated");
  if (mesh.polygons.empty()) refuse("no faces; a surface mesh is needed");
  if (mesh.positions.size() > kMost || mesh.polygons.size() > kMost) {
    refuse("more than 2^31 vertices or faces; simplify the mesh");
  }
}

bool is_mesh_name(const std::string& path) {
  constexpr std::array<std::string_view, 8> kFormats = {".obj", ".off", ".ply", ".stl",
                                                        ".vtu", ".msh", ".glb", ".gltf"};
  return std::find(kFormats.begin(), kFormats.end(), format_of(path)) != kFormats.end();
}

std::string foreign_format(const std::string& path) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 20> kForeign = {{
      {".fbx", "FBX"},     {".3mf", "3MF"},       {".dae", "COLLADA"}, {".blend", "Blender"},
      {".usd", "USD"},     {".usda", "USD"},      {".usdc", "USD"},    {".usdz", "USD"},
      {".abc", "Alembic"}, {".3ds", "3DS"},       {".x3d", "X3D"},     {".wrl", "VRML"},
      {".step", "STEP"},   {".stp", "STEP"},      {".iges", "IGES"},   {".igs", "IGES"},
      {".amf", "AMF"},     {".lwo", "LightWave"}, {".ma", "Maya"},     {".max", "3ds Max"},
  }};
  const std::string extension = format_of(path);
  for (const auto& [known, name] : kForeign)
    if (extension == known) return std::string(name);
  return {};
}

PolygonMesh read_mesh(const std::string& path, const StopCheck& stop, Strictness strictness) {
  const std::string extension = format_of(path);
  if (extension == ".obj") return read_obj(path, read_whole_file(path, stop), stop, strictness);
  if (extension == ".off") return read_off(path, read_whole_file(path, stop), stop, strictness);
  if (extension == ".ply") return read_ply(path, read_whole_file(path, stop), stop, strictness);
  if (extension == ".stl") return read_stl(path, read_whole_file(path, stop), stop);
  if (extension == ".msh") return read_msh_mesh(path, read_whole_file(path, stop), stop);
  if (extension == ".glb" || extension == ".gltf")
    return read_gltf(path, read_whole_file(path, stop), stop, strictness);
  if (extension == ".vtu") return mesh_from_map(read_vtu(path, stop), path);
  if (const std::string format = foreign_format(path); !format.empty())
    throw Error(ErrorKind::Unsupported,
                fmt::format("{}: {} files are not read; export the mesh as .obj, .glb or .ply from "
                            "a program that reads them",
                            path, format));
  constexpr const char* kFormats =
      ".obj, .off, .ply, .stl, .glb, .gltf, .vtu or .msh, or one of them with .gz";
  require_format_name(path, kFormats);
  throw Error(ErrorKind::Unreadable, fmt::format("{}: unknown mesh format {}; use {}", path,
                                                 in_quotes(extension), kFormats));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
