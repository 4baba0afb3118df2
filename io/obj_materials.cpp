#include "majorant/io/obj_materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <sstream>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/files_below.h"
#include "majorant/io/internal/material_files.h"
#include "majorant/io/internal/text_cursor.h"
#include "majorant/io/material_lines.h"

namespace majorant {
namespace {

double number_or(std::string_view text, double otherwise) {
  double value = 0;
  return parse_number(text, value) == NumberStatus::Good ? value : otherwise;
}

// Returns whether an option only concerns filtering, or other kinds of maps.
bool is_without_effect(std::string_view option) {
  constexpr std::array<std::string_view, 7> kFilters{"-blendu", "-blendv", "-boost", "-texres",
                                                     "-bm",     "-type",   "-cc"};
  return std::find(kFilters.begin(), kFilters.end(), option) != kFilters.end();
}

void take_options(const MaterialImage& line, ObjImage& image) {
  for (const MaterialImage::Option& option : line.options) {
    if (option.name == "-clamp") {
      image.clamps = option.values.front() == "on";
    } else if (option.name == "-mm") {
      image.base = number_or(option.values[0], 0);
      image.gain = number_or(option.values[1], 1);
    } else if (option.name == "-s" || option.name == "-o" || option.name == "-t") {
      image.refusal = fmt::format(
          "{}: a texture that is scaled or moved is not baked; apply that to the texture "
          "coordinates",
          option.name);
    } else if (!is_without_effect(option.name)) {
      image.refusal = fmt::format("{}: an option that is not known; leave it out", option.name);
    }
  }
}

class Library {
 public:
  Library(std::string path, ObjMaterials& all) : path_(std::move(path)), all_(all) {}

  void read(const StopCheck& stop) {
    std::string text = read_whole_file(path_, stop);
    require_text(path_, text);
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      all_.lines.push_back(line);
      take(line);
    }
  }

 private:
  void take(const std::string& line) {
    const auto [word, rest] = split_keyword(line);
    if (word == "newmtl") material_ = &all_.materials[std::string(rest)];
    if (material_ == nullptr) return;
    if (word == "Kd") {
      std::istringstream numbers{std::string(rest)};
      for (float& c : material_->color) numbers >> c;
    }
    if (word == "d") material_->opacity = static_cast<float>(number_or(rest, 1));
    if (word == "Tr") material_->opacity = 1 - static_cast<float>(number_or(rest, 0));
    if (const auto image = material_image(line)) add_image(*image);
  }

  void add_image(const MaterialImage& line) {
    ObjImage image;
    take_options(line, image);
    if (is_below(path_, line.name))
      image.file = (std::filesystem::path(path_).parent_path() / line.name).string();
    else
      image.refusal = fmt::format(
          "it names the file '{}', and files are read from its own folder and those below alone; "
          "copy it there",
          line.name);
    if (!image.refusal.empty())
      image.refusal = fmt::format("{}: {} {}", path_, line.keyword, image.refusal);
    material_->images.insert_or_assign(std::string(line.keyword), std::move(image));
  }

  std::string path_;
  ObjMaterials& all_;
  ObjMaterial* material_ = nullptr;  // of the current lines
};

void require_below(const std::string& obj, const std::string& library) {
  if (!is_below(obj, library))
    throw Error(
        ErrorKind::Unsupported,
        fmt::format("{}: mtllib names the file '{}', and files are read from its own folder "
                    "and those below alone; copy it there",
                    obj, library));
}

void number_polygons(const PolygonMesh& mesh, ObjMaterials& all) {
  std::map<std::string, int, std::less<>> numbers;
  auto directive = mesh.directives.begin();
  std::string material;
  for (std::size_t p = 0; p < mesh.polygons.size(); ++p) {
    for (; directive != mesh.directives.end() && to_size(directive->first) <= p; ++directive)
      if (const auto [word, rest] = split_keyword(directive->second); word == "usemtl")
        material = rest;
    const auto [entry, is_new] = numbers.try_emplace(material, static_cast<int>(all.names.size()));
    if (is_new) all.names.push_back(material);
    all.of_polygon.push_back(entry->second);
  }
}

}  // namespace

const ObjImage* ObjMaterial::image(std::string_view keyword) const {
  const auto found = images.find(keyword);
  return found == images.end() ? nullptr : &found->second;
}

const ObjMaterial* ObjMaterials::find(std::string_view name) const {
  const auto found = materials.find(name);
  return found == materials.end() ? nullptr : &found->second;
}

std::vector<std::string> material_libraries(const PolygonMesh& mesh) {
  std::vector<std::string> paths;
  const std::filesystem::path folder = std::filesystem::path(mesh.file).parent_path();
  std::optional<MaterialNames> names;  // lists the folder when it is made
  for (const auto& [polygon, line] : mesh.directives) {
    const auto [word, rest] = split_keyword(line);
    if (word != "mtllib") continue;
    if (!names) names.emplace(folder.empty() ? "." : folder);
    for (std::string name : names->split(std::string(rest))) {
      std::replace(name.begin(), name.end(), '\\', '/');
      require_below(mesh.file, name);
      std::string path = (folder / name).string();
      if (std::find(paths.begin(), paths.end(), path) == paths.end())
        paths.push_back(std::move(path));
    }
  }
  return paths;
}

ObjMaterials read_obj_materials(const PolygonMesh& mesh, const StopCheck& stop) {
  ObjMaterials all;
  for (std::string& path : material_libraries(mesh)) Library(std::move(path), all).read(stop);
  number_polygons(mesh, all);
  return all;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
