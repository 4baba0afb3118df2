#include "majorant/apps/jobs/model_texture.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/io/atomic_file.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/formats.h"
#include "majorant/io/gltf_texture.h"
#include "majorant/io/map_check.h"
#include "majorant/io/material_lines.h"
#include "majorant/io/obj_materials.h"
#include "majorant/io/written_mark.h"
#include "majorant/pictures/images/image_file.h"

namespace majorant {
namespace {

constexpr const char* kColorMap = "map_Kd";

std::string beside(const std::string& obj, const std::string& extension) {
  return std::filesystem::path(obj).replace_extension(extension).string();
}

// Returns whether the keyword names a map in the old layout other than map_Kd.
bool is_other_map(std::string_view word) { return word != kColorMap && is_image_keyword(word); }

bool is_color_map(std::string_view keyword) {
  return keyword == kColorMap || keyword == "map_Ka" || keyword == "map_Ks" || keyword == "map_Ke";
}

// Returns whether the keyword names a map of single numbers, which mean the same in any layout.
bool is_number_map(std::string_view keyword) {
  constexpr std::array<std::string_view, 9> kNumbers{
      "map_Ns", "map_d", "map_Pr", "map_Pm", "map_Ps", "map_Bump", "map_bump", "bump", "disp"};
  return std::find(kNumbers.begin(), kNumbers.end(), keyword) != kNumbers.end();
}

// Tells heights, which are grey, from normals in the tangent space of the old layout.
bool is_grey(const Raster& image) {
  if (image.channels() < 3) return true;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      if (image.value(x, y, 0) != image.value(x, y, 1) ||
          image.value(x, y, 0) != image.value(x, y, 2))
        return false;
  return true;
}

Raster of_color(const std::array<float, 3>& color) {
  Raster pixel(1, 1, 3, PixelDepth::Eight);
  for (int c = 0; c < 3; ++c) pixel.set(0, 0, c, color[static_cast<std::size_t>(c)]);
  return pixel;
}

// Applies -mm of the library: base + gain * code.
void spread(Raster& image, double base, double gain) {
  if (base == 0 && gain == 1) return;
  const int colors = image.channels() % 2 == 0 ? image.channels() - 1 : image.channels();
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      for (int c = 0; c < colors; ++c)
        image.set(x, y, c, static_cast<float>(base + gain * image.value(x, y, c)));
}

Raster shown_image(const ObjImage& image, const StopCheck& stop) {
  if (!image.refusal.empty()) throw Error(ErrorKind::Unsupported, image.refusal);
  Raster raster = read_image(image.file, stop);
  spread(raster, image.base, image.gain);
  return raster;
}

Wraps wraps_of(const ObjImage& image) {
  return image.clamps ? Wraps{Wrap::Clamp, Wrap::Clamp} : Wraps{};
}

// Collects the images of one keyword of the materials.
class LayerReader {
 public:
  LayerReader(const ObjMaterials& materials, std::string keyword) : materials_(materials) {
    layer_.transfer = is_color_map(keyword) ? Transfer::Srgb : Transfer::Linear;
    layer_.keyword = std::move(keyword);
  }

  TextureLayer read(std::vector<std::string>& files, const StopCheck& stop) {
    std::vector<int> image_of_material;
    for (const std::string& name : materials_.names)
      image_of_material.push_back(number(materials_.find(name), files, stop));
    for (const int material : materials_.of_polygon)
      layer_.image_of_polygon.push_back(image_of_material[to_size(material)]);
    return std::move(layer_);
  }

 private:
  int number(const ObjMaterial* material, std::vector<std::string>& files, const StopCheck& stop) {
    const auto next = static_cast<int>(layer_.images.size());
    const ObjImage* const image = material == nullptr ? nullptr : material->image(layer_.keyword);
    if (image == nullptr) {
      layer_.images.push_back(
          of_color(material == nullptr ? std::array<float, 3>{1, 1, 1} : material->color));
      layer_.wraps.emplace_back();
      return next;
    }
    for (const auto& [known, k] : known_)
      if (known == *image) return k;
    layer_.images.push_back(shown_image(*image, stop));
    layer_.wraps.push_back(wraps_of(*image));
    known_.emplace_back(*image, next);
    files.push_back(image->file);
    return next;
  }

