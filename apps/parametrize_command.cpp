// majorant parametrize IN -o OUT...: the main job.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <chrono>
#include <cstdio>
#include <limits>
#include <memory>

#include "apps/command.h"
#include "apps/energy_option.h"
#include "apps/map_request.h"
#include "apps/outputs.h"
#include "apps/progress.h"
#include "apps/report.h"
#include "majorant/framework/curvature_name.h"
#include "majorant/framework/evaluator.h"
#include "majorant/parametrization/parametrize.h"

namespace majorant::app {
namespace {

// Everything the user can say, as said.
struct Request {
  CommonOptions common;
  MapRequest map;
  std::string positional_output, elevation = "incremental";
  std::vector<std::string> outputs;
  int max_iterations = 1000, refine = 0;
  double tolerance = 1e-6, time_limit = std::numeric_limits<double>::infinity();
  bool normalize = false;
};

class Job {
 public:
  explicit Job(Request request) : request_(std::move(request)) {}

  int run() {
    if (!request_.positional_output.empty()) request_.outputs.push_back(request_.positional_output);
    if (request_.outputs.empty())
      throw Error(ErrorKind::Usage, "no output file; add -o OUT.vtu (or .obj .svg .json .csv)");
    require_writable(request_.outputs, {".vtu", ".obj", ".svg", ".json", ".csv"});
    if (!request_.common.report.empty()) require_writable({request_.common.report}, {".json"});
    if (request_.normalize && !(request_.map.pins.empty() && request_.map.handles.empty()))
      throw Error(ErrorKind::Usage, "--normalize moves pins and handles; leave one of the two out");
    if (!(request_.time_limit >= 0))
      throw Error(ErrorKind::Usage, "--time-limit is not a number of seconds");
    request_.common.apply();
    read();
    RunRecord record(request_.time_limit, request_.max_iterations, interruption_flag(),
                     make_progress(request_.common));
    result_ = in_.start ? parametrize(in_.start->map, in_.options, record)
                        : parametrize(in_.mesh, in_.options, record);
    finish_progress(request_.common);
    const double written = seconds();
    if (result_.status != Status::Failed && result_.map) write(record);
    write_seconds_ = seconds() - written;
    write_reports(record);
    summarize(record);
    return exit_code(result_.status);
  }

 private:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

  void read() {
    in_ = read_input(request_.map);
    if (request_.elevation == "direct") in_.options.elevation = Elevation::Direct;
    in_.options.tolerance = request_.tolerance;
    read_seconds_ = seconds();
  }

  Json options_section() const {
    Json options = request_.map.to_json();
    options["elevation"] = request_.elevation;
    options["tolerance"] = request_.tolerance;
    options["max_iterations"] = request_.max_iterations;
    return options;
  }

  std::string claims() const {
    Json pins = Json::array();
    for (const Pin& pin : in_.options.pins) {
      const Vector2 uv = result_.map->control_points().segment<2>(2 * pin.vertex);
      pins.push_back(
          {{"vertex", result_.map->mesh().input_vertex(pin.vertex)}, {"target", {uv.x(), uv.y()}}});
    }
    return Json{{"version", MAJORANT_VERSION},       {"degree", request_.map.degree},
                {"energy", request_.map.energy},     {"value", result_.measures.value},
                {"boundary", request_.map.boundary}, {"init", request_.map.init},
                {"seams", request_.map.seamless},    {"bijective", false},
                {"normalized", normalization_},      {"pins", pins},
                {"options", options_section()}}
        .dump();
  }

  void write(const RunRecord& record) {
    MapFile file = to_map_file(*result_.map);
    file.distortion = result_.measures.face_value;
    file.min_det = result_.measures.min_det;
    if (request_.normalize) normalize(file.uv);
    file.claims = claims();
    for (const std::string& path : request_.outputs) {
      if (extension(path) == ".csv") write_trace(path, record.trace());
      write_map(path, file, &in_.polygons, request_.refine);
    }
  }

  // Into the unit square, aspect ratio kept, lower left corner at the origin.
  void normalize(Points2& uv) {
    const Eigen::RowVector2d low = uv.colwise().minCoeff(), high = uv.colwise().maxCoeff();
    const double size = (high - low).maxCoeff();
    uv = (uv.rowwise() - low) / size;
    normalization_ = {{"origin", {low.x(), low.y()}}, {"size", size}};
  }

