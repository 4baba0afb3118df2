#include "majorant/apps/jobs/model_texture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/io/atomic_file.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/files_below.h"
#include "majorant/io/gltf_texture.h"
#include "majorant/io/map_check.h"
#include "majorant/io/material_lines.h"
#include "majorant/io/written_mark.h"
#include "majorant/pictures/images/image_file.h"

namespace majorant {
namespace {

std::string beside(const std::string& obj, const char* extension) {
  return std::filesystem::path(obj).replace_extension(extension).string();
}

struct Material {
  std::string map;  // file of map_Kd, or empty
  std::array<float, 3> color{1, 1, 1};
};

void require_unmoved(const MaterialImage& image, const std::string& file) {
  for (const std::string_view option : image.options)
    if (option == "-s" || option == "-o" || option == "-t")
      throw Error(
          ErrorKind::Unsupported,
          fmt::format("{}: map_Kd {}: a texture that is scaled or moved is not baked; apply "
                      "that to the texture coordinates",
                      file, option));
}

std::string image_file(const std::string& path, const std::string& name) {
  if (!is_below(path, name))
    throw Error(ErrorKind::Unsupported,
                fmt::format("{}: map_Kd names the file '{}', and files are read from its own "
                            "folder and those below alone; copy it there",
                            path, name));
  return (std::filesystem::path(path).parent_path() / name).string();
}

class MaterialReader {
 public:
  explicit MaterialReader(ModelTexture& texture) : texture_(texture) {}

  void read(const std::string& path, const StopCheck& stop) {
    std::string text = read_whole_file(path, stop);
    require_text(path, text);
    std::istringstream lines(text);
    Material* current = nullptr;
    for (std::string line; std::getline(lines, line);) {
      texture_.lines.push_back(line);
      const auto [word, rest] = split_keyword(line);
      if (word == "newmtl") current = &materials[std::string(rest)];
      if (!current) continue;
      if (word == "Kd") {
        std::istringstream numbers{std::string(rest)};
        for (float& c : current->color) numbers >> c;
      }
      if (word == "map_Kd") {
        const MaterialImage image = *material_image(line);
        require_unmoved(image, path);
        current->map = image_file(path, image.name);
      }
    }
  }

  std::map<std::string, Material, std::less<>> materials;