  const ObjMaterials& materials_;
  TextureLayer layer_;
  std::vector<std::pair<ObjImage, int>> known_;
};

// Returns the line of an output material that shows a map. Options that do not concern the layout
// stay.
std::string map_line(const std::string& line, const std::string& image) {
  const MaterialImage map = *material_image(line);
  std::string text(map.keyword);
  for (const MaterialImage::Option& option : map.options)
    if (option.name == "-bm" || option.name == "-imfchan" || option.name == "-type")
      text += fmt::format(" {} {}", option.name, fmt::join(option.values, " "));
  return text + " " + image;
}

// Returns the file name of a layer: out_map_Ks.png.
std::string layer_file(const std::string& obj, const TextureLayer& layer) {
  std::filesystem::path path(obj);
  path.replace_filename(path.stem().string() + "_" + layer.keyword + ".png");
  return path.string();
}

std::string materials_text(const ModelTexture& texture, const std::string& obj) {
  const auto name_of = [](const std::string& file) {
    return std::filesystem::path(file).filename().string();
  };
  std::string text = mark_text(MarkStyle::FirstLine);
  for (const std::string& line : texture.lines) {
    const auto [word, rest] = split_keyword(line);
    if (word == "#" && is_written_mark(rest)) continue;
    const auto layer =
        std::find_if(texture.others.begin(), texture.others.end(),
                     [word = word](const TextureLayer& one) { return one.keyword == word; });
    if (is_other_map(word) && layer == texture.others.end()) continue;
    text += word == kColorMap    ? map_line(line, name_of(texture_file(obj)))
            : is_other_map(word) ? map_line(line, name_of(layer_file(obj, *layer)))
                                 : line;
    text += '\n';
  }
  return text;
}

// Warns of materials that no library has; they are shown white.
void warn_of_missing(const PolygonMesh& polygons, const ObjMaterials& materials,
                     std::vector<std::string>& warnings) {
  for (const std::string& name : materials.names) {
    if (name.empty() || materials.find(name) != nullptr) continue;
    const auto same =
        std::find_if(materials.materials.begin(), materials.materials.end(), [&](const auto& one) {
          return std::equal(
              one.first.begin(), one.first.end(), name.begin(), name.end(),
              [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); });
        });
    warnings.push_back(fmt::format(
        "{}: no mtllib has the material '{}'{}; its faces are white", polygons.file, name,
        same == materials.materials.end() ? "" : fmt::format(" (it has '{}')", same->first)));
  }
}

// Reads the images of a keyword. Returns the reason why they do not move; empty if they do.
std::string read_other_layer(const std::string& keyword, const ObjMaterials& materials,
                             ModelTexture& texture, const StopCheck& stop) {
  if (!is_color_map(keyword) && !is_number_map(keyword))
    return "it depends on the old layout, or on more than a point";
  TextureLayer layer;
  try {
    layer = LayerReader(materials, keyword).read(texture.files, stop);
  } catch (const Error& error) {
    return error.what();
  }
  const bool is_shown = is_color_map(keyword) ||
                        std::all_of(layer.images.begin(), layer.images.end(), [](const auto& one) {
                          return is_grey(one) || one.width() * one.height() == 1;
                        });
  if (!is_shown) return "its colours are directions in the old layout";
  texture.others.push_back(std::move(layer));
  return {};
}

// Reads the other images. Those that cannot be moved are left out with a warning.
void read_other_layers(const PolygonMesh& polygons, const ObjMaterials& materials,
                       ModelTexture& texture, const StopCheck& stop) {
  std::set<std::string> keywords;
  for (const std::string& name : materials.names)
    if (const ObjMaterial* const material = materials.find(name))
      for (const auto& [keyword, image] : material->images)
        if (keyword != kColorMap) keywords.insert(keyword);
  for (const std::string& keyword : keywords)
    if (const std::string why = read_other_layer(keyword, materials, texture, stop); !why.empty())
      texture.warnings.push_back(fmt::format(
          "{}: {} is not moved to the new layout, and left out: {}", polygons.file, keyword, why));
}

std::optional<ModelTexture> find_obj_texture(const PolygonMesh& polygons, Layers layers,
                                             const StopCheck& stop) {
  const ObjMaterials materials = read_obj_materials(polygons, stop);
  const bool has_map =
      std::any_of(materials.materials.begin(), materials.materials.end(),
                  [](const auto& material) { return material.second.image(kColorMap) != nullptr; });
  if (!has_map || polygons.polygon_texcoords.empty()) return std::nullopt;
  ModelTexture texture;
  texture.lines = materials.lines;
  texture.color = LayerReader(materials, kColorMap).read(texture.files, stop);
  warn_of_missing(polygons, materials, texture.warnings);
  if (layers == Layers::All) read_other_layers(polygons, materials, texture, stop);
  return texture;
}

Wrap wrap_of(BaseColors::Wrap wrap) {
  return wrap == BaseColors::Wrap::Clamp    ? Wrap::Clamp
         : wrap == BaseColors::Wrap::Mirror ? Wrap::Mirror
                                            : Wrap::Repeat;
}

// Materials without a texture get a white pixel.
std::optional<ModelTexture> find_gltf_texture(const PolygonMesh& polygons, const StopCheck& stop) {
  BaseColors colors = base_colors(polygons, stop);
  if (colors.images.empty() || polygons.polygon_texcoords.empty()) return std::nullopt;
  ModelTexture texture;
  TextureLayer& layer = texture.color;
  layer.keyword = kColorMap;
  layer.image_of_polygon = std::move(colors.image_of_polygon);
  for (const BaseColors::Image& image : colors.images) {
    layer.images.push_back(decode_image(image.name, image.bytes));
    layer.wraps.push_back({wrap_of(image.wrap[0]), wrap_of(image.wrap[1])});
  }
  const auto white = static_cast<int>(layer.images.size());
  std::vector<int>& numbers = layer.image_of_polygon;
  if (std::find(numbers.begin(), numbers.end(), -1) == numbers.end()) return texture;
  std::replace(numbers.begin(), numbers.end(), -1, white);
  layer.images.push_back(of_color({1, 1, 1}));
  layer.wraps.emplace_back();
  return texture;
}

// Returns the side of a square image with as many pixels as all images together, at least the
// longest side.
int side_of(const TextureLayer& layer) {
  int side = 1;
  double pixels = 0;
  for (const Raster& image : layer.images) {
    side = std::max({side, image.width(), image.height()});
    if (image.width() * image.height() > 1)  // single pixels are colours of materials
      pixels += static_cast<double>(image.width()) * image.height();
  }
  const double together = std::ceil(std::sqrt(pixels));
  return std::min(std::max(side, static_cast<int>(together)), kLargestImage);
}

// Bakes the images of `job` in the layout of the written model.
void bake_layer(BakeJob& job, TextureLayer layer, const std::string& model, std::optional<int> side,
                const StopCheck& stop) {
  job.options.width = job.options.height = side.value_or(side_of(layer));
  const bool is_wide =
      std::any_of(layer.images.begin(), layer.images.end(),
                  [](const Raster& image) { return image.depth() != PixelDepth::Eight; });
  job.options.depth = is_wide ? PixelDepth::Sixteen : PixelDepth::Eight;
  job.options.transfer = job.image_transfer = layer.transfer;
  job.images = std::move(layer.images);
  job.wraps = std::move(layer.wraps);
  job.image_of_polygon = std::move(layer.image_of_polygon);
  job.run(stop);
  if (!job.is_proven())
    throw Error(ErrorKind::Invalid,
                fmt::format("{}: its layout overlaps, so that its texture cannot be baked", model));
}

// A baked image beside a model, under a temporary name until it is complete.
struct BakedLayer {
  std::string file, bytes;
};

void require_not_read(const std::string& file, const ModelTexture& texture) {
  std::error_code failed;
  for (const std::string& read : texture.files)
    if (std::filesystem::equivalent(file, read, failed))
      throw Error(
          ErrorKind::Usage,
          fmt::format("{}: the texture is read from it; give the output another name", file));
}

}  // namespace

