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
               {"--surface", &surface, "the mesh that the result is a map of", {.type = "FILE"}},
               {"-o,--output",
                &outputs,
                "page of the map and its faults: .html, repeatable",
                {.type = "FILE"}}});
  add_options(
      verb, OptionGroup::Map,
      {{"--cuts",
        &cuts,
        "how to judge an inner edge whose sides differ: none: a violation; free: a cut, which is "
        "counted; auto: a violation unless the file claims a cut there, a cut if it claims nothing "
        "(auto)",
        {.check = one_of({"auto", "none", "free"})}},
       {"--seamless", &seamless,
        "treat the map as seamless, whose seams are no cuts (implied if the file claims it)"},
       {"--stacked", &stacked,
        "allow charts that lie exactly on others, mirrored ones, too: they are counted, and are no "
        "overlaps (implied if the file claims it)"},
       {"--objects",
        &objects,
        "separate: each object of an OBJ (o), mesh of a glTF or object that a VTU claims has its "
        "own layout, which may lie on others; together: all share one (together)",
        {.check = one_of({"together", "separate"}), .excludes = {"--stacked"}}},
       {"--time-limit",
        &time_limit,
        "time limit in seconds; questions still open are reported as undecided",
        {.check = non_negative_number(kAnySeconds)}}});
  add_options(verb, OptionGroup::Files, {distortion_option(&distortion)});
  add_options(
      verb, OptionGroup::Map,
      {{"--quads", &quads,
        "check a quad mesh (implied if a file has quads alone and no texture coordinates): an "
        "oriented manifold without folded quads; with --surface also none turned over, with the "
        "Euler characteristic and border of the surface, and near it"},
       {"--max-distance",
        &max_distance,
        "quads: largest distance between them and --surface, as a part of its diagonal (0.02)",
        {.check = non_negative_number(std::numeric_limits<double>::max())}},
       {"--border-corners",
        &border_corners,
        "quads: turn of the border of --surface, in degrees, from which on they need a vertex "
        "there, as for the verb quads (35)",
        {.type = "DEG", .check = positive_number(kHalfTurn)}},
       {"--features",
        &features,
        "quads: feature lines of --surface that edges of quads must cover, as for the verb quads",
        {.type = "DEG|FILE|none"}},
       {"--certify", &certify, "also prove global injectivity"}});
  common.add_to(verb);
}

void CheckVerb::require_of_quads() const {
  const auto refuse = [&](std::string_view flag) {
    throw Error(
        ErrorKind::Usage,
        fmt::format("{}: applies to maps, and {} is a quad mesh; leave it out", flag, result));
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

// Returns the details of a valid map: "no overlaps, 3 charts (45 cut edges, length 3.21); proven:
// positive (486 cells), ...; not tested: surface (add --surface)".
std::string in_words(const MapCheck& check) {
  const MapProof& proof = check.proof;
  // Overlaps are decided in every run.
  std::string text = check.report.result["overlaps"].get<std::string>() + check.overlap_in_words();
  if (const CutCount& cuts = proof.cuts; cuts.others > 0)
    text += fmt::format(", {} ({}, length {:.4g}{})", count_text(cuts.charts, "chart"),
                        count_text(cuts.others, "cut edge"), cuts.length,
                        check.has_untold_cuts ? ", which may be tears" : "");
  if (const StackedCharts& stacks = proof.stacks; stacks.stacks > 0)
    text += fmt::format(", {} of {}, {} mirrored", count_text(stacks.stacks, "stack"),
                        count_text(stacks.stacked, "chart"), stacks.mirrored);
  std::string proven, open;
  for (const auto& [question, finding] : proof.findings()) {
    if (finding->answer == ProofStatus::Proven)
      proven += fmt::format("{}{} ({})", proven.empty() ? "" : ", ", question, finding->detail);
    if (finding->answer == ProofStatus::NotRequested && question == "surface")
      open = "; not tested: surface (add --surface)";
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
