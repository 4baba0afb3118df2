#include "majorant/apps/jobs/write_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <memory>

#include "majorant/apps/jobs/corner_vertices.h"
#include "majorant/framework/error.h"
#include "majorant/io/claims.h"
#include "majorant/io/gltf_layout.h"
#include "majorant/mesh/repair.h"
#include "majorant/pictures/first_view.h"
#include "majorant/pictures/large_page.h"

namespace majorant {

std::string extension(const std::string& path) {
  std::string e = std::filesystem::path(path).extension().string();
  std::transform(e.begin(), e.end(), e.begin(), [](unsigned char c) { return std::tolower(c); });
  return e;
}

const Format* written_format(const std::string& path) { return find_format(extension(path)); }

bool is_map_data(const std::string& path) {
  const Format* const format = written_format(path);
  return format && format->write_map;
}

bool is_straight_map_data(const std::string& path) {
  return is_map_data(path) && !written_format(path)->has_curves;
}

bool is_gltf(const std::string& path) {
  const Format* const format = written_format(path);
  return format && format->materials == Format::Materials::Inside;
}

bool is_shown_as(Format::Picture picture, const std::string& path) {
  const Format* const format = written_format(path);
  return format && format->picture == picture;
}

bool has_material_files(const std::string& path) {
  const Format* const format = written_format(path);
  return format && format->materials == Format::Materials::InFilesBeside;
}

ProofRequest::FaceLabels labels_in(const std::string& path) {
  const Format* const format = written_format(path);
  return format && format->has_labels ? ProofRequest::FaceLabels::Compared
                                      : ProofRequest::FaceLabels::Ignored;
}

namespace {

// Returns whether the file holds the image of the map instead of its surface.
bool is_image(const std::string& path, const MapFormats& formats) {
  const Format* const format = written_format(path);
  return format && format->has_image_of_map && formats.msh == MshContent::Image;
}

}  // namespace

ProofRequest proof_request(const MapFile& map, const PolygonMesh& surface,
                           const std::string& name) {
  const Claims claims = parse_claims(map.claims, name);
  ProofRequest request;
  if (claims.stacks) request.stacks = ProofRequest::Stacks::Allowed;
  const MapProof proof(
      map, name,
      {.cuts = CutRule::SeamsOrFree, .cut_edges = claims.cuts, .stacks = request.stacks});
  const bool is_torn = proof.continuous.answer == ProofStatus::Violated;
  request.surface = &surface;
  request.orientation = Orientation::AsGiven;
  if (proof.cuts.seams > 0) request.cuts = CutRule::Seams;
  if (proof.cuts.others > 0 && !is_torn) request.cuts = CutRule::SeamsOrFree;
  if (claims.bijective.value_or(false)) request.overlap = ProofRequest::Overlap::Forbidden;
  return request;
}

Overlap allowed_overlap(const ProofRequest& request) {
  return request.overlap == ProofRequest::Overlap::Forbidden ? Overlap::Excluded : Overlap::Allowed;
}

FileVerification proof_of_file(const std::string& path, const ProofRequest& request,
                               const MapFile& map, const MapFormats& formats) {
  if (!is_image(path, formats)) return certification(path, request, nullptr);
  if (request.surface == nullptr) return certification(path, request, &map);
  const auto named =
      std::make_shared<const MapFile>(with_corner_vertices(map, *request.surface).value_or(map));
  return [named, verify = certification(path, request, named.get())](const std::string& temporary) {
    verify(temporary);
  };
}

std::vector<std::string> left_out(const std::string& path, const MapFile& map,
                                  const MapFormats& formats, const PolygonMesh* input) {
  if (is_image(path, formats)) return {"the surface"};
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
    return is_map_data(path) && written_format(path)->has_polygons;
  };
  if (input == nullptr || !std::any_of(paths.begin(), paths.end(), keeps_polygons)) return {};
  try {
    return split_polygons(map, *input, formats.tessellation);
  } catch (const Error&) {  // writing these files reports the error
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

std::string write_map(const std::string& path, const MapFile& map, const PolygonMesh* input,
                      const MapFormats& formats, const FileVerification& verify) {
  if (is_map_data(path)) {
    const bool is_labelled = input && written_format(path)->has_labels;
    const auto named = is_labelled ? with_corner_vertices(map, *input) : std::nullopt;
    write_map_file(path, named ? *named : map, input, formats, verify);
    return {};
  }
  using Picture = Format::Picture;
  if (is_shown_as(Picture::Drawing, path)) write_svg(path, map, formats.svg);
  if (is_shown_as(Picture::Image, path)) {
    PngOptions png = formats.png;
    if (formats.view_is_chosen) png.view = first_view(map);
    write_png(path, map, png);
  }
  if (is_shown_as(Picture::Page, path)) {
    MapPage page = formats.page;
    page.map = map;
    page.alignment = formats.svg.alignment;
    page.quantity = formats.svg.quantity;
    page.color_range = formats.svg.color_range;
    return write_page_or_coarser(path, page);
  }
  return {};
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