std::optional<ModelTexture> find_texture(const PolygonMesh& polygons, Layers layers,
                                         const StopCheck& stop) {
  return polygons.gltf ? find_gltf_texture(polygons, stop)
                       : find_obj_texture(polygons, layers, stop);
}

std::vector<std::string> shown_pictures(const PolygonMesh& polygons) {
  std::vector<std::string> files;
  if (polygons.gltf || polygons.polygon_texcoords.empty()) return files;
  try {
    const ObjMaterials materials = read_obj_materials(polygons);
    for (const std::string& name : materials.names) {
      const ObjMaterial* const material = materials.find(name);
      const ObjImage* const image = material == nullptr ? nullptr : material->image(kColorMap);
      if (image != nullptr && !image->file.empty() &&
          std::find(files.begin(), files.end(), image->file) == files.end())
        files.push_back(image->file);
    }
  } catch (const Error&) {  // the reader of the images reports this
  }
  return files;
}

ModelTexture read_texture(const PolygonMesh& polygons, const StopCheck& stop) {
  if (auto texture = find_texture(polygons, Layers::All, stop)) return *std::move(texture);
  throw Error(ErrorKind::Unsupported,
              fmt::format("{}: has no texture to bake: texture coordinates, and {}", polygons.file,
                          polygons.gltf ? "a material with a base colour texture"
                                        : "an mtllib with a map_Kd"));
}

