#include "apps/compare/two_results.h"

#include <memory>
#include <string>
#include <vector>

#include "apps/compare/matched_maps.h"
#include "apps/outputs.h"
#include "apps/page_content.h"
#include "apps/run.h"
#include "majorant/io/claims.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/io.h"

namespace majorant::app {
namespace {

// Pages hold a value per control point; claims of the file describe it.
MapPage page_of(const std::string& path, const MapFile& map) {
  MapPage page;
  page.title = page_title(path);
  page.map = map;
  page.points = claimed_points(parse_claims(map.claims, path), map);
  return page;
}

}  // namespace

int compare_results(const CompareRequest& request) {
  const std::vector<std::string> extensions{".html", ".svg"};
  if (const std::string e = extension(request.other); e == ".csv" || e == ".html" || e == ".json")
    throw Error(
        ErrorKind::Usage,
        fmt::format("{0}: the second word is a result to compare; write -o {0}", request.other));
  require_some_output(request.outputs, extensions);
  request.formats.require_effect(request.outputs);
  const RunPlan plan{.command = "compare",
                     .common = request.common,
                     .inputs = {request.map.input, request.other},
                     .outputs = {{request.outputs, extensions}},
                     .stages = {}};
  return run_verb(plan, [&](Run& run) {
    const auto read = [&](const std::string& path) {
      return run.read(path,
                      [&] { return read_map(path, run.stop(), request.common.strictness()); });
    };
    const MapFile map = read(request.map.input);
    const auto page = std::make_shared<MapPage>(page_of(request.map.input, map));
    page->quantity = request.formats.svg.quantity;
    page->color_range = request.formats.svg.color_range;
    page->other = std::make_shared<MapPage>(page_of(
        request.other, matched_to(map, request.map.input, read(request.other), request.other)));
    Made made{.report = {.status = "done",
                         .input = {{"file", request.map.input}},
                         .options = {{"other", request.other}}}};
    for (const std::string& path : request.outputs)
      made.files.push_back({path, [&request, path, page] {
                              if (extension(path) == ".html") return write_page(path, *page);
                              const auto captioned = [](const MapPage& of) {
                                return CaptionedMap{of.map, of.title, of.points};
                              };
                              write_svg(path, MapPair{captioned(*page), captioned(*page->other)},
                                        request.formats.svg);
                            }});
    return made;
  });
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
