// majorant convert RESULT -o OUT...: other formats of a finished map, without solving again.
#include <CLI/App.hpp>
#include <memory>

#include "apps/claims.h"
#include "apps/command.h"
#include "apps/outputs.h"
#include "apps/process.h"
#include "apps/report.h"
#include "apps/streams.h"
#include "majorant/framework/thread_count.h"
#include "majorant/io/internal/cut_map.h"
#include "majorant/io/map_file.h"
#include "majorant/io/map_proof.h"
#include "majorant/io/read_mesh.h"

namespace majorant::app {
namespace {

struct Request {
  CommonOptions common;
  std::string input, positional_output;
  std::vector<std::string> outputs;
  FormatOptions formats;
};

// Files other than ours do not mark seams and cones: the points tell where they are. A map that is
// cut in another way stays as it is.
void mark_seams(MapFile& map, const std::string& name) {
  if (map.seam_edges.size() > 0 || !is_cut(map)) return;
  try {
    const BezierMap seamless = CutMap(map, name).map_with_seams();
    if (seamless.seams().trivial()) return;  // points that no cut needs
    const MapFile marked = to_map_file(seamless);
    map.seam_edges = marked.seam_edges;
    map.cone = Eigen::VectorXi::Zero(map.points.rows());
    for (Index c = 0; c < map.cells.rows(); ++c)
      for (Index k = 0; k < 3; ++k) map.cone[map.cells(c, k)] = marked.cone[marked.cells(c, k)];
  } catch (const Error&) {
    map.seam_edges.resize(0, 3);
    map.cone.resize(0);
  }
}

// A map that is said to be injective as a whole stays so in formats without curves.
Overlap allowed_overlap(const MapFile& map, const std::string& name) {
  const bool is_bijective = parse_claims(map.claims, name).bijective.value_or(false);
  return is_bijective ? Overlap::Excluded : Overlap::Allowed;
}

// A map of the same surface, as cut and as free of overlaps as this one is or claims to be.
ProofRequest promise_of(const MapFile& map, const PolygonMesh& surface, const std::string& name) {
  ProofRequest question;
  question.cuts = CutRule::SeamsOrFree;
  const CutCount cuts = MapProof(map, name, question).cuts;
  ProofRequest promise;
  promise.surface = &surface;
  if (cuts.seams > 0) promise.cuts = CutRule::Seams;
  if (cuts.others > 0) promise.cuts = CutRule::SeamsOrFree;
  if (allowed_overlap(map, name) == Overlap::Excluded)
    promise.overlap = ProofRequest::Overlap::Forbidden;
  return promise;
}

void write_report(const Request& request, WrittenFiles& written) {
  const Json report{{"schema_version", 1},
                    {"version", MAJORANT_VERSION},
                    {"command", "convert"},
                    {"input", {{"file", request.input}}},
                    {"outputs", written.to_json()}};
  written.write(request.common.report, [&] { write_json(request.common.report, report); });
}

int convert(Request request) {
  if (!request.positional_output.empty()) request.outputs.push_back(request.positional_output);
  if (request.outputs.empty())
    throw Error(ErrorKind::Usage, "no output file; add -o OUT.obj (or .ply .msh .svg .vtu)");
  require_writable(request.common, {{request.outputs, {".vtu", ".obj", ".ply", ".msh", ".svg"}}},
                   {request.input});
  const ThreadCount threads(start_threads(request.common.threads));
  MapFile map = read_map(request.input);
  say_warnings(map.warnings);
  mark_seams(map, request.input);
  request.formats.tessellation.overlap = allowed_overlap(map, request.input);
  const PolygonMesh surface = mesh_from_map(map, request.input);
  const ProofRequest promise = promise_of(map, surface, request.input);
  WrittenFiles written;
  for (const std::string& path : request.outputs)
    written.write(path, [&] {
      write_map(path, map, nullptr, request.formats, certification(path, promise, &map));
    });
  if (!request.common.report.empty()) write_report(request, written);
  return written.conclude(kSuccess);
}

}  // namespace

void add_convert(CLI::App& app, Action* run) {
  auto request = std::make_shared<Request>();
  CLI::App& verb = *app.add_subcommand("convert", "write a finished map in other formats");
  verb.add_option("result", request->input,
                  "result: .vtu, .msh, or .obj or .ply with texture coordinates")
      ->required();
  verb.add_option("output", request->positional_output, "output file, same as -o");
  verb.add_option("-o,--output", request->outputs, "output: .vtu .obj .ply .msh .svg, repeatable")
      ->allow_extra_args(false);
  request->formats.add_to(verb);
  request->common.add_to(verb);
  verb.footer("Example: majorant convert bunny.vtu -o bunny.obj --refine 8");
  verb.callback([request, run] { *run = [request] { return convert(*request); }; });
}

}  // namespace majorant::app