  void write_reports(const RunRecord& record) const {
    std::vector<std::string> paths;
    if (!request_.common.report.empty()) paths.push_back(request_.common.report);
    for (const std::string& path : request_.outputs)
      if (extension(path) == ".json") paths.push_back(path);
    if (paths.empty()) return;
    Json result = nullptr;
    if (result_.map) {
      result = measures_section(*result_.map, result_.measures, request_.map.energy);
      result["variables"] = result_.variables;
      result["initial_value"] = result_.initial_value;
      result["value_quadrature"] = result_.value_quadrature;
      result["newton_decrement"] = result_.newton_decrement;
      result["constraint_residual"] = result_.constraint_residual;
      result["handle_distance"] = result_.handle_distance;
    }
    const Json report{{"schema_version", 1},
                      {"version", MAJORANT_VERSION},
                      {"command", "parametrize"},
                      {"status", name(result_.status)},
                      {"message", result_.message},
                      {"input", input_section(in_.polygons, *in_.mesh)},
                      {"options", options_section()},
                      {"result", result},
                      {"iterations", iterations_section(record.trace())},
                      {"injectivity_tests", {{"depth", result_.injectivity_tests}}},
                      {"flips", {{"intended", 0}, {"performed", 0}}},
                      {"seconds",
                       {{"read", read_seconds_},
                        {"initialize", result_.initialize_seconds},
                        {"optimize", result_.optimize_seconds},
                        {"measure", result_.measure_seconds},
                        {"write", write_seconds_},
                        {"total", seconds()}}},
                      {"peak_memory_bytes", peak_memory_bytes()},
                      {"threads", threads()}};
    for (const std::string& path : paths) write_json(path, report);
  }

  void summarize(const RunRecord& record) const {
    const bool failed = result_.status == Status::Failed;
    if (request_.common.quiet && !failed) return;
    if (failed) {
      fmt::print(stderr, "majorant: {}: no valid result ({}); nothing written\n",
                 request_.map.input, result_.message);
      return;
    }
    fmt::print(stderr,
               "{}: {} after {} iterations, {} {:.6f} (start {:.6g}){}, degree {}, {:.2f} s\n",
               request_.map.input, name(result_.status), record.trace().size(), request_.map.energy,
               result_.measures.value, result_.initial_value,
               request_.map.weights.empty() ? "" : ", both without the face weights",
               request_.map.degree, seconds());
  }

  Request request_;
  Json normalization_ = nullptr;  // uv in the file = (uv - origin) / size
  MapInput in_;
  ParametrizationResult result_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  double read_seconds_ = 0, write_seconds_ = 0;
};

}  // namespace

void add_parametrize(CLI::App& app, Action* run) {
  auto request = std::make_shared<Request>();
  CLI::App& verb = *app.add_subcommand(
      "parametrize", "map a surface mesh onto the plane, injectively and with low distortion");
  Request& r = *request;
  r.map.add_to(verb);
  verb.add_option("output", r.positional_output, "output file, same as -o");
  verb.add_option("-o,--output", r.outputs, "output: .vtu .obj .svg .json .csv, repeatable")
      ->allow_extra_args(false);
  verb.add_flag("--seamless", r.map.seamless,
                "hold the seams of the input's texture coordinates, up to rotations by 90 degrees");
  std::vector<std::string> curvatures;
  for (const Curvature c : kCurvatures) curvatures.emplace_back(name(c));
  verb.add_option("--curvature", r.map.curvature, "second-order model (projected)")
      ->check(CLI::IsMember(curvatures));
  verb.add_option("--elevation", r.elevation, "how the degree is reached")
      ->check(CLI::IsMember({"incremental", "direct"}));
  verb.add_option("--tolerance", r.tolerance, "relative energy decrease to stop at (1e-6)")
      ->check(CLI::PositiveNumber);
  verb.add_option("--max-iterations", r.max_iterations, "(1000)")->check(CLI::NonNegativeNumber);
  verb.add_option("--time-limit", r.time_limit, "seconds; the best valid map is written")
      ->check(CLI::NonNegativeNumber);
  verb.add_option("--refine", r.refine, "pieces per edge in OBJ output (degree 1: 1, else 3)")
      ->check(CLI::Range(1, 20));
  verb.add_flag("--normalize", r.normalize, "scale the result into the unit square");
  r.common.add_to(verb);
  verb.footer(energy_help() +
              "Example: majorant parametrize bunny.obj -o bunny.vtu -o bunny.svg --degree 3 "
              "--report bunny.json");
  verb.callback([request, run] { *run = [request] { return Job(*request).run(); }; });
}

}  // namespace majorant::app
