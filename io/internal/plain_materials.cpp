#include "majorant/io/internal/plain_materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/files/srgb.h"
#include "majorant/io/obj_materials.h"

namespace majorant {
namespace {

constexpr const char* kColorMap = "map_Kd";

std::string mime_of(const std::string& bytes) {
  if (bytes.starts_with("\x89PNG")) return "image/png";
  if (bytes.starts_with("\xFF\xD8\xFF")) return "image/jpeg";
  return {};
}

// Refuses pipes, which may never get a writer.
void require_no_pipe(const std::string& path) {
  std::error_code failed;
  const auto status = std::filesystem::status(path, failed);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw Error(ErrorKind::Unreadable, path + ": is no regular file");
}

class PlainReader {
 public:
  explicit PlainReader(const PolygonMesh& mesh) : mesh_(mesh) {}

  PlainMaterials read() {
    ObjMaterials all;
    try {
      for (const std::string& path : material_libraries(mesh_)) require_no_pipe(path);
      all = read_obj_materials(mesh_);
    } catch (const Error& error) {
      out_.left_out.push_back(fmt::format("materials ({})", error.what()));
      return std::move(out_);
    }
    std::vector<int> number;
    for (const std::string& name : all.names) {
      number.push_back(name.empty() ? -1 : static_cast<int>(out_.materials.size()));
      if (!name.empty()) add(name, all.find(name));
    }
    for (const int name : all.of_polygon) out_.of_polygon.push_back(number[to_size(name)]);
    return std::move(out_);
  }

 private:
  // material: null if no library has it.
  void add(const std::string& name, const ObjMaterial* material) {
    PlainMaterials::Material& made = out_.materials.emplace_back();
    made.json = {{"name", name}};
    if (material == nullptr) {
      out_.left_out.push_back(fmt::format("the look of material '{}', which no mtllib has", name));
      return;
    }
    if (const ObjImage* const image = material->image(kColorMap)) made.image = number(*image, name);
    for (const auto& [keyword, image] : material->images)
      if (keyword != kColorMap)
        out_.left_out.push_back(fmt::format("{} of material '{}'", keyword, name));
    Gltf factor = Gltf::array();
    for (const float code : material->color)
      factor.push_back(
          made.image >= 0 ? 1.0 : srgb_to_linear(std::clamp(static_cast<double>(code), 0.0, 1.0)));
    factor.push_back(std::clamp(static_cast<double>(material->opacity), 0.0, 1.0));
    if (material->opacity < 1) made.json["alphaMode"] = "BLEND";
    made.json["pbrMetallicRoughness"] = {{"metallicFactor", 0}, {"baseColorFactor", factor}};
  }

  // Returns the number of an image, -1 if it is left out.
  int number(const ObjImage& image, const std::string& material) {
    const auto leave_out = [&](const std::string& why) {
      out_.left_out.push_back(fmt::format("the image of material '{}' ({})", material, why));
      return -1;
    };
    if (!image.refusal.empty()) return leave_out(image.refusal);
    if (image.base != 0 || image.gain != 1)
      return leave_out(fmt::format("-mm {:g} {:g} changes its colours", image.base, image.gain));
    for (std::size_t k = 0; k < out_.images.size(); ++k)
      if (out_.images[k].file == image.file && out_.images[k].clamps == image.clamps)
        return static_cast<int>(k);
    PlainMaterials::Image read{image.file, {}, {}, image.clamps};
    try {
      require_no_pipe(image.file);
      read.bytes = read_whole_file(image.file);
    } catch (const Error& error) {
      return leave_out(error.what());
    }
    read.mime = mime_of(read.bytes);
    if (read.mime.empty()) return leave_out(image.file + ": neither PNG nor JPEG");
    out_.images.push_back(std::move(read));
    return static_cast<int>(out_.images.size()) - 1;
  }

  const PolygonMesh& mesh_;
  PlainMaterials out_;
};

}  // namespace

PlainMaterials plain_materials(const PolygonMesh& mesh) { return PlainReader(mesh).read(); }

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
