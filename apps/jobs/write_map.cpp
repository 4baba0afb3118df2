#include "majorant/apps/jobs/write_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <memory>
#include <string_view>

#include "majorant/apps/jobs/corner_vertices.h"
#include "majorant/framework/error.h"
#include "majorant/io/claims.h"
#include "majorant/io/gltf_layout.h"
#include "majorant/io/io.h"
#include "majorant/mesh/repair.h"
#include "majorant/pictures/first_view.h"

namespace majorant {

std::string extension(const std::string& path) {
  std::string e = std::filesystem::path(path).extension().string();
  std::transform(e.begin(), e.end(), e.begin(), [](unsigned char c) { return std::tolower(c); });
  return e;
}

bool is_straight_map_data(const std::string& path) {
  constexpr std::array<std::string_view, 4> kStraight = {".obj", ".ply", ".glb", ".gltf"};
  return std::find(kStraight.begin(), kStraight.end(), extension(path)) != kStraight.end();
}

bool is_gltf(const std::string& path) {
  return extension(path) == ".glb" || extension(path) == ".gltf";
}

bool is_map_data(const std::string& path) {
  return is_straight_map_data(path) || extension(path) == ".vtu" || extension(path) == ".msh";
}

ProofRequest::FaceLabels labels_in(const std::string& path) {
  const std::string e = extension(path);
  return e == ".vtu" || e == ".msh" ? ProofRequest::FaceLabels::Compared
                                    : ProofRequest::FaceLabels::Ignored;
}

ProofRequest promise_of(const MapFile& map, const PolygonMesh& surface, const std::string& name) {
  const Claims claims = parse_claims(map.claims, name);
  ProofRequest promise;
  if (claims.stacks) promise.stacks = ProofRequest::Stacks::Allowed;
  const MapProof proof(
      map, name,
      {.cuts = CutRule::SeamsOrFree, .cut_edges = claims.cuts, .stacks = promise.stacks});
  const bool is_torn = proof.continuous.answer == ProofStatus::Violated;
  promise.surface = &surface;
  promise.orientation = Orientation::AsGiven;
  if (proof.cuts.seams > 0) promise.cuts = CutRule::Seams;
  if (proof.cuts.others > 0 && !is_torn) promise.cuts = CutRule::SeamsOrFree;
  if (claims.bijective.value_or(false)) promise.overlap = ProofRequest::Overlap::Forbidden;
  return promise;
}

Overlap allowed_overlap(const ProofRequest& promise) {
  return promise.overlap == ProofRequest::Overlap::Forbidden ? Overlap::Excluded : Overlap::Allowed;
}

FileVerification proof_of_file(const std::string& path, const ProofRequest& promise,
                               const MapFile& map, const MapFormats& formats) {
  if (extension(path) != ".msh" || formats.msh != MshContent::Image)
    return certification(path, promise, nullptr);
  if (promise.surface == nullptr) return certification(path, promise, &map);
  const auto named =
      std::make_shared<const MapFile>(with_corner_vertices(map, *promise.surface).value_or(map));
  return [named, verify = certification(path, promise, named.get())](const std::string& temporary) {
    verify(temporary);
  };
}

std::vector<std::string> left_out(const std::string& path, const MapFile& map,
                                  const MapFormats& formats, const PolygonMesh* input) {
  if (extension(path) == ".msh" && formats.msh == MshContent::Image) return {"the surface"};
  std::vector<std::string> what;
  if (is_straight_map_data(path) && map.degree > 1)
    what.emplace_back("curves, but straight pieces of them");
  if (is_gltf(path) && input != nullptr)
    for (std::string& part : left_out_of_gltf(*input)) what.push_back(std::move(part));
  return what;
}

std::vector<Index> split_faces(const std::vector<std::string>& paths, const MapFile& map,
                               const PolygonMesh* input, const MapFormats& formats) {
  const auto keeps_polygons = [](const std::string& path) {
    return extension(path) == ".obj" || extension(path) == ".ply";
  };
  if (input == nullptr || !std::any_of(paths.begin(), paths.end(), keeps_polygons)) return {};
  try {
    return split_polygons(map, *input, formats.tessellation);
  } catch (const Error&) {  // the files are refused, and say why
    return {};
  }
}

std::string split_in_words(const std::vector<Index>& faces) {
  std::string list;
  for (std::size_t k = 0; k < faces.size() && k < kNamedPlaces; ++k)
    list += fmt::format("{}{}", k == 0 ? "" : ", ", faces[k] + 1);
  if (faces.size() > kNamedPlaces) list += ", ...";
  return faces.size() == 1
             ? fmt::format("1 face of the input is triangles in .obj and .ply (face {})", list)
             : fmt::format("{} faces of the input are triangles in .obj and .ply (faces {})",
                           faces.size(), list);
}

void write_map(const std::string& path, const MapFile& map, const PolygonMesh* input,
               const MapFormats& formats, const FileVerification& verify) {
  const std::string e = extension(path);
  if (e == ".vtu" || e == ".msh") {
    const auto named = input ? with_corner_vertices(map, *input) : std::nullopt;
    const MapFile& written = named ? *named : map;
    if (e == ".vtu") write_vtu(path, written, formats.vtu, verify);
    if (e == ".msh") write_msh(path, written, formats.msh, verify);
  }
  if (e == ".obj") write_obj(path, map, input, formats.tessellation, verify);
  if (e == ".ply") write_ply(path, map, input, formats.tessellation, verify);
  if (is_gltf(path)) write_gltf(path, map, input, formats.tessellation, verify);
  if (e == ".svg") write_svg(path, map, formats.svg);
  if (e == ".png") {
    PngOptions png = formats.png;
    if (formats.view_is_chosen) png.view = first_view(map);
    write_png(path, map, png);
  }
  if (e == ".html") {
    MapPage page = formats.page;
    page.map = map;
    page.alignment = formats.svg.alignment;
    page.quantity = formats.svg.quantity;
    page.color_range = formats.svg.color_range;
    write_page(path, page);
  }
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
