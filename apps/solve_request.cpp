#include "apps/solve_request.h"

#include <fmt/format.h>

#include <vector>

#include "apps/arguments/number_check.h"
#include "apps/arguments/option_table.h"
#include "apps/arguments/suggestion.h"
#include "apps/page_content.h"
#include "majorant/framework/energy_term.h"
#include "majorant/framework/error.h"

namespace majorant::app {

void SolveRequest::add_to(CLI::App& verb, std::string& curvature) {
  add_options(verb, OptionGroup::Map,
              {{"--bijective", &bijective, "keep the image free of overlaps"},
               {"--no-flips", &no_flips,
                "with --bijective: do not flip edges of the scaffold, for comparisons"},
               {"--write-scaffold",
                &scaffold_file,
                "with --bijective: write the triangulated space around the image, .vtu or .svg",
                {.type = "FILE"}},
               {"--improve-mesh", &improve_mesh,
                "flip edges inside flat parts of the surface where that lowers the energy"}});
  add_options(verb, OptionGroup::Pictures,
              {{"--snapshots",
                &snapshots,
                "show the map after every K iterations in the page, .html",
                {.type = "K", .check = whole_number(1)}}});
  add_limits_to(verb, curvature);
}

void SolveRequest::add_effort_to(CLI::App& verb) {
  add_options(verb, OptionGroup::Solver,
              {{"--effort",
                &effort,
                "high: take several paths at degree 1 and keep the one that ends at the lowest "
                "energy, in some ten times the time (normal)",
                {.check = one_of({"normal", "high"})}}});
}

void SolveRequest::add_limits_to(CLI::App& verb, std::string& curvature) {
  add_options(
      verb, OptionGroup::Solver,
      {{"--curvature",
        &curvature,
        "second-order model of Newton's method (projected)",
        {.check = one_of(curvature_choices())}},
       {"--elevation",
        &elevation,
        "raise the degree one by one, or at once (incremental)",
        {.check = one_of({"incremental", "direct"})}},
       {"--tolerance",
        &tolerance,
        fmt::format("stop when the estimated decrease that is left is this part of the energy ({})",
                    tolerance),
        {.check = positive_number()}},
       {"--max-iterations",
        &max_iterations,
        fmt::format("limit of iterations, over all degrees together ({})", max_iterations),
        {.check = whole_number(0)}},
       {"--time-limit",
        &time_limit,
        "time limit in seconds; the best valid map is written, if there is one",
        {.check = non_negative_number()}}});
}

void SolveRequest::apply(ParametrizationOptions& options) const {
  if (elevation == "direct") options.solve.elevation = Elevation::Direct;
  options.solve.tolerance = tolerance;
  if (effort == "high") options.solve.effort = Effort::High;
  if (bijective) options.map.injectivity = MapInjectivity::Global;
  if (no_flips) options.solve.scaffold_flips = ScaffoldFlips::Omitted;
  if (!scaffold_file.empty()) options.solve.scaffold = ScaffoldUse::FromTheStart;
  if (improve_mesh) options.solve.triangles = Triangles::Flipped;
}

Json SolveRequest::to_json() const {
  return {
      {"improve_mesh", improve_mesh}, {"elevation", elevation},           {"bijective", bijective},
      {"no_flips", no_flips},         {"write_scaffold", scaffold_file},  {"snapshots", snapshots},
      {"tolerance", tolerance},       {"max_iterations", max_iterations}, {"effort", effort}};
}

void SolveRequest::require_usable(const OutputRequest& outputs, const MapRequest& map) const {
  const auto refuse = [](const char* what) { throw Error(ErrorKind::Usage, what); };
  if (no_flips && !bijective) refuse("--no-flips needs --bijective");
  if (improve_mesh && !map.weights.empty())
    refuse("--improve-mesh changes the faces that --weights are for; leave one of the two out");
  if (snapshots > 0 && !has_page(outputs.files))
    refuse("--snapshots needs a page; add -o OUT.html");
  if (snapshots > 0 && improve_mesh)
    refuse("--improve-mesh changes the triangles that --snapshots show; leave one of the two out");
  if (scaffold_file.empty()) return;
  if (!bijective) refuse("--write-scaffold needs --bijective");
  if (outputs.normalize) refuse("--normalize moves the map away from its scaffold; leave it out");
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
