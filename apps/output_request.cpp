#include "apps/output_request.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "apps/arguments/option_table.h"
#include "majorant/apps/jobs/model_texture.h"
#include "majorant/apps/jobs/write_map.h"
#include "majorant/framework/error.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/files_below.h"

namespace majorant::app {

void OutputRequest::add_to(CLI::App& verb) {
  add_options(verb, OptionGroup::Files,
              {{"output", &positional, "output file, same as -o"},
               {"-o,--output", &files, output_help(extensions), {.type = "FILE"}}});
  formats.add_to(verb);
  add_options(verb, OptionGroup::Files,
              {distortion_option(&distortion),
               {"--normalize", &normalize,
                "move, turn and scale the result into the unit square; it is not turned with "
                "--align no, with seams or with a fixed boundary"}});
}

// Returns the map formats that hold coordinates as doubles.
std::vector<std::string> exact_formats() {
  std::vector<std::string> out;
  for (const Format& format : formats())
    if (serves(format, FormatUse::WriteMap) && !format.has_floats) out.push_back(format.extension);
  return out;
}

void require_holds_seams(const std::vector<std::string>& files) {
  for (const std::string& path : files)
    if (const Format* format = written_format(path); format && format->has_floats)
      throw Error(ErrorKind::Usage,
                  fmt::format("{}: holds floats, in which the sides of seams do not fit; write {}",
                              path, in_words(exact_formats(), "or")));
}

std::vector<OutputNames> OutputRequest::names() const {
  return {{files, extensions}, {{distortion}, {".csv"}}};
}

void OutputRequest::require_usable(const MapRequest& map) {
  if (!positional.empty()) files.push_back(positional);
  if (map.seamless) require_holds_seams(files);
  require_some_output(files, extensions);
  formats.require_effect(files);
  if (normalize && !(map.pins.empty() && map.handles.empty()))
    throw Error(ErrorKind::Usage, "--normalize moves pins and handles; leave one of the two out");
  if (!turns_map()) return;
  if (!(map.pins.empty() && map.handles.empty()))
    throw Error(ErrorKind::Usage,
                "--align turns pins and handles in data files and pages; leave one of the two out");
  if (map.boundary == "fixed")
    throw Error(ErrorKind::Usage,
                "--align turns the boundary that --boundary fixed holds, in data files and pages; "
                "leave one of the two out");
}

bool OutputRequest::turns(const BezierMap& result, const MapRequest& map) const {
  const bool is_free = map.boundary != "fixed" && result.seams().trivial();
  return turns_map() || (normalize && formats.svg.alignment == Alignment::Automatic && is_free);
}

void OutputRequest::require_materials(const PolygonMesh& input) const {
  if (std::any_of(files.begin(), files.end(), has_material_files)) require_materials_below(input);
}

std::vector<std::string> OutputRequest::stale_pictures(const PolygonMesh& input,
                                                       const std::string& remedy) const {
  const auto obj = std::find_if(files.begin(), files.end(), has_material_files);
  if (obj == files.end()) return {};
  const std::vector<std::string> pictures = shown_pictures(input);
  if (pictures.empty()) return {};
  return {fmt::format("{}: {} the old layout, and {} would show {} by the new one; {}", input.file,
                      pictures.size() == 1
                          ? fmt::format("its picture {} fits", pictures.front())
                          : fmt::format("its pictures ({}) fit", fmt::join(pictures, ", ")),
                      *obj, pictures.size() == 1 ? "it" : "them", remedy)};
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