namespace {

bool has_files_beside(const std::string& model) {
  const Format* const format = find_format(format_of(model));
  return format && format->materials == Format::Materials::InFilesBeside;
}

}  // namespace

bool may_have_texture(const std::string& model) {
  const Format* const format = find_format(format_of(model));
  return format && format->materials != Format::Materials::None;
}

std::string texture_file(const std::string& obj) { return beside(obj, ".png"); }
std::string material_file(const std::string& obj) { return beside(obj, ".mtl"); }

std::vector<std::string> layer_files(const std::string& obj, const ModelTexture& texture) {
  std::vector<std::string> files;
  if (has_files_beside(obj))
    for (const TextureLayer& layer : texture.others) files.push_back(layer_file(obj, layer));
  return files;
}

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
                    ModelTexture texture, std::optional<int> side, const StopCheck& stop) {
  require_complete(path, layout.map);
  for (const std::string& file : layer_files(path, texture)) require_not_read(file, texture);
  std::optional<BakeJob> job;
  std::vector<BakedLayer> baked;
  const auto bake = [&](const std::string& temporary) {
    if (layout.verify) layout.verify(temporary);
    job.emplace();
    job->target = read_bake_surface(temporary, Texcoords::Needed, stop);
    job->carrier = bake_surface(old, Texcoords::Needed, stop);
    const auto add = [&](const std::string& file, TextureLayer layer) {
      const Transfer transfer = layer.transfer;
      bake_layer(*job, std::move(layer), path, side, stop);
      baked.push_back(
          {file, encode_image(file, job->baked->image, {.transfer = transfer, .channels = {}})});
    };
    add(texture_file(path), std::move(texture.color));
    if (has_files_beside(path))
      for (TextureLayer& layer : texture.others) {
        const std::string file = layer_file(path, layer);
        TextureLayer images = layer;
        layer.images.clear();  // its name is still needed
        add(file, std::move(images));
      }
  };
  if (!has_files_beside(path)) {
    const PendingFile never_there(
        path, gltf_bytes(path, layout.map, &layout.polygons, layout.formats.tessellation), bake);
    return write_base_color(path, job->target.polygons, baked.front().bytes, layout.verify);
  }
  write_map(path, layout.map, &layout.polygons, layout.formats, [&](const std::string& temporary) {
    bake(temporary);
    std::vector<std::unique_ptr<PendingFile>> pending;
    for (const BakedLayer& layer : baked)
      pending.push_back(std::make_unique<PendingFile>(layer.file, layer.bytes));
    pending.push_back(
        std::make_unique<PendingFile>(material_file(path), materials_text(texture, path)));
    for (const auto& file : pending) file->take_place();
  });
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
