#include "apps/check/check_request.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>

#include "apps/arguments/number_check.h"
#include "apps/arguments/option_table.h"
#include "apps/arguments/suggestion.h"
#include "apps/outputs.h"
#include "majorant/certify/map_proof.h"
#include "majorant/framework/error.h"

namespace majorant::app {

void CheckVerb::add_to(CLI::App& verb) {
  constexpr double kHalfTurn = 180;  // degrees
  constexpr double kAnySeconds = std::numeric_limits<double>::infinity();
  add_options(verb, OptionGroup::Files,
              {{"result", &result, "result: " + result_help(), {.required = true}},
               {"--surface", &surface, "the mesh it should be a map of", {.type = "FILE"}},
               {"-o,--output",
                &outputs,
                "the map and what is wrong with it as a page: .html, repeatable",
                {.type = "FILE"}}});
  add_options(
      verb, OptionGroup::Map,
      {{"--cuts",
        &cuts,
        "inner edges whose sides differ: none: violations; free: counted; auto (default): "
        "violations but where the file says that it is cut, and counted where it says nothing",
        {.check = one_of({"auto", "none", "free"})}},
       {"--seamless", &seamless,
        "the map is seamless, its seams are no cuts (implied where the file claims it)"},
       {"--stacked", &stacked,
        "charts may lie exactly on others, mirrored ones, too: counted, no overlaps (implied where "
        "the file claims it)"},
       {"--objects",
        &objects,
        "separate: each object of an OBJ (o), mesh of a glTF or object that a VTU claims has a "
        "layout of its own, which may lie on those of others; together (default): there is one",
        {.check = one_of({"together", "separate"}), .excludes = {"--stacked"}}},
       {"--time-limit",
        &time_limit,
        "seconds; what is not decided by then is said to be undecided",
        {.check = non_negative_number(kAnySeconds)}}});
  add_options(verb, OptionGroup::Files, {distortion_option(&distortion)});
  add_options(
      verb, OptionGroup::Map,
      {{"--quads", &quads,
        "a mesh of quads (implied where a file has nothing but quads, and no texture coordinates): "
        "oriented manifold, none folded; with --surface none turned, Euler characteristic and "
        "border of the surface, near it"},
       {"--max-distance",
        &max_distance,
        "of meshes of quads: how far they and --surface may be apart, as a part of its diagonal "
        "(0.02)",
        {.check = non_negative_number(std::numeric_limits<double>::max())}},
       {"--border-corners",
        &border_corners,
        "of meshes of quads: a turn of --surface's border, in degrees, from which on they have a "
        "vertex there, as `quads` has it (35)",
        {.type = "DEG", .check = positive_number(kHalfTurn)}},
       {"--features",
        &features,
        "of meshes of quads: feature lines of --surface that edges of quads must cover, as `quads` "
        "has them",
        {.type = "DEG|FILE|none"}},
       {"--certify", &certify, "prove global injectivity as well"}});
  common.add_to(verb);
}

void CheckVerb::require_of_quads() const {
  const auto refuse = [&](std::string_view flag) {
    throw Error(
        ErrorKind::Usage,
        fmt::format("{}: is of maps, and {} is a mesh of quads; leave it out", flag, result));
  };
  if (seamless) refuse("--seamless");
  if (certify) refuse("--certify");
  if (stacked) refuse("--stacked");
  if (objects != "together") refuse("--objects");
  if (cuts != "auto") refuse("--cuts");
  if (!distortion.empty()) refuse("--distortion");
  if (!outputs.empty()) refuse("-o");
}

CheckRequest::Cuts CheckVerb::cut_rule() const {
  if (cuts == "free") return CheckRequest::Cuts::Free;
  return cuts == "none" ? CheckRequest::Cuts::None : CheckRequest::Cuts::Auto;
}

Json CheckVerb::to_json() const {
  return {{"surface", surface},
          {"cuts", cuts},
          {"certify", certify},
          {"seamless", seamless},
          {"stacked", stacked},
          {"objects", objects},
          {"quads", quads},
          {"features", features},
          {"strict", common.strict},
          {"max_distance", max_distance ? Json(*max_distance) : Json()},
          {"border_corners", border_corners ? Json(*border_corners) : Json()}};
}

namespace {

// "no overlaps, 3 charts (45 cut edges, length 3.21); proven: positive (486 cells), ...; not asked:
// surface (--surface)".
std::string in_words(const MapCheck& check) {
  const MapProof& proof = check.proof;
  // Found out whether that was asked or not.
  std::string text = check.report.result["overlaps"].get<std::string>() + check.overlap_in_words();
  if (const CutCount& cuts = proof.cuts; cuts.others > 0)
    text += fmt::format(", {} ({}, length {:.4g}{})", count_text(cuts.charts, "chart"),
                        count_text(cuts.others, "cut edge"), cuts.length,
                        check.has_untold_cuts ? ", not told from tears" : "");
  if (const StackedCharts& stacks = proof.stacks; stacks.stacks > 0)
    text += fmt::format(", {} of {}, {} mirrored", count_text(stacks.stacks, "stack"),
                        count_text(stacks.stacked, "chart"), stacks.mirrored);
  std::string proven, open;
  for (const auto& [question, finding] : proof.findings()) {
    if (finding->answer == ProofStatus::Proven)
      proven += fmt::format("{}{} ({})", proven.empty() ? "" : ", ", question, finding->detail);
    if (finding->answer == ProofStatus::NotRequested && question == "surface")
      open = "; not asked: surface (--surface)";
  }
  return fmt::format("{}; proven: {}{}", text, proven, open);
}

}  // namespace

std::string verdict_of(const CheckVerb& request, const MapFile& file, const MapCheck& check) {
  const std::vector<std::string>& list = check.findings.list();
  if (list.empty())
    return fmt::format("{}: valid, degree {}: {}; {}{}", request.result, file.degree,
                       in_words(check), describe(check.energy), seam_summary(check.report.result));
  const bool is_torn = check.proof.continuous.answer == ProofStatus::Violated;
  return fmt::format("{}: {}: {}{}{}", request.result, check.status(), fmt::join(list, "; "),
                     check.overlap_in_words(),
                     is_torn ? "; if the map is meant to be cut there, add --cuts free" : "");
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
