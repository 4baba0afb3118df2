#include "majorant/results/internal/check_map.h"

#include <fmt/format.h>

#include "majorant/framework/error.h"
#include "majorant/io/layout_scale.h"
#include "majorant/io/map_distortion.h"
#include "majorant/mesh/refusal.h"
#include "majorant/results/internal/check_claims.h"
#include "majorant/results/internal/global_verdict.h"
#include "majorant/results/internal/write_map.h"

namespace majorant {
namespace {

// Whether nothing says where a map is cut: files that claim nothing, and atlases of the time before
// there was the claim `cuts`.
bool is_untold(const MapFile& file, const Claims& claims) {
  const bool says_nothing = !claims.version && !claims.seams;
  return !claims.cuts && (says_nothing || file.chart.size() > 0);
}

void ask_about_cuts(const MapFile& file, const CheckRequest& request, const Claims& claims,
                    ProofRequest& wanted) {
  const bool is_seamless = request.seamless || claims.seams.value_or(false);
  const CutRule none = is_seamless ? CutRule::Seams : CutRule::Nothing;
  const CutRule free = is_seamless ? CutRule::SeamsOrFree : CutRule::Free;
  switch (request.cuts) {
    case CheckRequest::Cuts::Auto:
      wanted.cuts = is_seamless || !(claims.cuts || is_untold(file, claims)) ? none : free;
      wanted.cut_edges = claims.cuts;
      break;
    case CheckRequest::Cuts::None:
      wanted.cuts = none;
      break;
    case CheckRequest::Cuts::Free:
      wanted.cuts = free;
      break;
  }
}

ProofRequest questions(const MapFile& file, const CheckRequest& request, const Claims& claims,
                       const StopCheck& stop) {
  ProofRequest wanted;
  wanted.surface = request.surface;
  ask_about_cuts(file, request, claims, wanted);
  const bool is_forbidden = request.certify || claims.bijective.value_or(false);
  wanted.overlap =
      is_forbidden ? ProofRequest::Overlap::Forbidden : ProofRequest::Overlap::Reported;
  if (const std::string e = extension(request.name); e == ".vtu" || e == ".pvtu")
    wanted.labels = ProofRequest::FaceLabels::Compared;
  wanted.stop = stop;
  return wanted;
}

MapProof proven(const MapFile& file, const CheckRequest& request, const Claims& claims,
                const RunRecord& record) {
  record.begin(Activity::Proving);
  return {file, request.name, questions(file, request, claims, record.stop())};
}

// At the scale of its claims, or a scale of its own.
Json measured_distortion(const MapFile& file) {
  const MapDistortion measured = measure_distortion(file);
  Json section = distortion_section({&measured}, layout_scale(file));
  section["scale_is_assumed"] = has_assumed_scale(file);
  return section;
}

// Whether the file is what a map makes of the plane, as `.msh` has it: the identity of itself.
bool is_image(const MapFile& file) {
  const auto corners = file.cells.leftCols(3).reshaped();
  return file.points(corners, 2).isZero(0) &&
         file.points(corners, Eigen::seqN(0, 2)) == file.uv(corners, Eigen::all);
}

void require_surface(const MapCheck& check, const MapFile& file, const CheckRequest& request) {
  if (check.proof.surface.answer == ProofStatus::Violated && extension(request.name) == ".msh" &&
      is_image(file))
    throw Refusal(
        ErrorKind::Unsupported, request.name,
        fmt::format("{}: this is the image of a map, in the plane: there is no surface in "
                    "it to compare with {}; ",
                    request.name, request.surface->file),
        Hint::WriteSurface);
}

void add_proofs(MapCheck& check) {
  for (const auto& [question, finding] : check.proof.findings()) {
    if (finding->answer == ProofStatus::Violated)
      check.findings.add_violation(fmt::format("{}: {}", question, finding->detail));
    if (finding->answer == ProofStatus::Undecided)
      check.findings.add_open(
          fmt::format("{}: could not be decided: {}", question, finding->detail));
    check.report["proofs"][question] = {{"answer", name_of(finding->answer)},
                                        {"detail", finding->detail}};
  }
  const CutCount& cuts = check.proof.cuts;
  check.report["cuts"] = {{"seam_edges", cuts.seams},
                          {"other_edges", cuts.others},
                          {"length", cuts.length},
                          {"charts", cuts.charts},
                          {"told_from_tears", !check.has_untold_cuts}};
}

// What there is a map of, and what is claimed of that.
void add_measures(MapCheck& check, const MapFile& file, const CheckRequest& request,
                  const StopCheck& stop) {
  if (!check.proof.map()) return;
  const BezierMap& map = *check.proof.map();
  check.measures.emplace();
  check.energy = measure_as_claimed(file, map, check.claims, stop, check.findings, *check.measures);
  Json result = measures_section(map, *check.measures, check.energy.name);
  add_energy(check.energy, result);
  if (check.proof.global) add_global_injectivity(result, map, *check.measures, *check.proof.global);
  if (!check.measures->cut_short && request.reported)
    result["distortion"] = measured_distortion(file);
  check.report["result"] = result;
  if (check.proof.surface.answer == ProofStatus::Violated) return;  // claims are about another mesh
  check_claims({file, map, *check.measures, check.claims, request.surface, check.proof.cuts},
               check.findings);
}

}  // namespace

MapCheck::MapCheck(const MapFile& file, const CheckRequest& request, const RunRecord& record)
    : claims(parse_claims(file.claims, request.name)),
      report{{"schema_version", 1}, {"version", MAJORANT_VERSION}, {"command", "check"}},
      proof(proven(file, request, claims, record)) {
  require_surface(*this, file, request);
  has_untold_cuts =
      proof.cuts.others > 0 && request.cuts == CheckRequest::Cuts::Auto && is_untold(file, claims);
  add_proofs(*this);
  record.begin(Activity::Measuring);
  add_measures(*this, file, request, record.stop());
  const std::vector<std::string>& list = findings.list();
  report["status"] = status();
  report["message"] = list.empty() ? "" : list.front();
  report["findings"] = list;
  std::vector<std::string> warnings = file.warnings;
  if (request.surface)
    warnings.insert(warnings.end(), request.surface->warnings.begin(),
                    request.surface->warnings.end());
  report["warnings"] = warnings;
}

std::string_view MapCheck::status() const {
  if (findings.list().empty()) return "valid";
  return findings.violated() ? "invalid" : "undecided";
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
