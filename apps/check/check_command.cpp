// majorant check RESULT: proves and measures a finished map again, from the file alone. Claims of
// the file describe; what is proven is decided from points and uv (io/map_proof.h).
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "apps/arguments/number_check.h"
#include "apps/arguments/suggestion.h"
#include "apps/check/check_claims.h"
#include "apps/command.h"
#include "apps/energy_option.h"
#include "apps/global_verdict.h"
#include "apps/outputs.h"
#include "apps/page_content.h"
#include "apps/process.h"
#include "apps/progress.h"
#include "apps/report.h"
#include "apps/streams.h"
#include "apps/unless_stopped.h"
#include "majorant/framework/thread_count.h"
#include "majorant/io/layout_scale.h"
#include "majorant/io/map_distortion.h"
#include "majorant/io/map_file.h"
#include "majorant/io/map_proof.h"
#include "majorant/io/read_mesh.h"

namespace majorant::app {
namespace {

struct Request {
  CommonOptions common;
  std::string result, surface, distortion;
  std::string cuts;                  // none, free or, where nothing is said, empty
  std::vector<std::string> outputs;  // pages
  double time_limit = std::numeric_limits<double>::infinity();
  bool certify = false, seamless = false;
};

// Without a surface nothing says where a file that claims nothing should be continuous: its cuts
// are counted and named then.
CutRule cut_rule(const Request& request, const Claims& claims, bool is_seamless) {
  const bool says_nothing = !claims.version && !claims.seams;
  const bool free =
      request.cuts == "free" || (request.cuts.empty() && request.surface.empty() && says_nothing);
  if (free) return is_seamless ? CutRule::SeamsOrFree : CutRule::Free;
  return is_seamless ? CutRule::Seams : CutRule::Nothing;
}

struct Check {
  const Request& request;
  const MapFile& file;
  const Claims& claims;
  const std::optional<PolygonMesh>& surface;
  Findings findings = {};
  Json report = {};
  std::optional<MapMeasures> measures = {};
  std::optional<MapProof> proof = {};
};

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

void prove(Check& check, const StopCheck& stop) {
  const bool is_seamless = check.request.seamless || check.claims.seams.value_or(false);
  ProofRequest wanted;
  if (check.surface) wanted.surface = &*check.surface;
  wanted.cuts = cut_rule(check.request, check.claims, is_seamless);
  if (check.request.certify || check.claims.bijective.value_or(false))
    wanted.overlap = ProofRequest::Overlap::Forbidden;
  else if (!check.request.common.report.empty() || !check.request.outputs.empty())
    wanted.overlap = ProofRequest::Overlap::Reported;
  if (extension(check.request.result) == ".vtu") wanted.labels = ProofRequest::FaceLabels::Compared;
  wanted.stop = stop;
  check.proof.emplace(check.file, check.request.result, wanted);
  if (check.proof->surface.answer == Answer::Violated &&
      extension(check.request.result) == ".msh" && is_image(check.file))
    throw Error(
        ErrorKind::Unsupported,
        fmt::format("{}: this is the image of a map, in the plane: there is no surface in it "
                    "to compare with {}; write it with --msh surface, or leave --surface out",
                    check.request.result, check.request.surface));
  for (const auto& [question, finding] : check.proof->findings()) {
    if (finding->answer == Answer::Violated)
      check.findings.add_violation(fmt::format("{}: {}", question, finding->detail));
    if (finding->answer == Answer::Undecided)
      check.findings.add_open(
          fmt::format("{}: could not be decided: {}", question, finding->detail));
    check.report["proofs"][question] = {{"answer", answer_name(finding->answer)},
                                        {"detail", finding->detail}};
  }
  const CutCount& cuts = check.proof->cuts;
  check.report["cuts"] = {{"seam_edges", cuts.seams},
                          {"other_edges", cuts.others},
                          {"length", cuts.length},
                          {"charts", cuts.charts}};
}

// What there is a map of, and what is claimed of that.
void measure(Check& check, const StopCheck& stop) {
  if (!check.proof->map()) return;
  const BezierMap& map = *check.proof->map();
  check.measures = measure_as_claimed(map, check.claims, stop, check.findings);
  Json result = measures_section(map, *check.measures, claimed_energy(check.claims));
  if (check.proof->global)
    add_global_injectivity(result, map, *check.measures, *check.proof->global);
  if (!check.measures->cut_short && !check.request.common.report.empty())
    result["distortion"] = measured_distortion(check.file);
  check.report["result"] = result;
  if (check.proof->surface.answer == Answer::Violated) return;  // claims are about another mesh
  check_claims({check.file, map, *check.measures, check.claims,
                check.surface ? &*check.surface : nullptr, check.proof->cuts},
               check.findings);
}

// "positive (486 cells), continuous (no cuts), ...; not asked: surface (--surface)".
std::string in_words(const MapProof& proof) {
  std::string proven, open;
  for (const auto& [question, finding] : proof.findings()) {
    if (finding->answer == Answer::Proven)
      proven += fmt::format("{}{} ({})", proven.empty() ? "" : ", ", question, finding->detail);
    if (finding->answer == Answer::NotAsked)
      open += fmt::format("{}{}", open.empty() ? "; not asked: " : ", ",
                          question == "surface" ? "surface (--surface)" : "overlaps (--certify)");
  }
  if (proof.cuts.others > 0)
    proven += fmt::format(", cut along {} into {}", counted(proof.cuts.others, "edge"),
                          counted(proof.cuts.charts, "chart"));
  return proven + open;
}

// What a page says of a cell that is not proven to be positive: det J at the points of a lattice.
std::string describe_fault(const MapProof& proof, Index cell) {
  if (!proof.map()) return "det J is not proven to be positive";
  constexpr int kSteps = 8;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; i + j <= kSteps; ++j) {
      const double a = static_cast<double>(i) / kSteps, b = static_cast<double>(j) / kSteps;
      least = std::min(least, proof.map()->jacobian(cell, {a, b, 1 - a - b}).determinant());
    }
  return least > 0
             ? fmt::format("det J is not proven to be positive, sampled down to {:.3g}", least)
             : fmt::format("turned over: det J is {:.3g} at a point of it", least);
}

MapPage page_of(const Check& check) {
  MapPage page;
  page.title = page_title(check.request.result);
  page.map = check.file;
  page.facts = page_facts(check.report);
  for (const Index cell : check.proof->not_positive)
    page.faults.push_back({cell, describe_fault(*check.proof, cell)});
  page.points = claimed_points(check.claims, check.file);
  return page;
}

int conclude(Check& check) {
  const Request& request = check.request;
  const std::vector<std::string>& list = check.findings.list();
  const char* status = list.empty() ? "valid" : check.findings.violated() ? "invalid" : "undecided";
  check.report["status"] = status;
  check.report["message"] = list.empty() ? "" : list.front();
  check.report["findings"] = list;
  if (!list.empty()) {
    const bool is_torn = check.proof && check.proof->continuous.answer == Answer::Violated;
    say("majorant: {}: {}: {}{}\n", request.result, status, fmt::join(list, "; "),
        is_torn ? "; if the map is meant to be cut there, add --cuts free" : "");
  } else if (!request.common.quiet) {
    say("{}: valid, degree {}: {}; {} {:.9g}{}\n", request.result, check.file.degree,
        in_words(*check.proof), claimed_energy(check.claims), check.measures->value,
        seam_summary(check.report["result"]));
  }
  WrittenFiles written;
  const std::string& report = request.common.report;
  for (const std::string& path : request.outputs)
    written.write(path, [&] { write_page(path, page_of(check)); });
  if (const std::string& path = request.distortion; !path.empty())
    written.write(
        path, [&] { write_distortion(path, check.file, measure_distortion(check.file).faces); });
  if (!report.empty()) written.write(report, [&] { write_json(report, check.report); });
  return written.conclude(list.empty() ? kSuccess : kInvalid);
}

int check(const Request& request) {
  require_writable(request.common, {{request.outputs, {".html"}}, {{request.distortion}, {".csv"}}},
                   {request.result, request.surface});
  const ThreadCount threads(start_threads(request.common.threads));
  Progress progress(request.common);
  const RunRecord record(request.time_limit, 0, interruption_flag(), {}, progress.activities());
  const StopCheck& stop = record.stop();
  const auto read = [&](const std::string& path, const auto& reader) {
    return unless_stopped("reading " + path, [&] { return reader(path, stop); });
  };
  record.begin(Activity::Reading);
  const MapFile file = read(request.result, read_map);
  say_warnings(file.warnings);
  const Claims claims = parse_claims(file.claims, request.result);
  std::optional<PolygonMesh> surface;
  if (!request.surface.empty()) {
    surface = read(request.surface, read_mesh);
    say_warnings(surface->warnings);
  }
  Check check{request, file, claims, surface};
  check.report = {{"schema_version", 1}, {"version", MAJORANT_VERSION}, {"command", "check"}};
  record.begin(Activity::Proving);
  prove(check, stop);
  record.begin(Activity::Measuring);
  measure(check, stop);
  if (check.findings.list().empty()) progress.finish();
  return conclude(check);
}

}  // namespace