 private:
  ModelTexture& texture_;
};

// A map of another kind than map_Kd lies in the old layout.
bool is_other_map(std::string_view word) { return word != "map_Kd" && is_image_keyword(word); }

Raster of_color(const std::array<float, 3>& color) {
  Raster pixel(1, 1, 3, PixelDepth::Eight);
  for (int c = 0; c < 3; ++c) pixel.set(0, 0, c, color[static_cast<std::size_t>(c)]);
  return pixel;
}

std::string materials_text(const ModelTexture& texture, const std::string& image) {
  std::string text = mark_text(".mtl");
  for (const std::string& line : texture.lines) {
    const auto [word, rest] = split_keyword(line);
    if (is_other_map(word) || (word == "#" && is_written_mark(rest))) continue;
    text += word == "map_Kd" ? "map_Kd " + image : line;
    text += '\n';
  }
  return text;
}

ModelTexture read_obj_texture(const PolygonMesh& polygons, const StopCheck& stop) {
  require_materials_below(polygons);
  ModelTexture texture;
  MaterialReader reader(texture);
  const std::filesystem::path folder = std::filesystem::path(polygons.file).parent_path();
  for (const auto& [polygon, line] : polygons.directives) {
    const auto [word, rest] = split_keyword(line);
    if (word == "mtllib") reader.read((folder / std::string(rest)).string(), stop);
  }
  const bool has_map =
      std::any_of(reader.materials.begin(), reader.materials.end(),
                  [](const auto& material) { return !material.second.map.empty(); });
  if (!has_map || polygons.polygon_texcoords.empty())
    throw Error(ErrorKind::Unsupported,
                fmt::format("{}: has no texture to bake: texture coordinates, and an mtllib with a "
                            "map_Kd",
                            polygons.file));
  std::map<std::string, int, std::less<>> number_of_map;
  std::map<std::string, int, std::less<>> number_of_material;
  const auto number = [&](const std::string& name) {
    const auto known = number_of_material.find(name);
    if (known != number_of_material.end()) return known->second;
    const auto material = reader.materials.find(name);
    const Material of = material == reader.materials.end() ? Material() : material->second;
    const auto next = static_cast<int>(texture.images.size());
    const auto [map, is_new] =
        number_of_map.try_emplace(of.map.empty() ? " " + name : of.map, next);
    if (is_new)
      texture.images.push_back(of.map.empty() ? of_color(of.color) : read_image(of.map, stop));
    return number_of_material[name] = map->second;
  };
  auto directive = polygons.directives.begin();
  std::string material;
  for (std::size_t p = 0; p < polygons.polygons.size(); ++p) {
    for (; directive != polygons.directives.end() && to_size(directive->first) <= p; ++directive)
      if (const auto [word, rest] = split_keyword(directive->second); word == "usemtl")
        material = rest;
    texture.image_of_polygon.push_back(number(material));
  }
  for (const std::string& line : texture.lines)
    if (const std::string_view word = split_keyword(line).first; is_other_map(word))
      texture.warnings.push_back(
          fmt::format("{}: {} is not moved to the new layout, and left out", polygons.file, word));
  return texture;
}

// A white pixel for materials without a texture.
ModelTexture read_gltf_texture(const PolygonMesh& polygons, const StopCheck& stop) {
  BaseColors colors = base_colors(polygons, stop);
  if (colors.images.empty() || polygons.polygon_texcoords.empty())
    throw Error(ErrorKind::Unsupported,
                fmt::format("{}: has no texture to bake: texture coordinates, and a material with "
                            "a base colour texture",
                            polygons.file));
  ModelTexture texture;
  texture.image_of_polygon = std::move(colors.image_of_polygon);
  for (const BaseColors::Image& image : colors.images)
    texture.images.push_back(decode_image(image.name, image.bytes));
  const auto white = static_cast<int>(texture.images.size());
  std::vector<int>& numbers = texture.image_of_polygon;
  if (std::find(numbers.begin(), numbers.end(), -1) == numbers.end()) return texture;
  std::replace(numbers.begin(), numbers.end(), -1, white);
  texture.images.push_back(of_color({1, 1, 1}));
  return texture;
}

// What `old` carries, in the layout of the model that was written to `file`.
BakeJob baked(ModelTexture& texture, const PolygonMesh& old, const std::string& model,
              const std::string& file, const StopCheck& stop) {
  BakeJob job;
  job.target = read_bake_surface(file, Texcoords::Needed, stop);
  job.carrier = bake_surface(old, Texcoords::Needed, stop);
  int side = 1;
  bool is_wide = false;
  for (const Raster& image : texture.images) {
    side = std::max({side, image.width(), image.height()});
    is_wide = is_wide || image.depth() != PixelDepth::Eight;
  }
  job.options.width = job.options.height = side;
  job.options.depth = is_wide ? PixelDepth::Sixteen : PixelDepth::Eight;
  job.options.transfer = Transfer::Srgb;
  job.images = std::move(texture.images);
  job.image_of_polygon = std::move(texture.image_of_polygon);
  job.run(stop);
  if (!job.is_proven())
    throw Error(ErrorKind::Invalid,
                fmt::format("{}: its layout overlaps, so that its texture cannot be baked", model));
  return job;
}

}  // namespace

ModelTexture read_texture(const PolygonMesh& polygons, const StopCheck& stop) {
  return polygons.gltf ? read_gltf_texture(polygons, stop) : read_obj_texture(polygons, stop);
}

bool may_have_texture(const std::string& model) {
  const std::string format = format_of(model);
  return format == ".obj" || format == ".glb" || format == ".gltf";
}

std::string texture_file(const std::string& obj) { return beside(obj, ".png"); }
std::string material_file(const std::string& obj) { return beside(obj, ".mtl"); }

PolygonMesh with_material_file(PolygonMesh polygons, const std::string& obj) {
  const std::string line =
      "mtllib " + std::filesystem::path(material_file(obj)).filename().string();
  const auto is_library = [](const auto& directive) {
    return split_keyword(directive.second).first == "mtllib";
  };
  const auto first =
      std::find_if(polygons.directives.begin(), polygons.directives.end(), is_library);
  if (first != polygons.directives.end()) {
    first->second = line;
    polygons.directives.erase(
        std::remove_if(std::next(first), polygons.directives.end(), is_library),
        polygons.directives.end());
  }
  polygons.file = obj;
  return polygons;
}

void write_textured(const std::string& path, const LayoutOfModel& layout, const PolygonMesh& old,
                    ModelTexture texture, const StopCheck& stop) {
  require_complete(path, layout.map);
  const std::string image = texture_file(path);
  std::optional<BakeJob> job;
  std::string png;
  const auto bake = [&](const std::string& temporary) {
    if (layout.verify) layout.verify(temporary);
    job = baked(texture, old, path, temporary, stop);
    png = encode_image(image, job->baked->image, {.transfer = Transfer::Srgb, .channels = {}});
  };
  if (format_of(path) != ".obj") {
    const PendingFile never_there(
        path, gltf_bytes(path, layout.map, &layout.polygons, layout.formats.tessellation), bake);
    return write_base_color(path, job->target.polygons, png, layout.verify);
  }
  write_map(path, layout.map, &layout.polygons, layout.formats, [&](const std::string& temporary) {
    bake(temporary);
    PendingFile picture(image, png);
    PendingFile materials(
        material_file(path),
        materials_text(texture, std::filesystem::path(image).filename().string()));
    picture.take_place();
    materials.take_place();
  });
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
