#include "majorant/io/read_mesh.h"

#include <fmt/format.h>

#include <array>
#include <limits>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/formats.h"
#include "majorant/io/internal/mesh_readers.h"

namespace majorant {

void require_complete(const PolygonMesh& mesh) {
  const auto refuse = [&mesh](const char* problem) {
    throw Error(ErrorKind::Unreadable, fmt::format("{}: {}", mesh.file, problem));
  };
  constexpr std::size_t kMaximum = std::numeric_limits<Index>::max();
  if (mesh.positions.empty()) refuse("no vertices; not a mesh, or truncated");
  if (mesh.polygons.empty()) refuse("no faces; a surface mesh is needed");
  if (mesh.positions.size() > kMaximum || mesh.polygons.size() > kMaximum) {
    refuse("more than 2^31 vertices or faces; simplify the mesh");
  }
}

bool is_mesh_name(const std::string& path) { return is_for(FormatUse::ReadSurface, path); }

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
  if (const Format* known = find_format(extension); known && known->read_surface)
    return known->read_surface(path, stop, strictness);
  if (const std::string format = foreign_format(path); !format.empty())
    throw Error(ErrorKind::Unsupported,
                fmt::format("{}: {} files are not read; export the mesh as .obj, .glb or .ply from "
                            "a program that reads them",
                            path, format));
  const std::string readable =
      in_words(extensions_for(FormatUse::ReadSurface), "or") + ", or one of them with .gz";
  require_format_name(path, readable);
  throw Error(ErrorKind::Unreadable, fmt::format("{}: unknown mesh format {}; use {}", path,
                                                 in_quotes(extension), readable));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