void add_check(CLI::App& app, Action* run) {
  auto request = std::make_shared<Request>();
  CLI::App& verb = *app.add_subcommand("check", "measure a finished map and test its claims");
  verb.add_option("result", request->result,
                  "result: .vtu, .msh, or .obj or .ply with texture coordinates")
      ->required();
  verb.add_option("--surface", request->surface, "the mesh it should be a map of")
      ->type_name("FILE");
  verb.add_option("-o,--output", request->outputs,
                  "the map and what is wrong with it as a page: .html, repeatable")
      ->allow_extra_args(false);
  verb.add_option("--cuts", request->cuts,
                  "none: inner edges whose sides differ are violations; free: they are counted "
                  "(default with --surface: none)")
      ->check(one_of({"none", "free"}));
  verb.add_flag("--seamless", request->seamless,
                "the map is seamless, its seams are no cuts (implied where the file claims it)");
  verb.add_option("--time-limit", request->time_limit,
                  "seconds; what is not decided by then is said to be undecided")
      ->check(non_negative_number(std::numeric_limits<double>::infinity()));
  verb.add_option("--distortion", request->distortion,
                  "write a table of stretch, area and angle distortion per face to FILE.csv")
      ->type_name("FILE");
  verb.add_flag("--certify", request->certify, "prove global injectivity as well");
  request->common.add_to(verb);
  verb.footer("Example: majorant check bunny.vtu --surface bunny.obj --report check.json");
  verb.callback([request, run] { *run = [request] { return check(*request); }; });
}

}  // namespace majorant::app
