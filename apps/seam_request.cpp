#include "apps/seam_request.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <vector>

#include "apps/arguments/number_check.h"
#include "apps/arguments/option_table.h"
#include "apps/arguments/suggestion.h"
#include "apps/or_interrupted.h"
#include "majorant/framework/error.h"
#include "majorant/io/read_vertex_lists.h"

namespace majorant::app {
namespace {

constexpr std::string_view kSharp = "sharp", kSharpAngle = "sharp=";

bool is_sharp(const std::string& seams) {
  return seams == kSharp || seams.compare(0, kSharpAngle.size(), kSharpAngle) == 0;
}

double sharp_angle(const std::string& seams) {
  const std::string text = seams.substr(kSharpAngle.size());
  double angle = 0;
  if (!CLI::detail::lexical_cast(text, angle) || !(angle > 0) || !(angle < 180))
    throw Error(
        ErrorKind::Usage,
        fmt::format(
            "--seams {}: '{}' is not an angle between 0 and 180 degrees; write --seams sharp=40",
            seams, text));
  return angle;
}

// Returns the message about a word that is no file but an angle, as `40` or `sharp:40`.
std::string wrong_angle(const std::string& seams) {
  std::error_code ignored;
  if (is_sharp(seams) || std::filesystem::exists(seams, ignored)) return {};
  const std::string angle = seams.substr(std::min(seams.find_first_of("0123456789"), seams.size()));
  double degrees = 0;
  const std::string word = seams.substr(0, seams.size() - angle.size());
  const bool is_word = word.empty() || word.starts_with(kSharp);
  if (!is_word || !CLI::detail::lexical_cast(angle, degrees)) return {};
  return fmt::format("there is no file '{}'; write --seams {}{} for an angle", seams, kSharpAngle,
                     angle);
}

// Returns the message about a word that is neither a known word, an angle nor a file. sharp_angle()
// checks the angles themselves.
std::string wrong_seams(const std::string& seams) {
  if (is_sharp(seams)) return {};
  const std::string fault = wrong_angle(seams);
  return fault.empty() ? word_or_file({"auto", "uv", std::string(kSharp)})(seams) : fault;
}

}  // namespace

void SeamRequest::add_to(CLI::App& verb) {
  add_options(
      verb, OptionGroup::Charts,
      {{"--seams",
        &seams,
        "where to cut: auto; uv: around the islands of the file's texture coordinates; "
        "sharp[=DEGREES]: along edges whose faces meet at that angle or more; FILE: along the "
        "edges of a JSON file {\"edges\": [[0, 1], ...]}",
        {.type = "auto|uv|sharp[=DEG]|FILE", .check = checked_by(wrong_seams)}},
       {"--max-stretch",
        &max_stretch,
        fmt::format("auto, sharp: charts above this mean stretch are cut further, > 1 ({:g})",
                    CutOptions().max_stretch),
        {.check = positive_number()}}});
}

std::string SeamRequest::file() const {
  return seams.empty() || seams == "auto" || seams == "uv" || is_sharp(seams) ? "" : seams;
}

bool SeamRequest::divides() const { return file().empty() && seams != "uv"; }

Strictness SeamRequest::needed_of_file() const {
  return seams == "uv" ? Strictness::Texcoords : Strictness::Shape;
}

CutOptions SeamRequest::options(const PolygonMesh& polygons, const StopCheck& stop) const {
  CutOptions cuts;
  if (max_stretch && !(*max_stretch > 1))
    throw Error(ErrorKind::Usage, fmt::format("--max-stretch {:g}: it must be above 1, the stretch "
                                              "of an isometry; write --max-stretch {:g}",
                                              *max_stretch, cuts.max_stretch));
  if (max_stretch && !file().empty())
    throw Error(ErrorKind::Usage,
                fmt::format("--max-stretch applies to --seams auto and sharp; --seams {} says "
                            "where to cut; leave one of the two out",
                            seams));
  if (max_stretch) cuts.max_stretch = *max_stretch;
  if (seams == "uv") cuts.method = CutMethod::Texture;
  if (is_sharp(seams)) cuts.method = CutMethod::Sharp;
  if (is_sharp(seams) && seams != kSharp) cuts.sharp_angle = sharp_angle(seams);
  if (file().empty()) return cuts;
  cuts.method = CutMethod::Given;
  cuts.edges_source = file();
  cuts.edges = or_interrupted("reading " + file(), [&] {
    return read_seams(file(), static_cast<Index>(polygons.positions.size()), stop);
  });
  return cuts;
}

Json SeamRequest::to_json() const {
  return {{"seams", seams}, {"max_stretch", max_stretch.value_or(CutOptions().max_stretch)}};
}

std::vector<std::string> untextured_in_words(const std::string& file, const SurfaceCuts& cuts) {
  if (cuts.untextured_faces == 0) return {};
  return {fmt::format("{}: {} face{} without texture coordinates, cut as by --seams auto", file,
                      cuts.untextured_faces, cuts.untextured_faces == 1 ? "" : "s")};
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
